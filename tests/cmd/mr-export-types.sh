# A property has the type that it came with where that holds its values; in text, decimals of a float, too.
for value in 0.5 nan 0.1 0.100000001 0.1000000001 16777217 100000010 1e300; do
	{
		printf 'ply\nformat ascii 1.0\nelement vertex 1\n'
		printf 'property float %s\n' x y z quality
		printf "end_header\n0 0 0 $value\n"
	} >in.ply
	echo "-- $value"
	for format in ply ply-ascii; do
		mr-import in.ply | mr-export -f $format out.ply
		grep -a quality out.ply
		mr-import out.ply | mr-export -f $format - | cmp out.ply
	done
	tail -n 1 out.ply
done
