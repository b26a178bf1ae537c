# The sampling of points: whether it is read from their columns or found makes no difference, nor does their order.
fail=0
bad() {
	echo "$*"
	fail=1
}
control() { # stream, file: the control mesh
	mr-export -l control -f ply -i "$1" "$2" || exit
}
figures() { # stream: of points
	mr-info --json -l points "$1" | sed 's/.*"kind"/"kind"/'
}

mr-make bumpy --points 4000 --noise 0.004 | mr-export -l points -f xyz - |
	awk '{ print $1, $2, $3 } NR % 40 == 0 { print 2 * $2, -2 * $1, 1.3 * $3 } NR % 500 == 0 { print $1, $2, $3 }' >cloud.xyz || exit
mr-import cloud.xyz -o plain.mrs || exit
mr-shrinkwrap plain.mrs -o wrapped.mrs || exit
for column in spacing outlier repeat sampling; do
	mr-info -l points wrapped.mrs | grep -q "^ *$column " || bad "mr-shrinkwrap does not keep $column"
done
mr-info --check wrapped.mrs >/dev/null || bad 'what mr-shrinkwrap keeps breaks a law'
[ "$(figures plain.mrs)" = "$(figures wrapped.mrs)" ] || bad 'mr-info says other figures of columns'
mr-info --json -l points plain.mrs | grep -q '"duplicates":8,"places":4100,"outliers":[1-9]' || bad 'other places or no outliers'

for options in '' '-m cube -r 10' '-m volume'; do
	mr-shrinkwrap $options --no-history plain.mrs -o once.mrs || exit
	mr-shrinkwrap $options --no-history once.mrs | cmp -s - once.mrs || bad "mr-shrinkwrap $options: other bytes by columns"
	mr-shrinkwrap $options --no-history -j 1 plain.mrs | cmp -s - once.mrs || bad "mr-shrinkwrap $options depends on -j"
done

control wrapped.mrs wrap.ply
awk '{ line[NR] = $0 } END { for (i = NR; i > 0; i--) print line[i] }' cloud.xyz >back.xyz
mr-import back.xyz | mr-shrinkwrap -o back.mrs || exit
control back.mrs back.ply
cmp -s wrap.ply back.ply || bad 'the wrap depends on the order of the points'

mr-simplify -n 300 wrapped.mrs -o coarse.mrs || exit
mr-fit coarse.mrs -o fitted.mrs || exit
control coarse.mrs coarse.ply
control fitted.mrs fitted.ply
mr-import -l control coarse.ply | mr-cat --merge - plain.mrs | mr-fit -o bare.mrs || exit
mr-info -l points bare.mrs | grep -q '^ *sampling  *- d2' || bad 'mr-fit does not keep the sampling'
control bare.mrs bare.ply
cmp -s bare.ply fitted.ply || bad 'mr-fit: other bytes by columns'

mr-import -l control fitted.ply | mr-cat --merge - plain.mrs -o bare.mrs || exit
for method in triangle robust; do
	mr-sample -n 2 -m $method bare.mrs | mr-decode | mr-export -l mesh -f ply one.ply || exit
	mr-sample -n 2 -m $method fitted.mrs | mr-decode | mr-export -l mesh -f ply two.ply || exit
	cmp -s one.ply two.ply || bad "mr-sample -m $method: other bytes by columns"
done
exit $fail
