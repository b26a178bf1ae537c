# The rows of all frames in one: what refers to others follows, what not all have is said.
cat >square.obj <<'OBJ'
o one
usemtl red
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
f 1/1 2/2 3/2 4/1
OBJ
cat >triangle.obj <<'OBJ'
usemtl blue
o two
v 2 0 0
v 3 0 0
v 2 1 0
vt 0.5 0.5
f 1/1 2/1 3/1
usemtl red
f 1/1 3/1 2/1
OBJ
mr-import square.obj triangle.obj | mr-cat --append | mr-export - -f obj

echo 'detail and base'
for shape in sphere torus; do
	mr-make $shape -n 800 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.3 --handle 0=above:y,0.9 | mr-encode -o $shape.mrs
done
mr-cat --append sphere.mrs torus.mrs -o both.mrs
mr-info --check both.mrs >checked && echo sound
mr-decode both.mrs | mr-compare -a mesh -b mesh --json both.mrs | grep -c '"vertex_max_relative":[0-9.]*e-1[0-9]'
mr-split both.mrs -q | mr-info | grep -E 'frame|vertices,|detail'

echo 'columns that not all have, and layers of one frame'
mr-make sphere --points 50 -o normals.mrs
printf '0 0 0\n1 1 1\n' >plain.xyz
mr-import plain.xyz | mr-cat --append normals.mrs - | mr-info | grep -E '^    (position|normal)'
mr-pose --translate 0,1,0 sphere.mrs -o posed.mrs
mr-cat --append posed.mrs posed.mrs | mr-info | grep -c '^  handles'
mr-cat --append posed.mrs | mr-info | grep -c '^  handles'
mr-make sphere -n 50 | mr-cat --append normals.mrs - | mr-info | grep -E 'points:|mesh:'
mr-cat --append posed.mrs torus.mrs | mr-info | grep -c '^  handles' # handle 0 is of both
mr-select --reset --fixed all torus.mrs | mr-cat --append posed.mrs - | mr-info | grep -c '^  handles'

echo 'a base of one part alone'
mr-make torus -n 100 | mr-smooth -o smooth.mrs
mr-make sphere -n 50 | mr-transform --translate 9,0,0 | mr-cat --append smooth.mrs - | mr-info | grep -E '^  (mesh|base):'
mr-cat --append smooth.mrs smooth.mrs | mr-info | grep -E '^  (mesh|base):' # nothing to say

echo 'a stream of no frames, and one that is cut'
mr-cat --no-history normals.mrs | { head -c 64; tail -c 64 normals.mrs; } | mr-cat --append | mr-info
head -c 500 normals.mrs | mr-cat --append >out
echo "exit $?"

echo 'materials of one name from two files'
sed 's/^o one/mtllib a.mtl/' square.obj >a.obj
sed 's/^o two/mtllib b.mtl/' triangle.obj >b.obj
mr-import a.obj b.obj 2>/dev/null | mr-cat --append | mr-info | grep -c mtllib
mr-import a.obj a.obj 2>/dev/null | mr-cat --append | mr-info | grep -c mtllib # nothing to say
sed 's/b\.mtl/&\nmtllib a.mtl/' b.obj >both.obj
mr-import a.obj both.obj 2>/dev/null | mr-cat --append | mr-info | grep -c mtllib # may be the same

echo 'detail of which one frame has offsets is that of both'
mr-make bumpy -n 3000 -o rough.mrs
mr-make sphere -n 300 | mr-transform --translate 5,0,0 -o beside.mrs
mr-smooth rough.mrs | mr-remesh -q -r 4 | mr-encode -o rough-detail.mrs
mr-smooth beside.mrs | mr-encode -o beside-detail.mrs
mr-info rough-detail.mrs beside-detail.mrs | grep -c detail_offset
for order in 'rough beside' 'beside rough'; do
	set -- $order
	mr-cat --append $1-detail.mrs $2-detail.mrs | mr-decode -o decoded.mrs
	mr-cat --append $1.mrs $2.mrs | mr-compare --json - decoded.mrs | grep -o '"vertex_max":[^,]*' |
	    awk -F: '{ print ($2 < 1e-13 ? "the same" : $2) }'
done

echo 'surfaces of one frame each'
mr-import -l control triangle.obj | mr-cat --append smooth.mrs - | mr-info | grep -E '^  (mesh|base|control):'

echo 'faces without names, texture coordinates or normals stay without'
printf 'v 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\n' >plain.obj
printf 'v 7 0 0\nv 8 0 0\nv 7 1 0\nv 8 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nvn 0 1 1\ng top\nf 1/1/1 2/2/1 3/3/1\nf 2/1/2 4/3/1 3/2/2\n' >grouped.obj
for order in 'plain square grouped' 'grouped plain'; do
	for name in $order; do echo $name.obj; done | xargs mr-import | mr-cat --append -o named.mrs && mr-info --check named.mrs >checked
	mr-export -q -f obj - <named.mrs | grep -v '^#\|^v '
done
printf 'x y z depth\n1 2 3 0.5\n' >depth.xyz
mr-import --points depth.xyz plain.xyz | mr-cat --append | mr-export -q -f ply-ascii - | sed '1,/end_header/d'
