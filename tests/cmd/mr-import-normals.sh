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
cat >n.ply <<'X'
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float nx
property float ny
property float nz
end_header
0 0 0 0 0 1
1 0 0 nan nan nan
0 1 0 0 0 1
X
mr-import --stats - n.obj 2>&1 >n.mrs | sed 's/.*"dropped_normals"/"dropped_normals"/'
mr-export -f obj -i n.mrs - | grep '^[fv][nt]* '
for model in n.off n.ply; do
	mr-import $model | mr-export -q -f xyz -
done
echo '-- where all are none there are none'
sed 's/0 0 1$/nan 0 1/' n.ply | mr-import | mr-export -f xyz -
printf '0 0 0 0 0 1\n1 0 0 nan 0 1\n0 1 0 0 1 0\n' | mr-import -f xyz | mr-export -f xyz -
