# What cannot be sampled: exit 1 or 2, a sentence, no stream that ends.
try() { # stream, options
	mr-sample "$@" >out 2>err
	echo "exit $?: $(head -n 1 err)"
}
points() { # lines of coordinates on stdin
	mr-import --points -f xyz - >points.mrs && mr-cat --merge points.mrs control.mrs >frame.mrs
}
mr-make sphere -n 42 | mr-export -f off - | mr-import -l control - >control.mrs
mr-make sphere --points 100 -o points.mrs
echo "layers"
try points.mrs
try control.mrs
echo "points"
printf '%s\n' '1 2 3' '1 2 3' '1 2 3' '1 2 3' '1 2 3' | points; try frame.mrs
printf '%s\n' '0 0 0' '1 2 3' '2 4 6' '-1 -2 -3' '5 10 15' | points; try frame.mrs
printf '%s\n' '0 0 0' '1 0 0' '0 1 0' '1 1 0' '5 3 0' | points; try frame.mrs
printf '%s\n' '0 0 0' '1 0 0' '0 1 0' | points; try frame.mrs
printf '%s\n' '0 0 0' '1 0 0' '0 1 0' '0 0 1' | points; try frame.mrs
echo "a control mesh with three faces at an edge"
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' | mr-import -l control - >fan.mrs
mr-make sphere --points 100 | mr-cat --merge - fan.mrs >frame.mrs; try frame.mrs
echo "a level too fine"
mr-make sphere --points 100 | mr-cat --merge - control.mrs >frame.mrs; try frame.mrs -n 15
echo "options"
mr-make sphere --points 100 | mr-cat --merge - control.mrs >frame.mrs
for args in '-n 16' '-n -1' '-n 2x' '-m nearest' '-K 2' '-K 129' '--refine -1' '--refine 101' '--nothing'; do
	try frame.mrs $args
	echo "$args: $(wc -c <out) bytes"
done
echo "a mesh has no use for how points are looked at"
mr-make sphere -n 42 | mr-simplify --to control -n 30 >frame.mrs
for args in '-m robust' '-m triangle' '-K 20'; do
	try frame.mrs $args
	echo "$args: $(wc -c <out) bytes"
done
mr-cat --merge frame.mrs points.mrs >both.mrs; try both.mrs -m robust
try both.mrs -l mesh -K 20
