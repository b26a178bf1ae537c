# GLB that other programs packed, and ours: read as it was; what is damaged, or cannot be, is refused in a sentence.
mr-make sphere -n 500 -o sphere.mrs
surface() {
	mr-import -q "$1" | mr-compare --json sphere.mrs | grep -o '"both_relative":{"hausdorff":[^,]*' | sed 's/.*://; s/[0-9.]*e/e/'
}
echo '-- meshoptimizer'
mr-export -i sphere.mrs plain.glb
mr-export -i sphere.mrs --compress packed.glb
mr-export -i sphere.mrs --compress --quantize few.glb
surface packed.glb
surface few.glb
for file in packed few; do
	[ $(($(wc -c <$file.glb) * 4)) -lt $(($(wc -c <plain.glb) * 3)) ] && echo "$file is smaller"
done
mr-import packed.glb | mr-info | grep -E 'vertices|normal '
mr-make knot --points 500 | mr-export --compress --quantize points.glb
mr-import points.glb | mr-info | grep -E 'points$|normal '

echo '-- damaged'
cat >damage.py <<'P'
import json, struct, sys
data = open("packed.glb", "rb").read()
size = struct.unpack("<I", data[12:16])[0]
doc = json.loads(data[20:20 + size])
view = doc["bufferViews"][int(sys.argv[1])]
(view if sys.argv[2] == "view" else view["extensions"]["EXT_meshopt_compression"])[sys.argv[3]] = json.loads(sys.argv[4])
text = json.dumps(doc).encode()
text += b" " * (-len(text) % 4)
rest = data[20 + size:]
sys.stdout.buffer.write(data[:8] + struct.pack("<III", 20 + len(text) + len(rest), len(text), 0x4e4f534a) + text + rest)
P
refused() { # view, of it or its extension, key, value
	python3 damage.py "$@" >bad.glb
	mr-import bad.glb 2>&1 >/dev/null | sed 's/.*buffer view/buffer view/'
}
refused 0 packed byteLength 100
refused 0 packed byteLength 10
refused 0 packed byteLength 100000000
refused 0 packed byteOffset 8
refused 0 packed count 4000000000
refused 0 packed count 251
refused 0 packed byteStride 10
refused 0 packed byteStride 0
refused 0 packed mode '"NONE"'
refused 0 packed mode 7
refused 0 packed filter '"OCTAHEDRAL"'
refused 0 packed filter '"WARM"'
refused 0 packed buffer 1
refused 0 view byteLength 100
refused 2 packed mode '"ATTRIBUTES"'
refused 2 packed byteLength 40

echo '-- Draco'
draco() { # base 64 of the mesh, its bytes, the attribute, the accessor's count
	cat <<END
{"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"],"meshes":[{"primitives":[{"attributes":
{"POSITION":0},"indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":${3:-0}}}}}]}],
"accessors":[{"componentType":5126,"count":${4:-4},"type":"VEC3"},{"componentType":5125,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":$2}],"buffers":[{"byteLength":76,"uri":"data:;base64,$1"}]}
END
}
mesh=RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/wAAAQAJAwAAAgEBAQADAwEQATADAFCCJJEEAAAAAP8HAAAAAAAAAAAAAAAAAAAAAIA/Cw==
draco $mesh 76 >tetra.gltf
if mr-import tetra.gltf 2>&1 >tetra.mrs | grep -q 'built without libdraco'; then
	sed '1,/^-- Draco/d' "$TOP/tests/cmd/mr-import-packed.out" # as it is with it
	exit
fi
mr-export -i tetra.mrs -f obj - | grep '^[vf] '
draco $mesh 50 >cut.gltf
draco $mesh 76 7 >absent.gltf
draco $mesh 76 0 5 >count.gltf
draco "$(printf '%s' $mesh | tr AB BA)" 76 >other.gltf
for file in cut absent count other; do
	mr-import $file.gltf 2>&1 >/dev/null | cat
done
