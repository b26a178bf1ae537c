# Lines have at most 120 columns, tabs at every eighth, but for rows of tables and what is shown as it is.
cd "$TOP" || exit
find lib cmd formats man examples .ci .github Makefile README.md tests/page tests/laws tests/bench/*page* \
	-type f ! -name '*.png' ! -name '*.webp' ! -path '*/cache/*' |
	LC_ALL=C sort | while read -r file; do
	expand "$file" | LC_ALL=C.UTF-8 awk -v file="$file" '
		/^\|/ || /^ *echo / { next }
		length($0) > 120 { print file ":" NR ": " length($0) " columns" }'
done >"$OLDPWD/long"
cat "$OLDPWD/long"
[ ! -s "$OLDPWD/long" ]
