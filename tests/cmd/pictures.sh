# Pictures that a GLB brings: in the stream as they are, through tools, drawn without an option, and written again.
cat >make.py <<'END'
import base64, math, sys
from glbs import *
quarters = png(8, 8, lambda x, y: ((255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0))[x // 4 + y // 4 * 2])
bumps = png(8, 8, lambda x, y: (128, 128, 255))
root, data = square([quarters, bumps])
painted, primitive = root["materials"][0], root["meshes"][0]["primitives"][0]
exec(sys.stdin.read())
write(sys.argv[1], root, data)
END
files() {
	mr-info "$@" | grep '^  file '
}
echo '-- as they are, one that no material shows left out'
echo | python3 make.py a.glb
mr-import a.glb -o a.mrs
files a.mrs
mr-export back.glb <a.mrs
python3 -c 'from glbs import *; print(pictures("back.glb") == pictures("a.glb")[:1])'

echo '-- picture and normals; the same picture twice is one; metal, light, transparency; names that are equal' >&2
python3 make.py b.glb <<'END'
painted["normalTexture"] = {"index": 1}
root["materials"] += [{"name": "painted", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.5], "roughnessFactor": 0.25}, "alphaMode": "BLEND",
        "emissiveFactor": [0, 1, 0]}]
root["meshes"][0]["primitives"] += [dict(primitive, material=1), dict(primitive, material=2)]
END
mr-import b.glb -o b.mrs
mr-export -f obj b.obj <b.mrs
ls b*
cat b.mtl
mr-export back.glb <b.mrs
python3 -c '
from glbs import *
root = read("back.glb")[0]
print(pictures("back.glb") == pictures("b.glb"))
for m in root["materials"]:
    print({k: [round(x, 6) for x in v] if isinstance(v, list) else v for k, v in {**m.pop("pbrMetallicRoughness"), **m}.items()})'
mr-import -q back.glb | mr-export again.glb && cmp back.glb again.glb && echo 'written again it is the same'

echo '-- beside an OBJ nothing of others is lost' >&2
mr-export b.obj <b.mrs && echo 'again it may'
echo mine >c-1.png
mr-export c.obj <b.mrs || cat c-1.png
echo mine >d.mtl
mr-export d.obj <b.mrs || cat d.mtl
mr-export -f obj - <b.mrs | grep -c mtllib
ls c* d*

echo '-- drawn, in the page and baked without an option, which wins'
mr-render --no-labels -s 64x64 a.png <a.mrs
mr-export e.obj <a.mrs && mr-render --no-labels -s 64x64 --materials . e.png e.obj
cmp a.png e.png && echo same
python3 -c 'from glbs import *; open("other.png", "wb").write(png(1, 1, lambda x, y: (9, 9, 9)))'
mr-render --no-labels -s 64x64 --texture other.png f.png <a.mrs && cmp -s a.png f.png || echo 'another picture'
mr-view a.html a.mrs && grep -c '"picture"' a.html
mr-make plane -n 50 -o plain.mrs
mr-map --bake a.mrs -w baked --size 64 plain.mrs | mr-export --materials . baked.glb
ls baked*

echo '-- what has texture coordinates or materials, and no colours, is not baked' >&2
mr-make sphere -n 60 --texcoords -o bare.mrs
mr-map --bake bare.mrs -w no --size 64 plain.mrs >out || ls no* 2>/dev/null
mr-map --bake bare.mrs --texture other.png -w one --size 64 plain.mrs >out && ls one*
mr-make sphere -n 60 -o normals.mrs
mr-map --bake normals.mrs -w two --size 64 plain.mrs >out && ls two*

echo '-- through tools, and frames put together: the same file is there once'
mr-subdivide -n 2 a.mrs | mr-simplify -q -r 0.5 | mr-transform --rotate 0,0,1,30 | mr-cat -z | mr-cat -u | mr-export back.glb
python3 -c 'from glbs import *; print(pictures("back.glb") == pictures("a.glb")[:1])'
mr-import -l other a.glb | mr-cat --merge a.mrs - | files
mr-import b.glb | mr-cat --append a.mrs - | files
mr-import -q --points a.glb | files

echo '-- KHR_texture_transform, and the texture coordinates that a picture names'
corners() {
	mr-import g.glb | mr-export -q -f obj - | awk '/^vt/ { printf "%.4f %.4f, ", $2 + 1e-9, $3 + 1e-9 } END { print "" }'
}
for change in '{}' '{"offset": [0.5, 0.25]}' '{"scale": [2, 3]}' '{"rotation": math.pi / 2}' \
    '{"offset": [0.5, 0.25], "rotation": math.pi / 2, "scale": [2, 3]}' '{"scale": [2]}' '{"offset": "x", "rotation": []}'; do
	echo "painted['pbrMetallicRoughness']['baseColorTexture']['extensions'] = {'KHR_texture_transform': $change}" | python3 make.py g.glb
	corners
done
python3 make.py g.glb <<'END'
primitive["attributes"]["TEXCOORD_1"] = primitive["attributes"].pop("TEXCOORD_0")
painted["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1
END
corners
python3 make.py g.glb <<'END'
root["materials"].append({"name": "turned", "pbrMetallicRoughness": {"baseColorTexture": {"index": 1,
    "extensions": {"KHR_texture_transform": {"offset": [5, 0]}}}}})
root["accessors"] += [dict(root["accessors"][2], count=3), dict(root["accessors"][2], count=3, byteOffset=6)]
primitive["indices"] = 3
root["meshes"][0]["primitives"].append(dict(primitive, material=1, indices=4))
END
corners

echo '-- in data URIs, beside the document, and what cannot be had' >&2
had() {
	python3 make.py h.glb && mr-import h.glb | files | grep -c png
}
had <<'END'
root["images"][0] = {"uri": "data:image/png;base64," + base64.b64encode(quarters).decode()}
END
cp baked-color.png 'a b.png'
had <<'END'
root["images"][0] = {"uri": "a%20b.png"}
END
for wrong in 'images[0] = {"uri": "../a%20b.png.no"}' 'images[0] = {"uri": "data:image/png;base64,!"}' 'images[0] = {"bufferView": 9}' \
    'images[0] = {}' 'images[0] = 3' 'textures[0]["source"] = 7' 'textures[0] = {}' 'textures = []' 'bufferViews[3]["byteLength"] = 1 << 40' \
    'bufferViews[3]["byteOffset"] = -1' 'bufferViews[3]["byteLength"] = 5'; do
	case $wrong in
	*' = []') echo "root['textures'] = []" ;;
	*) echo "root['${wrong%%[[ ]*}']${wrong#"${wrong%%[[ ]*}"}" ;;
	esac | had
done

echo '-- damaged pictures are kept as they are, and told of where they are to be seen' >&2
echo 'root["bufferViews"][3]["byteLength"] = 50' | python3 make.py i.glb
mr-import i.glb -o i.mrs && files i.mrs
mr-render -s 32x32 i.png <i.mrs && mr-view i.html i.mrs && mr-export i.glb <i.mrs
mr-map --bake i.mrs -w no --size 64 plain.mrs
echo "exit $?"
