# Clouds that no surface closes around: exit 1 and a sentence.
refuse() {
	for m in auto cube volume; do
		mr-import "$1" | mr-shrinkwrap -m $m >out 2>err
		echo "exit $?: $(head -n 1 err)"
	done
}
echo '1 2 3' >one.xyz
printf '1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n' >equal.xyz
printf '0 0 0\n1 0 0\n0 1 0\n' >three.xyz
for i in 0 1 2 3 4 5 6 7 8 9; do echo "$i $((2 * i)) $((3 - i))"; done >line.xyz
for i in 0 1 2 3 4; do for j in 0 1 2 3 4; do echo "$i $j $((i + 2 * j))"; done; done >plane.xyz
for cloud in one equal three line plane; do
	refuse $cloud.xyz
done

# No points at all; a template without control.
mr-make sphere -n 50 | mr-shrinkwrap >out
echo "exit $?"
mr-make sphere --points 50 | mr-shrinkwrap --template >out
echo "exit $?"
printf 'OFF\n4 4 0\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >place.off
mr-make sphere --points 50 -o ball.mrs
mr-import -l control place.off | mr-cat --merge ball.mrs - | mr-shrinkwrap --template >out
echo "exit $?"

# The fewest that can be wrapped; far from the origin.
printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n' >four.xyz
mr-import four.xyz | mr-shrinkwrap -q -m cube | mr-info -l control - | sed -n 's/^ *topology *//p'
mr-make sphere --points 500 | mr-export -l points -f xyz - | awk '{ print $1 + 1e6, $2 - 1e6, $3 }' >far.xyz
mr-import far.xyz | mr-shrinkwrap -q -m cube | mr-info -l control - | sed -n 's/^ *topology *//p'

# Far from 1 in size, products of lengths are no numbers: said as it is.
scaled() {
	mr-make sphere --points 500 | mr-export -l points -f xyz - | awk -v s="$1" '{ printf "%.17g %.17g %.17g\n", $1 * s, $2 * s, $3 * s }' >scaled.xyz
}
scaled 1e-29 && mr-import scaled.xyz | mr-shrinkwrap | mr-info -l control - | sed -n 's/^ *topology *//p'
scaled 1e29 && mr-import scaled.xyz | mr-shrinkwrap | mr-info -l control - | sed -n 's/^ *topology *//p'
scaled 1e-200 && refuse scaled.xyz
scaled 1e-310 && refuse scaled.xyz
scaled 1e200 && refuse scaled.xyz
mr-make sphere -n 42 | mr-export -f off - | mr-import -l control - >control.mrs
scaled 1e-200 && mr-import scaled.xyz | mr-cat --merge - control.mrs >frame.mrs
for tool in mr-fit mr-sample; do
	$tool frame.mrs >out 2>err
	echo "exit $?: $(head -n 1 err)"
done
