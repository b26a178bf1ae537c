# The pages are clean mdoc.
command -v mandoc >/dev/null || { echo "no mandoc"; exit 77; }
cd "$TOP/man" || exit
out=$(mandoc -T lint -W warning *.[1-9] 2>&1)
[ -z "$out" ] || { echo "$out"; exit 1; }
