# GLB: seams, materials and objects come back; layers, frames and poses in one file; pictures of materials.
json() { # FILE: the first chunk
	tail -c +21 "$1" | head -c "$(od -An -tu4 -j12 -N4 "$1")"
}
has() { # FILE, pattern...
	file=$1
	shift
	for pattern; do
		json "$file" | grep -q "$pattern" && echo "has $pattern" || { echo "$file has not $pattern"; json "$file"; }
	done
}
cat >box.obj <<'END'
mtllib box.mtl
o lid
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 0.5 0
vt 0.5 0.5
vt 0 0.75
vt 1 1
vn 0 0 1
usemtl wood
f 1/1/1 2/2/1 3/3/1
usemtl steel
f 1/5/1 3/3/1 4/4/1
END

echo '-- a seam: four vertices, five in the file; two materials of one object'
mr-import box.obj -o box.mrs
mr-export -i box.mrs plain.glb
mr-import plain.glb -o back.mrs
for file in box back; do
	mr-info $file.mrs | grep -E 'vertices|corner_|material|object'
done
mr-export -i back.mrs -f obj - | grep -v '^#'
has plain.glb '"name":"wood"' '"name":"steel"' '"name":"lid"' '"metallicFactor":0'

echo '-- files of materials: pictures as they are, colours, and what is not there'
mr-make sphere -n 100 | mr-render -s 32x32 --no-labels grain.png
cat >box.mtl <<'END'
newmtl wood
map_Kd -s 1 1 1 -clamp on C:\pictures\grain.png
newmtl steel
Kd 0.5 0.5 1
map_Kd missing.png
END
mr-export -i box.mrs full.glb
echo "exit $?"
has full.glb '"mimeType":"image/png"' '"name":"grain.png"' '"baseColorTexture":{"index":0}' '0.2140411'
mkdir elsewhere && mv box.mtl elsewhere && cp grain.png elsewhere
mr-export -i box.mrs --materials elsewhere same.glb 2>/dev/null
cmp full.glb same.glb && echo same
mr-import full.glb -o back.mrs
mr-info back.mrs | grep -E 'materials|corner_texcoord'

echo '-- several layers, and a cloud'
mr-make torus -n 300 -o torus.mrs
mr-make knot --points 70 -o points.mrs
mr-cat --merge torus.mrs points.mrs | mr-export -l mesh,points layers.glb
has layers.glb '"name":"mesh"' '"name":"points"' '"mode":0'
mr-export -i points.mrs points.glb
mr-import points.glb | mr-info | grep -E 'points$|normal'

echo '-- poses are morph targets of one node, another key frame is a node of its own'
mr-select --free all --handle 0=above:z,0.2 torus.mrs | mr-smooth | mr-solve --basis | mr-encode |
    mr-pose --frames 3 --translate 0,0,1 | mr-decode -o poses.mrs
mr-export -i poses.mrs poses.glb
has poses.glb '"path":"weights"' '"targets":\[\({"POSITION":[0-9]*,"NORMAL":[0-9]*},*\)\{3\}\]' '"max":\[0.125\]'
mr-import poses.glb | mr-info | grep vertices
mr-make cube -n 50 | mr-cat poses.mrs - | mr-export both.glb
has both.glb '"nodes":\[0,1\]' '"name":"torus"' '"name":"cube"'
mr-export -i poses.mrs 'pose-%d.glb'
ls pose-*
mr-export -i poses.mrs -f glb - | cmp - poses.glb && echo 'same on stdout'
mr-export -i poses.mrs poses.glb.gz && gunzip <poses.glb.gz | cmp - poses.glb && echo 'same in gzip'

echo '-- normals by default, split at creases; none where none are wanted'
mr-make cube -n 12 -o cube.mrs
mr-export -i cube.mrs cube.glb && has cube.glb '"count":24' '"NORMAL":1'
mr-export -i cube.mrs --no-normals cube.glb && has cube.glb '"count":8' && json cube.glb | grep -c NORMAL
mr-import box.obj | mr-export -q --no-normals flat.glb && json flat.glb | grep -c NORMAL
mr-make sphere -n 300 | mr-export sphere.glb && mr-import sphere.glb | mr-info | grep 'normal '

echo '-- few bits'
mr-make sphere -n 300 --texcoords -o sphere.mrs
mr-export -i sphere.mrs --quantize few.glb
has few.glb '"KHR_mesh_quantization"' '"componentType":5123,"count":[0-9]*,"type":"VEC3"' \
    '"componentType":5120,"normalized":true,"count":[0-9]*,"type":"VEC3"' \
    '"componentType":5126,"count":[0-9]*,"type":"VEC2"' '"scale"'
mr-export -q -i box.mrs --quantize few-box.glb
has few-box.glb '"componentType":5123,"normalized":true,"count":[0-9]*,"type":"VEC2"'
mr-import few-box.glb | mr-export -f obj - | grep '^vt'
mr-import few.glb | mr-compare --json sphere.mrs | grep -o '"both_relative":{"hausdorff":[0-9.]*e-0[5-9]' | tr -d 0-9.
mr-make torus -n 300 | mr-transform --translate 1e6,0,0 | mr-export -q --quantize far.glb
mr-import -q far.glb | mr-transform --translate -1e6,0,0 | mr-info | grep box
printf '0 0 0\n' | mr-import -f xyz | mr-export --quantize one.glb && mr-import one.glb | mr-export -f xyz -
mr-export -i poses.mrs --quantize moved.glb
has moved.glb '"componentType":5122' && mr-import -q moved.glb | mr-compare -q --json torus.mrs | grep -o '"both_relative":{"hausdorff":[0-9.]*e-0[5-9]' | tr -d 0-9.

echo '-- poses that move little take few bytes'
mr-make sphere -n 3000 | mr-select --free all --fixed below:z,0.9 --handle 0=above:z,0.97 | mr-smooth | mr-solve --basis | mr-encode |
    mr-pose --frames 3 --translate 0,0,0.3 | mr-decode -o tip.mrs
mr-export -q -i tip.mrs tip.glb
has tip.glb '"sparse":{"count":[0-9]*,"indices":{"bufferView":[0-9]*,"componentType":5123},"values":{"bufferView":[0-9]*}}'

echo '-- packed'
mr-export -q -i tip.mrs --quantize --compress tip-packed.glb
has tip-packed.glb '"EXT_meshopt_compression":{"buffer":0,' '"mode":"TRIANGLES"' '"fallback":true'
[ $(($(wc -c <tip-packed.glb) * 3)) -lt "$(wc -c <tip.glb)" ] && echo 'a third'

echo '-- JSON, bytes and pictures as files'
mkdir apart
mr-export -i box.mrs --materials elsewhere 'apart/a box.gltf' 2>/dev/null
ls apart && grep -o '"uri":"[^"]*"' 'apart/a box.gltf' && cmp grain.png 'apart/a box-1.png'
mr-import -q 'apart/a box.gltf' | mr-export -q -f obj - >apart.obj && mr-import -q full.glb | mr-export -q -f obj - | cmp - apart.obj && echo same
mr-export -i torus.mrs apart/torus.gltf.gz && mr-import apart/torus.gltf.gz | mr-info | grep vertices && ls apart
mr-export -i tip.mrs -q --compress apart/tip.gltf && mr-import -q apart/tip.gltf | mr-info | grep vertices

echo '-- levels of detail'
mr-simplify -n 200 torus.mrs -o less.mrs && mr-simplify -n 100 torus.mrs -o least.mrs
mr-cat torus.mrs less.mrs least.mrs | mr-export --lods lods.glb
has lods.glb '"extensions":{"MSFT_lod":{"ids":\[1,2\]}}' '"nodes":\[0\]' '"extensionsUsed":\["MSFT_lod"\]'
mr-import -q lods.glb | mr-info | grep vertices
mr-export -i torus.mrs --lods one.glb && json one.glb | grep -c MSFT
printf 'o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nf 1 3 2\n' | mr-import -q -o two.mrs
mr-cat torus.mrs two.mrs | mr-export --lods odd.glb
echo "exit $?"

echo '-- a base has what its mesh came with, as in any format'
mr-make sphere -n 300 --texcoords | mr-smooth | mr-export base.glb
mr-import base.glb | mr-info | grep texcoord

echo '-- what fails leaves no file'
head -c -64 poses.mrs >endless.mrs
mr-export -i endless.mrs cut.glb
echo "exit $?"
mr-export -i torus.mrs -l mesh,control cut.glb
echo "exit $?"
mr-export -i torus.mrs --materials . cut.obj
echo "exit $?"
mr-export -i torus.mrs -f gltf -
echo "exit $?"
mr-export -i torus.mrs -f glb /dev/full
echo "exit $?"
ls cut* 2>/dev/null

echo '-- a delta that changes colours is no pose'
cat >delta.py <<'P'
import struct, sys
from records import frame, record
stream = sys.stdin.buffer.read()
end = stream.rindex(b"END\0") - 16
columns = {"color": record(b"mesh", b"color", b"vb\4", 3, bytes([255, 0, 0, 255]) * 3),
           "normal": record(b"mesh", b"normal", b"vd\3", 3, struct.pack("<9d", *3 * [0, 0, 1]))}
delta = frame(b"delta red", columns[sys.argv[1]])
sys.stdout.buffer.write(stream[:end] + delta + stream[end:])
P
printf 'v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\n' >white.obj
mr-import white.obj | python3 delta.py color >colors.mrs
mr-export -i colors.mrs colors.glb && mr-import colors.glb | mr-export -q -f obj - | grep -c -e '1 0 0$' -e '1 1 1$'

echo '-- nor has a file normals of poses alone'
mr-import white.obj | python3 delta.py normal | mr-export --no-normals normals.glb
mr-import normals.glb | mr-info | grep -c 'normal '

echo '-- nor does it move on to a frame with other triangles'
mr-make torus -n 500 | mr-select --free all --handle 0=above:x,0.8 | mr-smooth | mr-encode | mr-pose -F 3 --rotate 1,0,0,60 |
    mr-solve | mr-decode -q | mr-crop -q -l mesh --keep above:y,0.5 | mr-export apart.glb && mr-import apart.glb | mr-info | grep -c faces

echo '-- what only some corners of a triangle, or some points, have'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2 3\nf 1/1/1 3/2/1 4/3/1\n' >some.obj
mr-import some.obj | mr-export some.glb && mr-import some.glb | mr-export -f obj - | grep '^[vf][nt ]* .*/\|^f'
mr-make sphere --points 20 | mr-export -f xyz - | awk 'NR == 3 { $4 = $5 = $6 = 0 } { print } BEGIN { print "# x y z nx ny nz" }' >some.xyz
mr-import -q --points some.xyz | mr-export some.glb && mr-import some.glb | mr-info | grep -c normal
