# What cannot be kept is warned of, once and truly; what can be is not.
cat >model.obj <<'X'
mtllib here.mtl
mtllib not there.mtl
v 0 0 0 0.5
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0 0.5
vt 1 1
vn 0 0 1
vn 0 1 0
o thing
usemtl red
s 1
f 1/1/1 2/2/1 3/3/1 4/1/1
g part
s off
f 1/2/2 3/3 2
f 1 2
l 1 2 3
p 4
cstype bezier
deg 3
curv 0 1 1 2
X
touch here.mtl
echo '-- of an OBJ' >&2
mr-import model.obj -o model.mrs
mr-info model.mrs | grep -o '[a-z_]*  *[vf-] [a-z][0-9]'
mr-import -q model.obj | mr-export -q again.obj
grep '^[fgosu]' again.obj
touch 'not there.mtl'
mr-import model.obj 2>&1 >/dev/null | grep -c not.there
rm here.mtl 'not there.mtl'
mr-import model.obj 2>&1 >/dev/null | grep 'not there'

echo '-- so far from the origin that doubles are coarse; of which file it is said' >&2
printf 'v 1e15 0 0\nv 1000000000000001 0 0\nv 1e15 1 0\nf 1 2 3\n' >far.obj
printf 'v 1e6 0 0\nv 1000001 0 0\nv 1e6 1 0\nf 1 2 3\n' >near.obj
mr-import near.obj far.obj >far.mrs
mr-make sphere -n 500 | mr-transform --translate 500000,5800000,100 | mr-export -q floats.stl && mr-import floats.stl >far.mrs
mr-make sphere -n 500 | mr-transform --translate 5000,0,100 | mr-export -q floats.stl && mr-import floats.stl >far.mrs

echo '-- of a PLY' >&2
cat >model.ply <<'X'
ply
format ascii 1.0
comment TextureFile skin.png
comment made by hand
comment group head
element vertex 3
property float x
property float y
property float z
property uchar class
property list uchar int near
property float region
element face 1
property list uchar int vertex_indices
property uint material
element edge 1
property int a
end_header
0 0 0 256 0 0.5
1 0 0 1 1 2 0.5
0 1 0 2 0 0.5
3 0 1 2 7
5
X
mr-import model.ply | mr-export -f ply-ascii -

echo '-- what formats have no place for' >&2
for format in stl off xyz; do
	echo "-- $format" >&2
	mr-export -i model.mrs --stats stats -f $format out
	grep -o '"findings.*' stats
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | mr-import | mr-export plain.stl
mr-make plane -n 9 | mr-export plain.off

echo '-- a base is written with what came with its mesh, where it has the same triangles' >&2
cat >strip.obj <<'X'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 1
v 2 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl red
f 1/1/1 2/2/1 3/3/1 4/4/1
usemtl blue
f 2/1/1 5/2/1 6/3/1 3/4/1
X
mr-import strip.obj -o strip.mrs
mr-smooth -t 0 strip.mrs | mr-export -l base base.obj
sed 1,6d base.obj
mr-remesh strip.mrs | mr-export -l base -f obj - | grep -c '^f'
mr-simplify -n 2 strip.mrs | mr-export -f obj - | grep -c '^vn'

echo "-- columns of the file's own, which a surface of other triangles has not" >&2
cat >labels.py <<'X'
import sys
names = sys.argv[1:]
print("ply\nformat ascii 1.0\nelement vertex 4", *("property float " + c for c in ["x", "y", "z"] + names), sep="\n")
print("element face 2\nproperty list uchar int vertex_indices\nproperty int part\nend_header")
for x in ("0 0 0", "1 0 0", "1 1 0", "0 1 0"):
    print(x, *("1" for c in names))
print("3 0 1 2 7\n3 0 2 3 8")
X
python3 labels.py label intensity | mr-import - | mr-remesh -L 0.5 | mr-export -f ply - >/dev/null
python3 labels.py $(seq -f f%g 20) | mr-import - | mr-remesh -L 0.5 | mr-export -f ply - >/dev/null
python3 labels.py label | mr-import - | mr-simplify -n 1 --to control | mr-export -f ply - >/dev/null

echo '-- polygons that are none any more' >&2
mr-subdivide --longest 0.6 strip.mrs | mr-export -f obj - | grep '^[fu]'

echo '-- welded seams stay; colours that differ do not' >&2
cat >soup.ply <<'X'
ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
property float s
property float t
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
end_header
0 0 0 0 0 1 2 3
1 0 0 1 0 1 2 3
0 1 0 0 1 1 2 3
1 0 0 0 0 1 2 3
1 1 0 1 0 1 2 3
0 1 0 0 1 9 2 3
3 0 1 2
3 3 4 5
X
mr-import --weld 0 soup.ply | mr-export -f obj - | grep '^[vf]'

echo '-- faces turned over keep their corners; normals against the surface turn, too' >&2
cat >turned.obj <<'X'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 0
vt 1 1
vt 2 2
vt 3 3
vt 4 4
vn 0 0 1
vn 0 0 -1
f 1/1/1 2/2/1 3/3/1
f 1/1/1 3/3/1 4/4/1
f 2/1/1 5/2/1 3/3/1
f 5/1/2 3/2/2 6/3/2
X
mr-import --repair turned.obj | mr-export -f obj - | grep '^[vf][nt ]'

echo '-- what an STL has beside triangles' >&2
python3 - <<'END'
import struct
facet = lambda i, color: struct.pack("<12fH", 0, 0, 1, i, 0, 0, i + 1, 0, 0, i, 1, 0, color)
open("colors.stl", "wb").write(b"COLOR=\1\2\3\4,MATERIAL=\1\2\3".ljust(80) + struct.pack("<I", 3) + facet(0, 0) + facet(1, 7) + facet(2, 7))
END
mr-import colors.stl | mr-export -f stl-ascii - | grep solid
printf 'solid a part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n' >part.stl
mr-import part.stl | mr-export -f stl-ascii - | grep solid

echo '-- colours of faces of an OFF' >&2
printf 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 2 1 0 # none\n' | mr-import --stats - 2>&1 >/dev/null | sed 's/.*"findings/"findings/'

echo '-- lists that do not go with the corners; labels of faces, of which -1 is none; places of the scanner' >&2
cat >lists.ply <<'X'
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float scanner_x
property float scanner_y
property float scanner_z
element face 2
property list uchar int vertex_indices
property list uchar float texcoord
property int group
end_header
0 0 0 1 2 3
1 0 0 1 2 3
0 1 0 1 2 3
3 0 1 2 6 0 0 1 0 0 1 -1
3 2 1 0 4 0 0 1 0 2
X
mr-import lists.ply -o lists.mrs
mr-export -f ply-ascii -i lists.mrs - >once.ply
mr-import once.ply | mr-export -f ply-ascii - | cmp once.ply
sed -n '/scanner/p; /group/p; /header/,$p' once.ply

echo '-- counts of a LAS that differ' >&2
python3 - <<'END'
import struct
def las(name, count, points, count64=0, scale=1):
    head = bytearray(375)
    head[0:4], head[24:26] = b"LASF", bytes((1, 4))
    struct.pack_into("<HIIBHI", head, 94, 375, 375, 0, 0, 20, count)
    struct.pack_into("<6d", head, 131, 1, 1, scale, 0, 0, 0)
    struct.pack_into("<Q", head, 247, count64)
    open(name, "wb").write(bytes(head) + b"".join(struct.pack("<3i8x", i, 2, 3) for i in range(points)))
las("counts.las", 2, 3, count64=3)
las("same.las", 2, 2, count64=2)
las("late.las", 0, 2, count64=2)
las("none.las", 0, 2)
las("flat.las", 2, 2, scale=0)
END
for file in counts same late none flat; do
	echo "$file: $(mr-import $file.las -o $file.mrs 2>&1)" >&2
done
mr-info counts.mrs | grep points:

echo '-- a binary rest that looks like a comment' >&2
{ printf 'ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n'; printf 'abc#rest'; } >rest.ply
mr-import rest.ply -o rest.mrs

echo '-- properties that are called as columns of some layer come out again, behind tools that write such columns'
for name in response encoded detail_height height source_face target; do
	awk -v name=$name 'BEGIN { print "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float " name
		print "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1.5\n1 0 0 2.5\n0 1 0 3.5\n0 0 1 4.5"
		print "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3" }' >named.ply
	for how in 'mr-select --free all' 'mr-crop --keep all' 'mr-transform -l mesh --translate 1,0,0' 'mr-subdivide --longest 2'; do
		mr-import named.ply | $how | mr-export -f ply-ascii - | grep -E "$name|4.5\$"
	done
done | sort | uniq -c
