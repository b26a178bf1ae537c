# Files made to hurt: counts beyond any memory, endless lines, polygons of many corners, gzip that swells.  Each is read or refused
# at once, in little memory.
fail=0
[ -n "$SAN" ] || ulimit -v 400000 # kilobytes; a sanitizer needs more for itself

quick() { # what, expected exit, seconds of computing at most, FILE...
	what=$1 expected=$2 limit=$3
	shift 3
	(ulimit -t "$limit"; exec mr-import "$@") >out 2>err
	code=$?
	[ $code -eq "$expected" ] || { echo "$what: exit $code, not $expected: $(head -n 2 err)"; fail=1; }
	[ $code -eq 0 ] || [ "$(wc -l <err)" -eq 1 ] || { echo "$what: not one sentence: $(head -n 5 err)"; fail=1; }
}

xyz='property float x\nproperty float y\nproperty float z\n'
face='property list uchar int vertex_indices\n'
for count in 1000000000 4294967295 4294967296 18446744073709551615 99999999999999999999 -1; do
	printf "ply\nformat ascii 1.0\nelement vertex $count\n${xyz}end_header\n0 0 0\n" >f
	quick "ply of $count vertices" 1 10 f
	printf "ply\nformat binary_big_endian 1.0\nelement vertex $count\n${xyz}end_header\n" >f
	quick "binary ply of $count vertices" 1 10 f
	printf "ply\nformat ascii 1.0\nelement vertex 1\n${xyz}element face $count\n${face}end_header\n0 0 0\n" >f
	quick "ply of $count faces" 1 10 f
	printf "ply\nformat ascii 1.0\nelement vertex 1\n${xyz}element face 1\n${face}end_header\n0 0 0\n$count 0\n" >f
	quick "ply of a face of $count corners" 1 10 f
	printf "OFF\n$count 1 0\n0 0 0\n" >f
	quick "off of $count vertices" 1 10 f
	printf "OFF\n1 $count 0\n0 0 0\n" >f
	quick "off of $count faces" 1 10 f
	printf "OFF\n1 1 0\n0 0 0\n$count 0 0 0\n" >f
	quick "off of a face of $count corners" 1 10 f
	printf "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nPOINTS $count\nDATA ascii\n0 0 0\n" >f
	quick "pcd of $count points" 1 10 f
	printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 $count\n" >f
	quick "obj of a face with corner $count" $([ "$count" = -1 ] && echo 0 || echo 1) 10 f
done
printf '4000000000\n0 0 0\n' >f
quick 'pts of 4 billion points' 1 10 f
# Elements without properties take no bytes, and no time, however many there are.
printf "ply\nformat ascii 1.0\nelement nothing 999999999999\nelement vertex 1\n${xyz}end_header\n0 0 0\n" >f
quick 'ply of empty elements' 0 10 f
{ head -c 80 /dev/zero; printf '\377\377\377\377'; head -c 50 /dev/zero; } >f
quick 'stl of 4 billion triangles' 1 10 -f stl f

# A line of 20 MB: blanks, digits, a word, a name.
blanks() { head -c 20000000 /dev/zero | tr '\0' "$1"; }
{ printf 'v 0 0 0'; blanks ' '; echo; } >f
quick 'obj with blanks' 0 20 f
{ printf 'v 0 0 '; blanks 1; echo; } >f
quick 'obj with digits' 1 20 f
{ printf 'v 0 0 0\ng '; blanks x; echo; } >f
quick 'obj with a name' 0 20 f
{ printf 'v 0 0 0\nf '; blanks 1; echo; } >f
quick 'obj with an index' 1 20 f
{ blanks '#'; printf '\nOFF\n1 0 0\n0 0 0\n'; } >f
quick 'off with a comment' 0 20 f
{ printf '0 0 '; blanks ' '; echo 0; } >f
quick 'xyz with blanks' 0 20 f
blanks '\n' >f
quick 'newlines' 1 20 f

# Polygons: a star of 100,000 corners, one that crosses itself everywhere, and one that names a vertex over and over.
awk 'BEGIN { n = 100000; for (i = 0; i < n; i++) { r = 1 + i % 2; a = i * 6.283185307179586 / n; print "v", r * cos(a), r * sin(a), 0 }
	printf "f"; for (i = 1; i <= n; i++) printf " %d", i; print "" }' >f
quick 'obj with a star' 0 60 f
awk 'BEGIN { n = 100000; for (i = 0; i < n; i++) print "v", sin(i * i), cos(i * 1.7 * i), sin(3 * i)
	printf "f"; for (i = 1; i <= n; i++) printf " %d", i; print "" }' >f
quick 'obj with a knotted polygon' 0 60 f
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0"; printf "f"; for (i = 0; i < 100000; i++) printf " 1 2 3"; print "" }' >f
quick 'obj with a polygon that goes round and round' 0 60 f

# glTF: counts that the file cannot hold, nodes in a long chain, many nodes with one mesh, brackets without end.
gltf() { # nodes, count, an accessor's view
	printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[%s],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],' "$1"
	printf '"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],'
	printf '"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{%s"componentType":5126,"count":%s,"type":"VEC3"}]}\n' "$3" "$2"
}
for count in 4 1000000000 4294967295 18446744073709551615 1e9 -1; do
	gltf '{"mesh":0}' "$count" '"bufferView":0,' >f
	quick "gltf of $count rows" 1 10 f
done
gltf '{"mesh":0}' 4000000 >f
quick 'gltf of zeros that nobody wrote' 1 10 f
chain=$(awk 'BEGIN { for (i = 1; i < 50000; i++) printf "{\"children\":[%d]},", i; print "{\"mesh\":0}" }')
gltf "$chain" 3 '"bufferView":0,' >f
quick 'gltf of a chain of nodes' 0 10 f
many=$(awk 'BEGIN { printf "{\"children\":[1"; for (i = 2; i < 50000; i++) printf ",%d", i
	printf "]}"; for (i = 1; i < 50000; i++) printf ",{\"mesh\":0}" }')
gltf "$many" 3 '"bufferView":0,' >f
quick 'gltf of a mesh of many nodes' 0 10 f
{ printf '{"asset":'; blanks '['; } >f
quick 'gltf of brackets' 1 20 f

# gzip of 1.5 GB of nothing.
[ -n "$SAN" ] || {
	head -c 15000000 /dev/zero | gzip -1 >member
	for i in $(seq 100); do cat member; done >f
	quick 'gzip that swells' 1 60 f
}
exit $fail
