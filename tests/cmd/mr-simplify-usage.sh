# Wrong command lines: exit 2, a sentence, nothing on stdout; what it cannot work on is named.
for args in '-n -1' '-n x' '-r 1.1' '-r nan' '-e -1' '-e 1%%' '-e 1 --boundary -1' '-n 10 -r 0.5' '--nothing' '-n' '--lock rim' '--lock region:x'; do
	mr-make sphere -n 100 | mr-simplify $args >out 2>err
	echo "$args: $? $(wc -c <out) $(head -n 1 err)"
done
refuse() {
	mr-import "$1" | mr-simplify -n 2 >out 2>err
	echo "exit $?: $(cat err)"
}
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' >fan.off
refuse fan.off
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 2 3\n' >turned.off
refuse turned.off
printf '0 0 0\n1 0 0\n0 1 0\n' >cloud.xyz
refuse cloud.xyz
mr-make sphere -n 100 | head -c 3000 | mr-simplify -n 10 >out 2>err
echo "cut: exit $?, $(head -n 1 err)"
# A layer of another kind, or the one that is simplified, is not where a surface is put.
mr-make sphere -n 100 -o sphere.mrs
for args in '--to points' '--to handles' '--to displacement' '--to mesh' '-l mesh --to mesh'; do
	mr-simplify $args sphere.mrs >out 2>err
	echo "$args: exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done
while read -r option name; do
	mr-simplify "$option" "$name" sphere.mrs >out 2>err
	echo "$option '$name': exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done <<'NAMES'
--to
--to a b
--to seventeen-letters
NAMES
mr-simplify --to control -n 50 sphere.mrs | mr-simplify --to control -l mesh -n 20 | mr-info | grep -c triangles
