# The pages are clean mdoc. EXAMPLES stand right after DESCRIPTION, so EXIT STATUS comes later than mandoc expects it.
command -v mandoc >/dev/null || { echo "no mandoc"; exit 77; }
cd "$TOP/man" || exit
out=$(mandoc -T lint -W warning *.[1-9] 2>&1 | grep -v 'sections out of conventional order: Sh EXIT STATUS$')
[ -z "$out" ] || { echo "$out"; exit 1; }
