# What readers leave out of files that are a little off, each told once.
P='ply\nformat ascii 1.0\n'
XYZ='property float x\nproperty float y\nproperty float z\n'
told() { # FILE
	mr-import "$1" | mr-info | grep -E 'vertices,|points$|texcoord|color|ply_'
}
echo '-- texture coordinates of vertices beside others of corners'
printf "${P}element vertex 3\n${XYZ}property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2 6 0 0 0.5 0 0 0.5\n" >corners.ply
told corners.ply
echo '-- a polygon that touches itself'
printf 'v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nf 1 2 5 3 4 5\n' >touches.obj
told touches.obj
echo '-- names of columns that are cut off, and are all taken'
{ printf "${P}element vertex 1\n${XYZ}"
for i in 1 2 3 4; do printf 'property float %040d%d\n' 0 $i; done
printf 'end_header\n0 0 0 1 2 3 4\n'; } >taken.ply
told taken.ply
echo '-- numbers behind the vertices of an OFF'
printf 'OFF\n3 1 0\n0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n' >numbers.off
told numbers.off
echo '-- bytes behind the end: of an STL, of gzip data, of a glb'
mr-make cube -n 12 -o cube.mrs
mr-export -i cube.mrs cube.stl
printf rest >>cube.stl
told cube.stl
mr-export -i cube.mrs cube.obj && gzip cube.obj
printf rest >>cube.obj.gz
told cube.obj.gz
mr-export -i cube.mrs cube.glb
printf rest >>cube.glb
told cube.glb
echo '-- more points than a PTS counts'
printf '1\n0 0 0\n1 1 1\n2 2 2\n' >more.pts
told more.pts
echo '-- a vertex of a glTF with two colours'
python3 - <<'END'
import base64, json, struct
corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0)]
data = b"".join(struct.pack("<3f", *p) for p in corners) + bytes([255, 0, 0, 255] * 3 + [0, 0, 255, 255] * 3)
accessor = lambda view, kind, component, **more: dict(bufferView=view, componentType=component, count=6, type=kind, **more)
json.dump(dict(asset=dict(version="2.0"), scenes=[dict(nodes=[0])], scene=0, nodes=[dict(mesh=0)],
               meshes=[dict(primitives=[dict(attributes=dict(POSITION=0, COLOR_0=1))])],
               buffers=[dict(byteLength=len(data), uri="data:application/octet-stream;base64," + base64.b64encode(data).decode())],
               bufferViews=[dict(buffer=0, byteOffset=0, byteLength=72), dict(buffer=0, byteOffset=72, byteLength=24)],
               accessors=[accessor(0, "VEC3", 5126, min=[0, 0, 0], max=[1, 1, 0]), accessor(1, "VEC4", 5121, normalized=True)]),
          open("two.gltf", "w"))
END
told two.gltf
echo '-- a polygon of two edges there and back, beside others and alone'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 1 2 1 4\n' >back.obj
told back.obj
grep -v '3$' back.obj >alone.obj
told alone.obj
echo '-- what corners have, as points; a column that is called as one of the format'
mr-make sphere -n 60 --texcoords | mr-export corners.obj
mr-import --points corners.obj | mr-info | grep points$
printf 'x y z x\n0 0 0 5\n1 0 0 6\n' >twice.xyz
mr-import twice.xyz | mr-export -f ply-ascii - | grep property
