# What a format cannot hold is found, and counted under --stats.
printf 'v 0.1 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\ng a\nf 1/1 2/2 3/3\n' >a.obj
mr-import a.obj -o a.mrs
for format in stl stl-ascii off obj ply xyz pts; do
	echo "-- $format"
	mr-export -v -i a.mrs -f $format --stats stats out 2>&1
	sed 's/"seconds":[^,]*,"peak_bytes":[0-9]*//' stats
done
echo "-- far from the origin a float is coarse"
for far in 0 1 100 1e6; do
	echo "by $far"
	for format in stl glb; do
		mr-transform --translate $far,0,0 a.mrs | mr-export -q --stats - -f $format out 2>&1 | grep -o rounded..[0-9]*
	done
done
echo "-- an STL has no vertices without a face"
printf 'v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nv 8 8 8\nf 1 3 4\n' | mr-import >loose.mrs
for format in stl stl-ascii off; do
	mr-export -i loose.mrs -f $format --stats stats out 2>&1
	grep -o '"findings.*' stats
done
printf 'v 1e300 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | mr-import | mr-export -f stl never
echo "exit $?"
ls never 2>/dev/null
