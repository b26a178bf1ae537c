# A vertex that no face has, as one at the origin of a model that stands in a country's coordinates, changes nothing but itself:
# lengths in % are of the surface.
fail=0
mr-make bumpy -n 2000 | mr-transform --translate 500000,5800000,100 | mr-export -f off one.off
awk 'NR == 2 { n = $1; $1++ } NR == n + 2 { print; print "0 0 0"; next } { print }' one.off >more.off
cat >jobs <<'JOBS'
mr-smooth | mr-export -q
mr-remesh -L 3% | mr-export -q
mr-remesh --adaptive 1% | mr-export -q
mr-simplify -e 0.2% | mr-export -q
mr-subdivide --longest 2% | mr-export -q
mr-crop --keep above:y,0.5 | mr-export -q
mr-transform --center --unit | mr-export -q
mr-simplify -q --to control -n 300 | mr-fit -q | mr-export -q -l control
mr-simplify -q --to control -n 300 | mr-sample -q | mr-decode -q | mr-export -q
mr-smooth | mr-remesh -q -r 5 | mr-select --free all --fixed below:y,0.4 --handle 0=above:y,0.6 | mr-encode | mr-pose --rotate 1,0,0,80 | mr-solve | mr-decode | mr-export
JOBS
# The vertex, wherever it is, taken out: faces are behind those before it; what is left is compared.
stripped() {
	awk 'NR == 1 { print; next } NR == 2 { n = $1; m = $2; next }
		NR <= n + 2 { p[NR - 3] = $0; next } { t[++k] = $0; for (i = 2; i <= 4; i++) used[$i] = 1 }
		END {
			for (i = 0; i < n; i++) if (i in used) { at[i] = count++; print p[i] }
			for (k = 1; k <= m; k++) { split(t[k], v); print v[1], at[v[2]], at[v[3]], at[v[4]] }
		}'
}
while read -r job; do
	for model in one more; do
		mr-import $model.off | eval "$job -f off -" 2>$model.err | stripped >$model.out
		sed -i 's/.*\[/[/' $model.err
	done
	[ "$(wc -l <one.out)" -gt 100 ] || { echo "$job: nothing to compare"; fail=1; }
	cmp one.out more.out || { echo "$job: another surface"; fail=1; }
done <jobs
grep -q missed one.err || { echo "the last one has nothing to warn of"; fail=1; }
diff one.err more.err || { echo 'other warnings'; fail=1; }
for model in one more; do
	mr-import --weld 1% $model.off 2>/dev/null | mr-export -q -f off - | stripped >$model.out
done
cmp one.out more.out || { echo "--weld: another surface"; fail=1; }
for model in one more; do
	mr-import $model.off | mr-render -s 100x100 --no-labels $model.png
	mr-import $model.off | mr-view -q $model.html
done
cmp one.png more.png || { echo "another picture"; fail=1; }
[ $(wc -c <more.html) -lt $(($(wc -c <one.html) + 1000)) ] && [ $(wc -c <more.html) -gt $(($(wc -c <one.html) - 1000)) ] ||
    { echo "a page of other steps"; fail=1; }
exit $fail
