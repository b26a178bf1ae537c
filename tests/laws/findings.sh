# The page of the findings is that of their table, and no sentence is longer than a line of 160 columns allows.
"$TOP/tests/findings" | diff -u "$TOP/man/mr-findings.7" - || { echo "make readme makes the page again"; exit 1; }
mr-make torus -n 2000 | mr-smooth | mr-remesh | mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 |
	mr-encode |
    mr-pose --rotate 0,0,1,170 | mr-solve | mr-decode -o bent.mrs 2>said
cat said
grep -qE ' \[(folded|crossing)\]$' said || { echo "no fold, and nothing crosses"; exit 1; }
awk 'length > 160 { print "long: " $0; bad = 1 } END { exit bad }' said || exit 1
