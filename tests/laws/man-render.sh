# The pages read well by both formatters, mandoc and groff, on a terminal of 80 columns: no warning, no row of a table
# on more than one line, no word that only one of them shows (a macro's name as a word loses what is behind it under
# groff).
for formatter in mandoc groff; do
	command -v $formatter >/dev/null || { echo "no $formatter"; exit 77; }
done
fail=0

# Words and numbers alone: quotes, dashes and blanks are each formatter's own.
plain() {
	tr -cs 'A-Za-z0-9\n' ' ' | sed 's/^ //; s/ $//'
}
rows() { # page: those of its tables, a line each
	awk '/^\.Bl -column/ { on = 1 } /^\.El/ { on = 0 } on && /^\.It/' "$1" |
	    sed 's/^\.It //; s/Sy //g; s/ Ta\( \|$\)/ /g; s/\\(../ /g' | plain
}
# Man leaves two of the columns free.
with_mandoc() {
	mandoc -Tutf8 -Owidth=78 "$1" | sed "s/.$(printf '\b')//g"
}
with_groff() {
	groff -mandoc -ww -Tutf8 -rLL=78n -P-cbou "$1"
}
text() { # a rendered page without its first and last line, and without the ends of lines, where a hyphen may be new
	sed '/^$/d' "$1" | sed '1d; $d' | tr -cd 'A-Za-z0-9'
}

for page in "$TOP"/man/*.[1-9]; do
	name=${page##*/}
	rows "$page" >rows
	for formatter in mandoc groff; do
		with_$formatter "$page" >$formatter 2>warnings || { echo "$name: $formatter fails"; fail=1; }
		[ ! -s warnings ] || { echo "$name: $formatter warns:"; cat warnings; fail=1; }
		plain <$formatter >lines
		grep -vxF -f lines rows >broken &&
			{ echo "$name: $formatter breaks a row of a table:"; cat broken; fail=1; }
	done
	[ "$(text mandoc)" = "$(text groff)" ] || { echo "$name: mandoc and groff show different words"; fail=1; }
done
exit $fail
