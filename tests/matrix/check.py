"""check -- whether streams and files are what the pages of the tools promise, found by none of their code.

A promise is a function of what it is to judge; it gives nothing where that is right, else raises Broken with a sentence.
"""
import base64
import json
import math
import os
import re
import struct
import zlib

import stream
import numpy as np
import paint


class Broken(Exception):
    """What is wrong with a result."""


def must(holds, sentence):
    if not holds:
        raise Broken(sentence)


# ---- streams

# Columns by whose law a number may be none: corners without texture coordinates.  Columns that no tool knows are the file's.
NUMBERS = {"position", "normal", "texcoord", "corner_normal", "detail_bary", "detail_height", "detail_offset", "source_bary", "encoded",
           "rest", "before", "response", "transform", "turn", "spacing", "sampling", "height", "range", "scanner"}
INDICES = {"detail_face": "base", "source_face": "mesh"}


def frames(path):
    """All frames of a stream that keeps the laws of mr-stream(5)."""
    try:
        return list(stream.read(path))
    except stream.StreamError as error:
        raise Broken(f"no stream: {error}") from error


def lawful(frame):
    """What holds for every frame, by the tables of mr(7)."""
    for layer in frame:
        columns = frame[layer]
        for name in columns:
            where, values = f"{layer}.{name}", columns[name]
            if name in NUMBERS and values.dtype.kind == "f":
                must(np.isfinite(values).all(), f"{where} has a number that is not finite")
            if name in INDICES and len(values):
                must(values.max() < faces(frame, INDICES[name]), f"{where}: face {values.max()} of {faces(frame, INDICES[name])}")
            if name.endswith("_bary"):
                must(np.abs(values.sum(1) - 1).max(initial=0) < 1e-6, f"{where} does not sum to 1")
            if name == "triangles":
                must("position" in columns, f"{layer} has triangles and no positions")
                must(values.max(initial=0) < len(columns["position"]), f"{where}: vertex {values.max(initial=0)} of {len(columns['position'])}")
            if name == "position":
                must(len(values), f"{where} is empty")


def faces(frame, layer):
    return len(frame[layer]["triangles"]) if layer in frame and "triangles" in frame[layer] else 0


def topology(triangles):
    """Components, Euler number, boundary loops and whether it is an oriented manifold; of the vertices that faces use."""
    used, t = np.unique(triangles, return_inverse=True)
    t = t.reshape(-1, 3).astype(np.int64)
    n = len(used)
    half = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    edges, count = np.unique(np.sort(half, 1) @ [n, 1], return_counts=True)
    once = len(np.unique(half @ [n, 1])) == len(half)
    # Around a vertex the halves of a fan hang together: corners joined across edges are as many classes as vertices.
    key, f = np.sort(half, 1) @ [n, 1], len(t)
    order = np.argsort(key, kind="stable")
    pairs = np.flatnonzero(np.diff(key[order]) == 0)
    a, b = order[pairs], order[pairs + 1]
    start, end = np.arange(3 * f), (np.arange(3 * f) + f) % (3 * f)  # half-edge k f + i starts at corner k of face i
    joins = np.concatenate([np.stack([start[a], end[b]], 1), np.stack([end[a], start[b]], 1)])
    fans = classes(3 * f, joins) if once and count.max(initial=0) < 3 else 0
    alone = half[np.isin(key, edges[count == 1])]
    rim = np.unique(alone)
    loops = classes(len(rim), np.searchsorted(rim, alone)) if len(alone) else 0
    manifold = bool(once and count.max(initial=0) < 3 and fans == n and (t[:, 0] != t[:, 1]).all() and (t[:, 1] != t[:, 2]).all())
    return {"manifold": manifold, "components": classes(n, half), "euler": n - len(edges) + f, "loops": loops}


def classes(n, pairs):
    """Into how many n things fall that pairs connect."""
    label = np.arange(n)
    pairs = np.asarray(pairs)
    while len(pairs):
        low = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        before = label.copy()
        np.minimum.at(label, label[pairs[:, 0]], low)
        np.minimum.at(label, label[pairs[:, 1]], low)
        while (label[label] != label).any():
            label = label[label]
        if (label == before).all():
            break
    return len(np.unique(label))


def surface(frame, *names):
    """The first layer of these that has faces."""
    for name in names:
        if faces(frame, name):
            return frame[name]
    raise Broken(f"no faces in {' or '.join(names)}")


def same_topology(*source):
    """A promise: that layer of the result is an oriented manifold like the first of source; the last word is the result's."""
    def promise(before, after):
        for old, new in zip(before, after):
            a, b = (topology(surface(*where)["triangles"]) for where in ((old, *source[:-1]), (new, source[-1])))
            must(a["manifold"], "took a surface that is no oriented manifold")
            must(a == b, f"topology {b}, before {a}")
    return promise


def joined(surface):
    """Its triangles, vertices at the same place as one where that leaves a manifold."""
    p = surface["position"]
    _, number = np.unique(np.rint(p / (2e-8 * np.linalg.norm(np.ptp(p, 0)) or 1)), axis=0, return_inverse=True)
    triangles = number.reshape(-1)[surface["triangles"]]
    return triangles if topology(triangles)["manifold"] else surface["triangles"]


def same_topology_joined(*source):
    """same_topology, of a tool that joins seams first."""
    def promise(before, after):
        for old, new in zip(before, after):
            a, b = topology(joined(surface(old, *source[:-1]))), topology(surface(new, source[-1])["triangles"])
            must(a == b, f"topology {b}, before {a}")
    return promise


def same_triangles(source, result):
    def promise(before, after):
        for old, new in zip(before, after):
            must(np.array_equal(surface(old, *source)["triangles"], surface(new, result)["triangles"]), f"{result} has other triangles")
            must(len(surface(old, *source)["position"]) == len(new[result]["position"]), f"{result} has other vertices")
    return promise


def columns(layer, *names):
    def promise(before, after):
        for frame in after:
            for name in names:
                must(layer in frame and name in frame[layer], f"no {layer}.{name}")
    return promise


def manifold(layer):
    def promise(before, after):
        for frame in after:
            must(topology(surface(frame, layer)["triangles"])["manifold"], f"{layer} is no oriented manifold")
    return promise


def anything(before, after):
    for frame in after:
        must(any("position" in frame[layer] for layer in frame), "no positions")


def same_values(before, after):
    must(len(before) == len(after), f"{len(after)} frames of {len(before)}")
    for old, new in zip(before, after):
        for layer in old:
            for name in old[layer]:
                if name != "history":
                    a, b = old[layer][name], new[layer][name]
                    must(a == b if isinstance(a, str) else np.array_equal(a, b, equal_nan=a.dtype.kind == "f"), f"{layer}.{name} differs")


def doubled(before, after):
    for old, new in zip(before, after):
        for layer in old:
            if "position" in old[layer]:
                must(np.array_equal(2 * old[layer]["position"], new[layer]["position"]), f"{layer} is not twice as large")


def level(layer):
    """Where the upper half along y begins, and 1e-9 of its size."""
    y = layer["position"][:, 1]
    return y.min() / 2 + y.max() / 2, 1e-9 * (abs(y.min()) + abs(y.max()))


def upper_half(before, after):
    for old, new in zip(before, after):
        for layer in ("mesh", "points"):
            if layer in old:
                y, slack = level(old[layer])
                must((new[layer]["position"][:, 1] >= y - slack).all(), f"a vertex of {layer} from below {y}")
                return


def chosen(before, after):
    for frame in after:
        mesh = frame["mesh"] if "mesh" in frame else frame["points"]
        y, slack = level(mesh)
        p, region = mesh["position"][:, 1], mesh["region"]
        must(((region == 3) | (p <= y + slack)).all() and ((region == 0) | (p >= y - slack)).all(), "a vertex of a wrong region")


def first_rows(before, after):
    for old, new in zip(before, after):
        p, corners = new["mesh"]["position"], old["mesh"]["position"][old["mesh"]["triangles"]]
        off = np.abs(corners - p[new["mesh"]["triangles"][:len(corners)]])
        must((off <= 1e-8 * np.linalg.norm(np.ptp(p, 0))).all(), "other triangles")


def carried(layer, most, kept_whole=True):
    """What paint.py put on the mesh is on that layer; of a thousand faces or more, no further from what it is there than
    `most`, on the mean; and by area there are as many of each material."""
    def promise(before, after):
        for old, new in zip(before, after):
            if "mesh" not in old or "heat" not in old["mesh"]:
                continue
            q, t, found = paint.share(old["mesh"]["position"], new[layer]["position"]), new[layer]["triangles"], new[layer]
            for name, right in (("color", q), ("heat", q[:, 2]), ("corner_texcoord", q[t][:, :, :2].reshape(-1, 6))):
                must(name in found, f"{name} is lost")
                rows = {"color": found["color"][:, :3] / 255, "heat": 3 * found["heat"]}.get(name, found[name])
                off = np.abs(rows - right).mean() if len(t) and faces(old, "mesh") >= 1000 else 0
                must(off <= most, f"{name} is {100 * off:.1f} % off")
            must("material" in found and found["materials"] == old["mesh"]["materials"], "materials are lost")
            if kept_whole and len(t) and faces(old, "mesh") >= 1000:
                off = abs(mean_of_labels(found) - mean_of_labels(old["mesh"]))
                must(off <= max(2 * most, 0.1), f"materials are {off:.2f} off, of 0 to 2")
    return promise


def mean_of_labels(layer):
    a, b, c = layer["position"][layer["triangles"].T]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return (area * layer["material"]).sum() / area.sum() if area.any() else 1


def parts(before, after):
    whole = sum(faces(frame, "mesh") for frame in before)
    must(sum(faces(frame, "mesh") for frame in after) == whole, f"parts of {sum(faces(f, 'mesh') for f in after)} faces of {whole}")
    for frame in after:
        if faces(frame, "mesh"):
            must(topology(frame["mesh"]["triangles"])["components"] == 1, f"{frame.name} is not connected")


def unit_normals(before, after):
    for frame in after:
        normals = [frame[layer][name].reshape(-1, 3) for layer in frame for name in ("normal", "corner_normal") if name in frame[layer]]
        must(normals, "no normals")
        for n in normals:
            length = np.sqrt((n * n).sum(1))
            must(((np.abs(length - 1) < 1e-6) | (length == 0)).all(), "a normal that is not of length 1")


def four_of_each(before, after):
    for old, new in zip(before, after):
        must(faces(new, "mesh") == 4 * len(surface(old, "control", "mesh")["triangles"]), "not four faces of each")


def short_edges(before, after):
    for old, new in zip(before, after):
        p, t = new["mesh"]["position"], new["mesh"]["triangles"]
        box = np.ptp(surface(old, "control", "mesh")["position"], 0)
        longest = max(np.linalg.norm(p[t[:, k]] - p[t[:, k - 1]], axis=1).max() for k in range(3))
        must(longest <= 0.1 * np.linalg.norm(box) * (1 + 1e-9), f"an edge of {longest}, of a box of {box}")


def still_fixed(before, after):
    """Vertices of region 0 stay, of what mr-solve bent, to 1e-6 of its size."""
    for old, new in zip(before, after):
        a, b = old["base"]["position"], new["base"]["position"]
        fixed = new["base"]["region"] == 0
        must(np.abs(a - b)[fixed].max(initial=0) <= 1e-6 * np.ptp(a, 0).max(), "a fixed vertex moved")


def heights(before, after):
    """As many as the control mesh has vertices when it is subdivided."""
    for frame in after:
        control, v = frame["control"], len(frame["control"]["position"])
        t = control["triangles"].astype(np.int64)
        e = len(np.unique(np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), 1) @ [v, 1]))
        f = len(t)
        for _ in range(int(frame["displacement"]["level"][0])):
            v, e, f = v + e, 2 * e + 3 * f, 4 * f
        must(len(frame["displacement"]["height"]) == v, f"{len(frame['displacement']['height'])} heights of {v}")
        if "mesh" in frame and len(frame["mesh"]["position"]) == v:
            must(faces(frame, "mesh") == f, f"{faces(frame, 'mesh')} faces of {f}")


# ---- files

def shown(frame):
    """The layer that a sink takes by itself, of the frames here."""
    latest = frame.columns["", "latest"].values if ("", "latest") in frame.columns else ""
    return frame[latest if latest and latest in frame else next(name for name in ("mesh", "control", "points", "base") if name in frame)]


def counts(frame):
    layer = shown(frame)
    return len(layer["position"]), len(layer["triangles"]) if "triangles" in layer else 0


def same_counts(before, vertices, triangles):
    must((vertices, triangles) == counts(before[0]), f"{vertices} vertices, {triangles} triangles in the file, of {counts(before[0])}")


def obj_file(before, path):
    v, f, largest = 0, 0, 0
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            words = line.split()
            if words and words[0] in ("v", "vn", "vt"):
                v += words[0] == "v"
                must(all(math.isfinite(float(word)) for word in words[1:]), f"not finite: {line.strip()}")
            elif words and words[0] == "f":
                f += len(words) - 3
                largest = max(largest, *(int(word.split("/")[0]) for word in words[1:]))
    must(largest <= v, f"vertex {largest} of {v}")
    same_counts(before, v, f)


def ply_file(before, path):
    """Binary and little-endian, as it is written by default: the header, and whether the rest is as long and finite."""
    data = open(path, "rb").read()
    at = data.index(b"end_header\n") + 11
    size = {"double": 8, "float": 4, "int": 4, "uint": 4, "short": 2, "ushort": 2, "char": 1, "uchar": 1}
    kinds = {"double": "<f8", "float": "<f4", "int": "<i4", "uint": "<u4", "short": "<i2", "ushort": "<u2", "char": "i1", "uchar": "u1"}
    elements = []
    for line in data[:at].decode("latin-1").splitlines():
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    vertices = triangles = 0
    for name, rows, properties in elements:
        if all(len(p) == 2 for p in properties):
            table = np.frombuffer(data, np.dtype([(str(k), kinds[p[0]]) for k, p in enumerate(properties)]), rows, at)
            at += table.nbytes
            vertices = rows if name == "vertex" else vertices
            for k, p in enumerate(properties):
                must(p[1] not in ("x", "y", "z", "nx", "ny", "nz") or np.isfinite(table[str(k)]).all(), f"{p[1]} is not finite")
            continue
        for _ in range(rows):
            for p in properties:
                n = 1
                if p[0] == "list":
                    n = int.from_bytes(data[at:at + size[p[1]]], "little")
                    at += size[p[1]]
                    if p[-1] in ("vertex_indices", "vertex_index"):
                        triangles += n - 2
                        must(max(struct.unpack_from(f"<{n}I", data, at)) < vertices, "a corner that is no vertex")
                at += n * size[p[-2]]
    must(at == len(data), f"{len(data)} bytes of {at}")
    same_counts(before, vertices, triangles)


def stl_file(before, path):
    data = open(path, "rb").read()
    n = struct.unpack_from("<I", data, 80)[0]
    must(len(data) == 84 + 50 * n, f"{len(data)} bytes of {n} triangles")
    table = np.frombuffer(data, np.dtype([("v", "<f4", 12), ("a", "<u2")]), n, 84)
    must(np.isfinite(table["v"]).all(), "a number is not finite")
    must(n == counts(before[0])[1], f"{n} triangles of {counts(before[0])[1]}")


def off_file(before, path):
    lines = [line.split() for line in open(path)]
    v, f = int(lines[1][0]), int(lines[1][1])
    must(len(lines) == 2 + v + f, f"{len(lines)} lines of {v} vertices and {f} faces")
    must(all(math.isfinite(float(word)) for line in lines[2:2 + v] for word in line), "a number is not finite")
    must(all(int(i) < v for line in lines[2 + v:] for i in line[1:int(line[0]) + 1]), "a corner that is no vertex")
    same_counts(before, v, sum(int(line[0]) - 2 for line in lines[2 + v:]))


def glb_file(before, path):
    data = open(path, "rb").read()
    magic, _, length, size, _ = struct.unpack_from("<4s4I", data)
    must(magic == b"glTF" and length == len(data), f"{len(data)} bytes of {length}")
    scene, body = json.loads(data[20:20 + size]), data[28 + size:]
    shape = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
    for a in scene["accessors"]:
        view = scene["bufferViews"][a["bufferView"]]
        kind = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[a["componentType"]]
        at = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        values = np.frombuffer(body, kind, a["count"] * shape[a["type"]], at) if "byteStride" not in view else np.zeros(1)
        must(values.dtype.kind != "f" or np.isfinite(values).all(), "a number is not finite")
    for mesh in scene["meshes"]:
        for p in mesh["primitives"]:
            rows = scene["accessors"][p["attributes"]["POSITION"]]["count"]
            must("indices" not in p or scene["accessors"][p["indices"]].get("max", [0])[0] < rows, "a corner that is no vertex")


def xyz_file(before, path):
    lines = [line.split() for line in open(path) if not line.startswith("#")]
    must(all(math.isfinite(float(word)) for line in lines for word in line), "a number is not finite")
    must(len(lines) == counts(before[0])[0], f"{len(lines)} points of {counts(before[0])[0]}")


def png_file(before, path):
    """Chunks with right checksums, and as many rows as the header says."""
    data = open(path, "rb").read()
    must(data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG")
    at, packed, kind = 8, b"", b""
    while kind != b"IEND":
        n, kind = struct.unpack_from(">I4s", data, at)
        must(zlib.crc32(data[at + 4:at + 8 + n]) == struct.unpack_from(">I", data, at + 8 + n)[0], f"the checksum of {kind}")
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack_from(">IIBB", data, at + 8)
        packed += data[at + 8:at + 8 + n] if kind == b"IDAT" else b""
        at += 12 + n
    row = 1 + (width * {0: 1, 2: 3, 6: 4}[color] * depth + 7) // 8
    must(at == len(data) and len(zlib.decompress(packed)) == row * height, "not as many pixels as the header says")


def pictures(before, after):
    heights(before, after)
    for name in ("map-height.png", "map-normal.png"):
        png_file(before, name)
    must(os.path.getsize("map.mtl"), "an empty map.mtl")


def baked(before, after):
    png_file(before, "bake-normal.png")
    must(os.path.getsize("bake.mtl"), "an empty bake.mtl")


def page_column(frame, layer, name):
    """A column of the stream in a page, which may be the copy of another, or sums of steps (mr-view(1), The file)."""
    values = frame[layer][name] if layer in frame and name in frame[layer] else None
    for how, *words in map(str.split, frame[""]["page"].splitlines() if "page" in frame[""] else ()):
        if words[:2] != [layer, name]:
            continue
        if how == "same":
            return page_column(frame, *words[2:])
        must(how == "steps" and values.dtype == np.uint32, f"{layer}.{name} is stored as {how}")
        steps = np.diff(values, axis=0, prepend=np.zeros_like(values[:1]))
        values = np.cumsum(steps >> 1 ^ (0 - (steps & 1)), axis=0, dtype=np.uint32)
        if words[2:]:
            step, *origin = map(float, words[2:])
            values = values.view(np.int32) * step + np.array(origin)[:values.shape[-1]]
    must(values is not None, f"{layer}.{name} is not in the page")
    return values


def page_file(before, path):
    """The stream in the page has the frames, the positions of what is drawn to 24 bits of the extent."""
    blocks = re.findall('<script type="text/plain" class="stream">([^<]*)</script>', open(path, encoding="utf-8").read())
    open("x.packed", "wb").write(b"".join(base64.b64decode(block, validate=True) for block in blocks))
    must(os.system("mr-cat -u --no-history x.packed >x.back") == 0, "no stream in the page")
    after = frames("x.back")
    must(len(before) == len(after), f"{len(after)} frames of {len(before)}")
    for old, new in zip(before, after):
        for layer in (layer for layer in old if "position" in old[layer]):
            a, b = old[layer]["position"], page_column(new, layer, "position")
            drawn = np.unique(old[layer]["triangles"]) if len(old[layer].get("triangles", [])) else slice(None)
            must(a.shape == b.shape, f"{layer}: other numbers of positions")
            a, b = a[drawn], b[drawn]
            must(np.abs(a - b).max() <= 2.0 ** -24 * np.ptp(a, axis=0).max(), f"{layer}: other positions")
            must("triangles" not in old[layer] or np.array_equal(old[layer]["triangles"], page_column(new, layer, "triangles")), f"{layer}: other triangles")


def info_text(before, path):
    """What mr-info says of vertices, faces and topology is what is found here."""
    for frame, line in zip(before, open(path, encoding="utf-8"), strict=True):
        said = json.loads(line, parse_constant=lambda word: must(False, f"{word} in JSON"))
        for name, layer in said["layers"].items():
            if layer.get("kind") == "surface":
                t = frame[name]["triangles"]
                found = {"vertices": len(frame[name]["position"]), "faces": len(t)}
                if layer["manifold"] and layer["oriented"] and not layer["degenerate_faces"]:
                    found.update(topology(t))
                    must(found.pop("manifold"), f"{name} is called manifold and oriented")
                    found["boundary_loops"] = found.pop("loops")
                for key, value in found.items():
                    must(layer[key] == value, f"{name}: {key} {layer[key]}, not {value}")


def distances(before, path):
    for line in open(path, encoding="utf-8"):
        said = json.loads(line, parse_constant=lambda word: must(False, f"{word} in JSON"))
        for way in ("a_to_b", "b_to_a", "both"):
            d = said[way]
            must(0 <= d["min"] <= d["mean"] * (1 + 1e-9) and d["mean"] <= d["rms"] * (1 + 1e-9) <= d["max"] * (1 + 2e-9), f"{way}: {d}")
    must(os.path.getsize(path), "nothing is said")


# ---- what a tool says

def sentences(text):
    """Lines but for warnings and notes."""
    return [line for line in text.splitlines() if not re.match(r"mr-[a-z]+: (.*: )?warning: ", line)]
