# README.md: its table of tools is that of the pages, its shell blocks and recipes run as they stand, and make has its
# targets.
# It and the pages for contributors name only files that exist.
fail=0
"$TOP/tests/readme" >new || exit
diff -u "$TOP/README.md" new || { echo "README.md is stale: make readme"; fail=1; }

# The blocks marked sh, one behind another in an empty directory.
awk '/^```/ { code = $0 == "```sh"; next } code' "$TOP/README.md" >blocks
[ -s blocks ] || { echo "README.md: no example"; fail=1; }
grep -q mr-solve blocks && grep -q mr-sample blocks || { echo "README.md: a paper without its pipeline"; fail=1; }
mkdir work && cd work || exit
sh -e ../blocks >../said 2>&1 || { cat ../said; echo "an example of README.md fails"; fail=1; }
[ ! -s ../said ] || { cat ../said; echo "an example of README.md is not silent"; fail=1; }
# Its recipes work on the files that these have made; make's are for a folder of models.
awk -F'`' '/^\|.*`mr-/ && !/\]\(man/ { gsub(/\\\|/, "|", $2); print $2 }' "$TOP/README.md" >../recipes
[ -s ../recipes ] || { echo "README.md: no recipe"; fail=1; }
sh -e ../recipes >../said 2>&1 || { cat ../said; echo "a recipe of README.md fails"; fail=1; }
cd .. || exit

# Pages, and the targets that they call by `make X` or on a line of their own.
for page in README.md .github/CONTRIBUTING.md .github/CHANGES.md lib/README.md tests/README.md tests/bench/README.md; do
	file=$TOP/$page
	for link in $(grep -oE '\]\([^)#]*\)' "$file" | sed 's/](//; s/)$//' | grep -v '^http'); do
		[ -e "$(dirname "$file")/$link" ] || { echo "$page names $link, which is not there"; fail=1; }
	done
	for target in $(grep -oE '(`|^)make [a-z][a-z0-9-]*' "$file" | sed 's/.* //' | sort -u); do
		grep -q "^$target:" "$TOP/Makefile" "$TOP"/.ci/*.mk ||
			{ echo "$page names make $target, which is not there"; fail=1; }
	done
	for bench in $(grep -oE 'make bench T=[a-z]+' "$file" | sed 's/.*=//' | sort -u); do
		[ -e "$TOP/tests/bench/bench_$bench.sh" ] || [ $bench = NAME ] ||
			{ echo "$page names bench $bench, which is not there"; fail=1; }
	done
done
exit $fail
