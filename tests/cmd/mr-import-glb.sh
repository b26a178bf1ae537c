# GLB and glTF: what is left out is named; what is not in the file, and what is of no use, is refused in a sentence.
document() { # nodes, more members, uri, primitive
	cat <<END
{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[${1:-"{\"mesh\":0}"}]$2,
"meshes":[{"primitives":[${4:-"{\"attributes\":{\"POSITION\":0}}"}]}],
"buffers":[{"byteLength":36${3-,\"uri\":\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]}
END
}
document >a.gltf
mr-import a.gltf | mr-info | grep -E 'vertices|box'
document >b.gltf '{"children":[1,2],"scale":[2,2,2]},{"mesh":0,"name":"left"},{"mesh":0,"name":"right","translation":[5,0,0]}'
mr-import b.gltf | mr-info | grep -E 'vertices|box|object'
mr-import b.gltf | mr-export -f obj - | grep '^[ovf] '

echo '-- what is left out'
document >c.gltf '' ',"animations":[{}],"cameras":[{},{}],"skins":[{}],"images":[{"uri":"wood.png"}]'
mr-import c.gltf | mr-info | grep vertices
mr-import -q c.gltf >/dev/null
document >d.gltf '' '' "$(document | grep -o ',"uri[^}]*')" '{"mode":1,"attributes":{"POSITION":0}},{"attributes":{"POSITION":0,"TEXCOORD_1":0},"targets":[{}]}'
mr-import d.gltf >/dev/null

echo '-- a buffer in a file beside the model, under an escaped name, and no other file'
mkdir beside
document >beside/a.gltf '' '' ',"uri":"my%20parts%2B1.bin"'
sed -n 's/.*base64,\([^"]*\).*/\1/p' a.gltf | base64 -d >'beside/my parts+1.bin'
mr-import a.gltf | mr-export -f obj a.obj
mr-import beside/a.gltf | mr-export -f obj - | cmp - a.obj
for uri in '../beside/my%20parts%2B1.bin' '%2e%2e/secret' "$PWD/beside/my parts+1.bin" 'absent%2' 'http://x.org/my%20parts%2B1.bin'; do
	document >beside/e.gltf '' '' ',"uri":"'"$uri"'"'
	mr-import beside/e.gltf 2>&1 >/dev/null | grep -o 'buffer.*' || echo "$uri is read" | sed "s,$PWD,,"
done
mr-import <beside/a.gltf

echo '-- what is refused'
refused() {
	mr-import "$1" >out
	echo "exit $?, $(wc -c <out) bytes"
}
document >e.gltf '' '' ''
refused e.gltf
document >e.gltf '' '' ',"uri":"parts.bin"'
refused e.gltf
document >e.gltf '{"children":[1]},{"children":[0],"mesh":0}'
refused e.gltf
document >e.gltf '' ',"extensionsRequired":["KHR_gaussian_splatting"]'
refused e.gltf
document >e.gltf '{"camera":0}'
refused e.gltf
document | head -c 300 >e.gltf
refused e.gltf
mr-make torus -n 300 | mr-export t.glb
head -c 5000 t.glb >e.glb
refused e.glb
head -c 16 t.glb >e.glb
refused e.glb

echo '-- without scenes all meshes are shown as they are'
document '{"children":[1]},{"mesh":0,"translation":[5,0,0]},{"mesh":0,"scale":[2,2,2]}' | sed 's/"scenes":[^]]*\]}\],//' >f.gltf
mr-import f.gltf | mr-export -f obj - | grep '^[vf] '
document | sed 's/"scenes":[^]]*\]}\],//; s/"nodes":[^]]*\],*/"nodes":[],/' >f.gltf
mr-import f.gltf | mr-export -f obj - | grep '^[vf] '
