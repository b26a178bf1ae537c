# What a glTF has and a model has no place for is counted by its name; what only an extension can read is refused.
cat >make.py <<'END'
import base64, json, struct, sys
numbers = [0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5, 0, 0, 1, 0, 0, 1, 1, 1]
data = struct.pack("<20f4B", *numbers, 1, 3, 1, 0)
root = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0}]}],
    "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
        {"bufferView": 1, "byteOffset": 32, "componentType": 5121, "count": 3, "type": "SCALAR"}]}
primitive = root["meshes"][0]["primitives"][0]
exec(sys.stdin.read())
json.dump(root, open(sys.argv[1], "w"))
END
make() {
	python3 make.py a.gltf
}
refused() {
	mr-import a.gltf >out
	echo "exit $?, $(wc -c <out) bytes"
}
echo '-- what is packed, whether the file says that it needs the extension or not'
make <<'END'
primitive["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0}}
END
mr-import a.gltf | mr-info | grep box
make <<'END'
primitive["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0}}
root["accessors"][0].pop("bufferView")
END
mr-import a.gltf 2>&1 >out | grep -o KHR_draco_mesh_compression # with the library or without
make <<'END'
root["buffers"].append({"byteLength": 48, "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
root["bufferViews"][0]["buffer"] = 1
END
refused

echo '-- rows without values'
make <<'END'
root["accessors"] = [{"componentType": 5126, "count": 250, "type": "VEC3"}]
root["meshes"][0]["primitives"] = 3 * [{"attributes": {"POSITION": 0}, "mode": 0}]
END
refused

echo '-- what is counted' >&2
make <<'END'
primitive["attributes"].update({"TANGENT": 0, "COLOR_1": 0, "COLOR_2": 0, "TEXCOORD_2": 1, "JOINTS_0": 0, "_HEAT": 0})
primitive["attributes"].update({"_%02d" % i: 0 for i in range(20)})
root["meshes"].append(dict(root["meshes"][0]))
root["nodes"] = [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}, {"mesh": 0}, {}]
root["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}, {"emissiveFactor": [0, 0, 0]},
    {"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0}}, {"emissiveFactor": [0, 0, 1]}]
END
mr-import a.gltf >/dev/null
make <<'END'
primitive["attributes"].update({"JOINTS_0": 0, "WEIGHTS_0": 0})
root["skins"] = [{}]
END
mr-import a.gltf >/dev/null

echo '-- colours that a byte does not tell, that are beyond white, or no numbers' >&2
for colors in '0, 1, 0.2158605, 0.5, 2, 0, 1e-6, -1, 1, 0, 0, 0' '0, 0, float("nan"), 1, 1, 1, 0, 0, 0, 1, 1, 1'; do
	make <<-END
	data += struct.pack("<12f", $colors)
	root["buffers"][0] = {"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}
	root["bufferViews"].append({"buffer": 0, "byteOffset": 84, "byteLength": 48})
	root["accessors"].append({"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3"})
	primitive["attributes"]["COLOR_0"] = 3
	END
	mr-import a.gltf | mr-export -f ply-ascii - | tail -n 4
done

echo '-- names with ends of lines, and other control characters' >&2
make <<'END'
primitive.pop("mode")
root["accessors"][0]["count"] = root["accessors"][1]["count"] = 3
root["nodes"][0]["name"] = "two\nlines\x01"
root["materials"] = [{"name": "a\rb"}, {"name": "c"}]
END
mr-import a.gltf -o a.mrs
mr-export b.glb <a.mrs
grep -a -o '"name":"[^"]*"' b.glb

places() { # of the points, without what rounding leaves
	mr-export -q -f xyz - | awk 'function near(x) { return int(1e6 * x + (x < 0 ? -0.5 : 0.5)) / 1e6 + 0 } { print near($1), near($2), near($3) }'
}
echo '-- rotations that are not of unit length: a quarter turn, with few digits; one that is none' >&2
for q in '0, 0, 0.7071067811865476, 0.7071067811865476' '0, 0, 2, 2' '0, 0, 0.7071, 0.7071' '0, 0, 0, 0'; do
	echo "-- $q"
	echo "root['nodes'][0]['rotation'] = [$q]" | make
	mr-import a.gltf >a.mrs && places <a.mrs
done

echo '-- points beside a surface' >&2
mr-make cylinder -n 800 -o edges.mrs
mr-make knot --points 40 | mr-cat --merge edges.mrs - | mr-export -l mesh,points both.glb
mr-import both.glb | mr-info | grep -E 'vertices,|isolated'

echo '-- how materials look but for their colour, lights, variants and extras' >&2
make <<'END'
primitive.pop("mode")
root["accessors"][0]["count"] = root["accessors"][1]["count"] = 3
plain = {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.9}, "alphaMode": "OPAQUE"}
root["materials"] = [plain, {"pbrMetallicRoughness": {"metallicFactor": 0.3}}, {"alphaMode": "MASK"}, {"extensions": {"KHR_materials_unlit": {}}}]
root["extensions"] = {"KHR_lights_punctual": {"lights": [{}, {}]}, "KHR_materials_variants": {"variants": [{}]}}
root["nodes"][0]["extras"] = {"a": 1}
END
mr-import a.gltf | mr-export -f ply-ascii - | grep element

echo '-- extensions of which nothing is known, and a map that is not affine' >&2
make <<'END'
root["extensions"] = {"KHR_xmp_json_ld": {"packets": [{}]}}
root["nodes"][0]["extensions"] = {"KHR_node_visibility": {"visible": False}}
primitive["extensions"] = {"ACME_wear": {}}
END
mr-import a.gltf | mr-export -f xyz - | wc -l
make <<'END'
root["nodes"][0]["matrix"] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]
END
refused
