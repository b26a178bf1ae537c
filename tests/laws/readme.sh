# README.md: its table of tools is that of the pages, its shell blocks run, the files it names exist.
fail=0
"$TOP/tests/readme" >new || exit
diff -u "$TOP/README.md" new || { echo "README.md is stale: make readme"; fail=1; }

# The blocks marked sh, on a small model of the names used there.
awk '/^```/ { code = $0 == "```sh"; next } code' "$TOP/README.md" >blocks
[ -s blocks ] || { echo "README.md: no example"; fail=1; }
mkdir work && cd work || exit
mr-make bumpy -n 4000 | mr-export bunny00.off || exit
cp bunny00.off armadillo.off
mr-make bumpy --points 4000 | mr-export -f xyz kitten.xyz || exit
sh -e ../blocks >../said 2>&1 || { cat ../said; echo "an example of README.md fails"; fail=1; }

for file in $(grep -oE '\]\([^)#]*\)|src="[^"]*"' "$TOP/README.md" | sed 's/](//; s/)$//; s/src="//; s/"$//' | grep -v '^http'); do
	[ -e "$TOP/$file" ] || { echo "README.md names $file, which is not there"; fail=1; }
done
exit $fail
