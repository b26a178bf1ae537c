# Every format is recognised by its bytes, from a file of any name and from a pipe, and gives the same surface.
show() { # shows stdin, a stream, as OBJ
	mr-export -f obj -
}
cat >square.obj <<'X'
# a square and a triangle
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0.5 0.5 1e-3
g floor
f 1 2 3 4
g roof
f -3 -2 -1
X
mr-import square.obj | show | tee square
sed 's/^f 1 2 /&\\\n/; s/^v 1 0/&\\\r\n/' square.obj >lines.obj
mr-import lines.obj | show | cmp - square

echo '-- text'
cat >file1 <<'X'
ply
format ascii 1.0
element vertex 5
property double x
property double y
property double z
element face 2
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
1 1 0
0 1 0
.5 5e-1 0.001
4 0 1 2 3
3 2 3 4
X
cat >file2 <<'X'
OFF # five and two
5 2 0
0 0 0
1 0 0
1 1 0
0 1 0
.5 .5 .001
4 0 1 2 3
3 2 3 4
X
grep -v '^g' square >plain
for file in file1 file2; do
	mr-import $file | show | cmp - plain && echo "ok $file"
	gzip -c $file | mr-import | show | cmp - plain && echo "ok gzip of $file from a pipe"
	cat $file | mr-import - | show | cmp - plain && echo "ok $file from a pipe"
done

echo '-- binary and big-endian, as others write it'
python3 - <<'X'
import struct
points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, .5, .5, .001]
head = "ply\nformat binary_big_endian 1.0\nelement vertex 5\n" + "".join(f"property double {c}\n" for c in "xyz")
head += "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
open("big.ply", "wb").write(head.encode() + struct.pack(">15dB4iB3i", *points, 4, 0, 1, 2, 3, 3, 2, 3, 4))
X
for file in big.ply; do
	mr-import $file | show | sed 's/0.00100000004.*/0.001/' | cmp - plain && echo "ok $file"
done

echo '-- what mr-export writes'
mr-import square.obj -o square.mrs
for format in obj ply ply-ascii off; do
	mr-export -i square.mrs -f $format file
	mr-import file | show | grep -v '^g' | cmp - plain && echo "ok $format"
	mr-export -i square.mrs -f $format file.gz
	gzip -t <file.gz && mr-import file.gz | show | grep -v '^g' | cmp - plain && echo "ok $format.gz"
done
for format in stl stl-ascii; do
	mr-export -i square.mrs -f $format file
	mr-import file | show | wc -l
done

echo '-- points'
printf '2\n0 0 0 9 255 0 7\n1 2 3 9 1 2 3\n' | mr-import | mr-export -f xyz -
printf 'x,y,z\n0,0,0\n1,2,3\n' | mr-import | mr-export -f pts -
printf '0 0 0 0 0 1\n1 2 3 0 1 0\n' | mr-import | mr-export -f pwn -
mr-import --points square.obj | mr-export -f xyz -

echo '-- names of frames, and several files'
cp square.obj a.b.obj
gzip -c square.obj >c.obj.gz
mr-import a.b.obj c.obj.gz - <square.obj | mr-export '%d-%s.obj'
ls *-*.obj

echo '-- as another layer'
mr-import -l control square.obj | mr-export -l control -f obj - | head -n 1
