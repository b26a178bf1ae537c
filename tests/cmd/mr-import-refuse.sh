# A file that is not what it says: one sentence with the line or the byte, exit 1, no END.
refuse() { # what printf makes
	printf "$@" >file
	mr-import file >out 2>err
	code=$?
	lines=$(wc -l <err)
	tail -c 64 out | grep -q END && echo 'bad: END'
	[ "$lines" -eq 1 ] || echo "bad: $lines lines"
	echo "$code $(cat err)"
}
v='v 0 0 0\nv 1 0 0\nv 0 1 0\n'
refuse ''
refuse 'hello, world\n'
refuse '# only a comment\n'
refuse "${v}f 1 2 4\n"
refuse "${v}f 1 2 -4\n"
refuse "${v}f 0 1 2\n"
refuse "${v}f 1 2 99999999999\n"
refuse "${v}f 1 2\n"
refuse 'v 0 0 0\nv 1,5 0 0\n'
refuse 'v 0 0 0\nv 0 0\n'
refuse 'ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n'
refuse 'ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n\0\0\0\0'
refuse 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n'
refuse 'ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n'
refuse 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n'
refuse 'OFF\n4000000000 4000000000 0\n'
refuse 'OFF BINARY\n\1\0\0\0'
refuse 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n'
refuse 'solid a\nendsolid a\n'
refuse '0 0 0\n1 2\n'
refuse '7\n0 0 0\n1 2 3\n'
refuse '1,5 2,5 3,5\n4,5 5,5 6,5\n'
refuse 'x;y;z\n1;2;3,5\n'
refuse '2\n1,000.5 2,000.5 3,000.5\n1 2 3\n'
refuse '1,2,3 4,5,6\n7,8,9 0,1,0\n'
printf '1.5,2.5,3\n1, 2, 3\n' | mr-import | mr-export -f xyz -
printf '\037\213\010\0' >file
mr-import file
echo $?
mr-import no-such-file
echo $?
mr-import .
echo $?

echo 'what does not end, and is no model' >&2
endless() {
	timeout 60 mr-import "$@"
	echo $?
}
{ printf 'ply\n'; cat /dev/zero; } | head -c 20000000 | endless
mr-make sphere -n 400000 | mr-export -f stl - >big.stl
cat big.stl | mr-import | mr-info --no-intersections | grep vertices

echo 'control characters of a name stay out of the sentence' >&2
mr-import "$(printf 'a\nb\033[31m.obj')"
echo 'what was read of a file by stdin is read' >&2
printf '0 0 0\n1 2 3\n' >points
mr-make plane -n 2 -o stream.mrs
mr-import stream.mrs >out.mrs
echo $?
{ mr-import -f xyz - >out.mrs; wc -c; } <points

echo 'more columns than a frame has' >&2
{
	printf 'ply\nformat ascii 1.0\nelement vertex 1\n'
	printf 'property float %s\n' x y z
	seq -f 'property uchar p%.0f' 5000
	printf 'end_header\n0 0 0'
	yes ' 0' | head -n 5000 | tr -d '\n'
	echo
} >wide.ply
mr-import wide.ply
