"""same-model.py A B: whether B says what A says, two models of one format, read by nothing of mr's.

Numbers to the bit, faces in order with the same corners from the same one on, what each corner and each face
has.  What mr-import leaves out by what its page says is left out of A: corners that repeat the one before,
faces of fewer than three corners, third texture coordinates, weights, colours in between two bytes.
"""
import gzip
import struct
import sys

import numpy as np


def read(path):
    data = open(path, "rb").read()
    return gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data


def byte(x):
    return int(min(max(x, 0), 255) + 0.5)


def clean(face):
    if len(face) > 3:
        kept = []
        for corner in face:
            if not kept or corner[0] != kept[-1][0]:
                kept.append(corner)
        while len(kept) > 1 and kept[-1][0] == kept[0][0]:
            kept.pop()
        face = kept
    return tuple(face)


def obj(data):
    v, colors, vt, vn, faces, files = [], [], [], [], [], []
    mark = {"g": "default", "o": "", "usemtl": "", "s": 0}
    text = data.decode("utf-8", "replace").replace("\\\r\n", " ").replace("\\\n", " ").replace("\r\n", "\n").replace("\r", "\n")
    for line in text.split("\n"):
        word, _, rest = line.strip().partition(" ")
        rest = rest.strip()
        if word == "v":
            x = [float(s) for s in rest.split()]
            v.append(tuple(x[:3]))
            colors.append(tuple(x[3:6]) if len(x) > 4 else None)
        elif word == "vt":
            vt.append((tuple(float(s) for s in rest.split()) + (0.0,))[:2])
        elif word == "vn":
            vn.append(tuple(float(s) for s in rest.split()))
        elif word == "f":
            face = []
            for corner in rest.split():
                i = [int(s) if s else 0 for s in corner.split("/")] + [0, 0]
                at = lambda k, l: l[i[k] - 1] if i[k] > 0 else l[i[k]] if i[k] else None
                n = at(2, vn)
                face.append((i[0] - 1 if i[0] > 0 else len(v) + i[0], at(1, vt), n if n != (0, 0, 0) else None))
            if len(clean(face)) > 2:
                faces.append((clean(face), tuple(mark.values())))
        elif word == "mtllib":
            files.append(rest)
        elif word == "s":
            mark["s"] = 0 if rest == "off" else int(rest)
        elif word in mark:
            mark[word] = rest or ("default" if word == "g" else "")
    bright = max((x for c in colors if c for x in c), default=0) > 1
    colors = [tuple(byte(x if bright else 255 * x) for x in c) if c else (255, 255, 255) for c in colors]
    return {"v": v, "colors": colors, "faces": faces, "mtllib": files if faces else []}


def off(data):
    lines = [l.split("#")[0].split() for l in data.decode("latin-1").splitlines()]
    words = [l for l in lines if l]
    keyword = words[0].pop(0)
    normals = "N" in keyword
    words = [l for l in words if l]
    nv, nf = int(words[0][0]), int(words[0][1])
    vertices = [tuple(map(float, l[: 6 if normals else 3])) for l in words[1 : nv + 1]]
    faces = [tuple(map(int, l[1 : int(l[0]) + 1])) for l in words[nv + 1 : nv + nf + 1]]
    faces = [tuple(c[0] for c in clean([(i,) for i in f])) for f in faces]
    return {"v": vertices, "faces": [f for f in faces if len(f) > 2]}


TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
         "double": "f8"}
TYPES.update({"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
              "float32": "f4", "float64": "f8"})


def ply(data):
    at = data.index(b"end_header")
    body = data.index(b"\n", at) + 1
    elements, form = [], None
    for line in data[:at].decode("latin-1").splitlines():
        w = line.split()
        if w[0] == "format":
            form = w[1]
        elif w[0] == "element":
            elements.append((w[1], int(w[2]), []))
        elif w[0] == "property":
            elements[-1][2].append((w[-1], w[1:-1]))
    words = iter(data[body:].split()) if form == "ascii" else None
    order = ">" if form == "binary_big_endian" else "<"
    out = {}
    for name, rows, props in elements:
        scalar = all(len(t) == 1 for _, t in props)
        if scalar and not words:
            kind = np.dtype([(p, order + TYPES[t[0]]) for p, t in props])
            table = np.frombuffer(data, kind, rows, body)
            body += kind.itemsize * rows
            for p, t in props:
                out[name, p] = (t[0], table[p].astype("f8").tolist())
            continue
        columns = [[] for _ in props]
        for _ in range(rows):
            for column, (p, t) in zip(columns, props):
                if words:
                    n = int(next(words)) if len(t) == 3 else 1
                    x = [float(next(words)) for _ in range(n)]
                else:
                    n = 1
                    if len(t) == 3:
                        kind = np.dtype(order + TYPES[t[1]])
                        n = int(np.frombuffer(data, kind, 1, body)[0])
                        body += kind.itemsize
                    kind = np.dtype(order + TYPES[t[-1]])
                    x = np.frombuffer(data, kind, n, body).astype("f8").tolist()
                    body += kind.itemsize * n
                column.append(tuple(x) if len(t) == 3 else x[0])
        for column, (p, t) in zip(columns, props):
            out[name, p] = (t[-1], column)
    return out


def same_ply(a, b):
    names = {"vertex_index": "vertex_indices", "u": "s", "v": "t", "texture_u": "s", "texture_v": "t",
             "diffuse_red": "red", "diffuse_green": "green", "diffuse_blue": "blue"}
    for (element, name), (_, values) in a.items():
        if element not in ("vertex", "face"):
            continue
        if len(values) == 0:
            continue
        there = b.get((element, names.get(name, name)))
        if there is None:
            return f"{element} {name} is not there"
        if name == "texcoord" and ("vertex", "s") in b:
            continue
        if list(values) != list(there[1]):
            return f"{element} {name} differs"
    return None


def stl(data):
    n = struct.unpack_from("<I", data, 80)[0] if len(data) > 84 else 0
    if len(data) == 84 + 50 * n:
        kind = np.dtype([("n", "<f4", 3), ("v", "<f4", 9), ("a", "<u2")])
        return {"v": np.frombuffer(data, kind, n, 84)["v"].tolist()}
    words = data.decode("latin-1").split()
    at = [i for i, w in enumerate(words) if w == "vertex"]
    corners = [tuple(float(np.float32(float(s))) for s in words[i + 1 : i + 4]) for i in at]
    return {"v": [list(corners[i] + corners[i + 1] + corners[i + 2]) for i in range(0, len(corners), 3)]}


def join(a, b):
    """A polygon that comes to a vertex twice, as around a hole, comes back as its triangles: puts it in their place."""
    for i, (face, marks) in enumerate(a):
        parts = b[i : i + len(face) - 2]
        if len({c[0] for c in face}) < len(face) and {c for f, _ in parts for c in f} == set(face) and all(
            len(f) == 3 and m == marks for f, m in parts
        ):
            b[i : i + len(face) - 2] = [(face, marks)]


def compare(kind, a, b):
    parse = {"obj": obj, "off": off, "ply": ply, "stl": stl}[kind]
    a, b = parse(a), parse(b)
    if kind == "ply":
        return same_ply(a, b)
    if kind == "obj":
        join(a["faces"], b["faces"])
    for name in a:
        if len(a[name]) != len(b[name]):
            return f"{len(b[name])} of {name}, not {len(a[name])}"
        for i, (x, y) in enumerate(zip(a[name], b[name])):
            if x != y:
                return f"{name} {i}: {y}, not {x}"
    return None


fail = 0
for line in sys.stdin:
    kind, a, b = line.rstrip("\n").split("\t")
    difference = None if b"BINARY" in read(a)[:20] else compare(kind, read(a), read(b))
    if difference:
        print(f"{a}: {difference[:300]}")
        fail = 1
sys.exit(fail)
