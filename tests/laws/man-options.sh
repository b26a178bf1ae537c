# What --help says and what the pages say are the same options: none undocumented, none invented.
# The options of every tool stand in mr.7, a tool's own in its page.
fail=0

# Option names of the .It lines of a page's OPTIONS section: "-x" and "--long".
documented() {
	awk '/^\.Sh/ { on = /OPTIONS/ } on && /^\.It / {
		gsub(/\\-/, "-")
		flag = 0
		for (i = 2; i <= NF; i++)
			if ($i ~ /^[A-Z][a-z]$/)
				flag = $i == "Fl"
			else if (flag && $i != "," && $i != "|")
				print "-" $i
	}' "$1" | sort -u
}

documented "$TOP/man/mr.7" >common
[ -s common ] || { echo "mr.7: no COMMON OPTIONS"; fail=1; }
for tool in "$BUILD"/bin/mr-*; do
	name=${tool##*/}
	page=$TOP/man/$name.1
	[ -f "$page" ] || continue # complete.sh complains
	"$tool" --help >help || { echo "$name --help fails"; fail=1; }
	grep -E '^ +-' help | sed 's/  *[^ -].*//' | grep -oE -- '(^| )--?[a-zA-Z][a-z-]*' | tr -d ' ' | sort -u >said
	[ -s said ] || { echo "$name --help shows no option"; fail=1; }
	documented "$page" >page
	sort -u page common >either
	comm -23 said either | sed "s/^/$name: in --help, not in the page: /" >>differences
	comm -13 said page | sed "s/^/$name: in the page, not in --help: /" >>differences
done
if [ -s differences ]; then
	cat differences
	fail=1
fi
exit $fail
