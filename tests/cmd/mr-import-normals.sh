# A normal that is no number goes alone: the others stay, and a surface gets it from its faces.
cat >n.obj <<'X'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt nan 0
vt 1 1
vn 0 0 1
vn 0 nan 1
f 1/1/1 2/2/1 3/3/2
f 1/1/1 3/3/2 4/9/7
X
cat >n.off <<'X'
NOFF
4 2 0
0 0 0 0 0 1
1 0 0 0 nan 1
1 1 0 0 0 1
0 1 0 inf 0 1
3 0 1 2
3 0 2 3
X
ply() { # properties of a vertex; what follows them comes from stdin
	printf 'ply\nformat ascii 1.0\nelement vertex 3\n'
	printf 'property float %s\n' "$@"
	cat
}
ply x y z nx ny nz >n.ply <<'X'
end_header
0 0 0 0 0 1
1 0 0 nan nan nan
0 1 0 0 0 1
X
mr-import --stats - n.obj 2>&1 >n.mrs | sed 's/.*"findings"/"findings"/'
mr-export -f obj -i n.mrs - | grep '^[fv][nt]* '
for model in n.off n.ply; do
	mr-import $model | mr-export -q -f xyz -
done
echo '-- where all are none there are none'
sed 's/0 0 1$/nan 0 1/' n.ply | mr-import | mr-export -f xyz -
printf '0 0 0 0 0 1\n1 0 0 nan 0 1\n0 1 0 0 1 0\n' | mr-import -f xyz | mr-export -f xyz -

echo '-- colours and texture coordinates that are no numbers are counted'
ply x y z s t red green blue >c.ply <<'X'
element face 1
property list uchar int vertex_indices
end_header
0 0 0 nan 0 1 1 1
1 0 0 1 inf 1 nan 1
0 1 0 0 1 1 1 1
3 0 1 2
X
printf 'STCOFF\n3 1 0\n0 0 0 1 1 1 1 nan 0\n1 0 0 1 nan 1 1 1 0\n0 1 0 1 1 1 1 0 1\n3 0 1 2\n' >c.off
printf 'v 0 0 0 1 nan 1\nv 1 0 0 1 1 1\nv 0 1 0 0 0 nan\nf 1 2 3\n' >c.obj
for model in c.ply c.off c.obj; do
	mr-import --stats - $model 2>&1 >/dev/null | sed 's/,"seconds.*,"findings/ .../'
done
echo '-- and normals and texture coordinates of a glTF'
python3 - <<'END'
import base64, json, struct
nan = float("nan")
data = struct.pack("<24f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, nan, 0, 1, 0, 0, 1, 0, 0, 1, nan, 0, 1)
view = lambda at, n: {"buffer": 0, "byteOffset": at, "byteLength": n}
rows = lambda i, kind: {"bufferView": i, "componentType": 5126, "count": 3, "type": kind}
json.dump({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "rotation": [1, 0, 0, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}]}],
    "buffers": [{"byteLength": 96, "uri": "data:;base64," + base64.b64encode(data).decode()}],
    "bufferViews": [view(0, 36), view(36, 36), view(72, 24)], "accessors": [rows(0, "VEC3"), rows(1, "VEC3"), rows(2, "VEC2")]}, open("n.gltf", "w"))
END
mr-import n.gltf | mr-export -f obj - | grep '^[fv][nt]* '

echo '-- of an OBJ whose faces name none: as many as vertices are theirs, others are counted'
part() { # lines more
	printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 5 5\n'
	printf "$1"
}
part 'vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1 2 3\n' >v.obj
mr-import v.obj | mr-export -f obj - | grep '^[fv][nt]* '
grep -v f v.obj | mr-import -f obj | mr-info | grep -o 'normal\|texcoord'
part 'vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt nan 1\nf 1 2 3\n' >v.obj
mr-import v.obj | mr-export -f obj - | grep '^[fv][nt]* '
part 'vn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 0\nvt nan 0\nf 1//1 2//1 3//1\n' >v.obj
mr-import v.obj | mr-export -f obj - | grep '^[fv][nt]* '
part 'vn 0 0 1\nvn 0 1 0\n' >v.obj
mr-import v.obj | mr-info | grep normal
echo '-- zeros of a vertex without a face are none; those that a corner names are said' >&2
part 'vn 0 0 1\nvn 0 0 0\nf 1//1 2//1 3//1\n' >v.obj
mr-import v.obj | mr-export one.obj
grep '^vn' one.obj
mr-import one.obj | mr-export two.obj
cmp one.obj two.obj && echo same
part 'vn 0 0 1\nvn 0 0 0\nf 1//1 2//1 3//2\n' >v.obj
mr-import v.obj >/dev/null

echo '-- the fourth number of a colour'
printf 'v 0 0 0 1 0 0 0.5\nv 1 0 0 1 0 0\nv 0 1 0 0 0 1 0\nf 1 2 3\n' | mr-import -f obj | mr-export -f ply-ascii - | tail -n 4
printf 'v 0 0 0 255 0 0 1\nv 1 0 0 1 0 0 0\nv 0 1 0 0 0 1 nan\nf 1 2 3\n' | mr-import -f obj | mr-export -f ply-ascii - | tail -n 4

echo 'twice as many rows as counted are points and normals where these have a length of 1'
printf '2\n0 0 0\n1 0 0\n0 0 1\n0 .6 .8\n' | mr-import | mr-export -f xyz -
printf '2\n0 0 0\n1 0 0\n5 5 5\n6 6 6\n' | mr-import | mr-export -f xyz -
echo 'a PCD whose text has nan for a colour, as four bytes in a float may be'
printf 'VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n0 0 0 nan\n1 1 1 2.3418e-38\n' >nan.pcd
mr-import nan.pcd | mr-export -f ply-ascii - | sed '1,/end_header/d'
