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
mr-import model.obj 2>&1 >/dev/null | grep 'not there$'

echo '-- so far from the origin that doubles are coarse; of which file it is said' >&2
printf 'v 1e15 0 0\nv 1000000000000001 0 0\nv 1e15 1 0\nf 1 2 3\n' >far.obj
printf 'v 1e6 0 0\nv 1000001 0 0\nv 1e6 1 0\nf 1 2 3\n' >near.obj
mr-import near.obj far.obj >far.mrs

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
mr-import -v model.ply 2>&1 >/dev/null | grep comment

echo '-- what formats have no place for' >&2
for format in stl off xyz; do
	echo "-- $format" >&2
	mr-export -i model.mrs --stats stats -f $format out
	tr -d '{}' <stats | tr , '\n' | grep 'dropped\|broken'
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
