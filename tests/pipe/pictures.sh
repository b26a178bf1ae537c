# A GLB of two charts with a picture, simplified: the picture's bytes, and at every corner the texture coordinates of its place.
cat >chart.py <<'END'
import struct, sys
from glbs import *


def make(path, n):
    """A hilly square: u is half of x left of the middle and 1 more right of it, v is y."""
    rows, index = [], []
    for chart in (0, 1):
        first = len(rows)
        rows += [(chart + i / n, 2 * j / n, 0.1 * ((i + chart * n) % 3)) for j in range(n + 1) for i in range(n + 1)]
        for j in range(n):
            for i in range(n):
                a = first + j * (n + 1) + i
                index += [a, a + 1, a + n + 2, a, a + n + 2, a + n + 1]
    uv = [texcoord(x, y, k // ((n + 1) * (n + 1))) for k, (x, y, z) in enumerate(rows)]
    parts = [struct.pack("<3f", *p) for p in rows], [struct.pack("<2f", u, v) for u, v in uv], [struct.pack("<I", i) for i in index]
    parts = [b"".join(part) for part in parts]
    root, _ = square([b""])
    data = b"".join(parts)
    picture = png(32, 32, lambda x, y: (8 * x, 8 * y, 255 * ((x ^ y) & 1)))
    at = 0
    for i, part in enumerate(parts + [picture]):
        root["bufferViews"][i] = {"buffer": 0, "byteOffset": at, "byteLength": len(part)}
        at += len(part)
    root["buffers"] = [{"byteLength": at + -at % 4}]
    for i, n in enumerate((len(rows), len(rows), len(index))):
        root["accessors"][i]["count"] = n
    root["accessors"][2]["componentType"] = 5125
    write(path, root, data + picture)


def texcoord(x, y, chart):
    return x / 2 + chart, 1 - y / 2


def rows(root, data, number, kind, n):
    a = root["accessors"][number]
    view = root["bufferViews"][a["bufferView"]]
    start, step = view.get("byteOffset", 0) + a.get("byteOffset", 0), view.get("byteStride", struct.calcsize("<%d%s" % (n, kind)))
    return [struct.unpack_from("<%d%s" % (n, kind), data, start + i * step) for i in range(a["count"])]


def check(path, original):
    root, data = read(path)
    assert pictures(path) == pictures(original), "another picture"
    count = 0
    for primitive in (p for mesh in root["meshes"] for p in mesh["primitives"]):
        assert root["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorTexture"] == {"index": 0}
        places = rows(root, data, primitive["attributes"]["POSITION"], "f", 3)
        uv = rows(root, data, primitive["attributes"]["TEXCOORD_0"], "f", 2)
        kind = "H" if root["accessors"][primitive["indices"]]["componentType"] == 5123 else "I"
        corners = [i for i, in rows(root, data, primitive["indices"], kind, 1)]
        for face in zip(corners[::3], corners[1::3], corners[2::3]):
            chart = int(sum(places[i][0] for i in face) > 3)
            for i in face:
                (x, y, _), (u, v), (right, down) = places[i], uv[i], texcoord(places[i][0], places[i][1], chart)
                assert abs(u - right) < 1e-5 and abs(v - down) < 1e-5, (x, y, u, v, right, down)
            count += 1
    print(count, "faces")


make(sys.argv[1], 16) if len(sys.argv) == 2 else check(*sys.argv[1:])
END
python3 chart.py in.glb
mr-import in.glb | mr-export same.glb && python3 chart.py same.glb in.glb
mr-import in.glb | mr-simplify -q -r 0.1 | mr-export few.glb && python3 chart.py few.glb in.glb
mr-import -q few.glb | mr-export again.glb && cmp few.glb again.glb
mr-import in.glb | mr-simplify -q -r 0.1 | mr-export few.obj
mr-import few.obj | mr-export --materials . other.glb && python3 chart.py other.glb in.glb
