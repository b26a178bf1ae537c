"""heights.py -- MESH.mrs LEVEL SHARE SEED: its mesh as a control mesh with some edges sharp, with random heights on a
level, as a stream."""
import random
import struct
import sys

from checks import box, columns, length, sub
from records import END, START, frame, record


def column(layer, name, element, kind, rows):
    flat = [x for row in rows for x in row]
    data = struct.pack("<%d%s" % (len(flat), {b"d": "d", b"u": "I", b"b": "B"}[kind]), *flat)
    return record(layer, name, element + kind + bytes([len(rows[0])]), len(rows), data)


path, level, share, seed = sys.argv[1], int(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
chance = random.Random(seed)
values = columns(path)
p, t = values["mesh", "position"], values["mesh", "triangles"]
edges = {}
for f, tri in enumerate(t):
    for k in range(3):
        edges.setdefault(frozenset((tri[k], tri[(k + 1) % 3])), []).append((f, k))
crease = [[0, 0, 0] for _ in t]
for sides in edges.values():
    if chance.random() < share:
        f, k = chance.choice(sides)
        crease[f][k] = 1
nv, nf, boundary = len(p), len(t), sum(len(sides) == 1 for sides in edges.values())
for _ in range(level):
    nv, nf, boundary = nv + (3 * nf + boundary) // 2, 4 * nf, 2 * boundary
extent = length(sub(*box(p)))
heights = [(extent * chance.gauss(0, 0.01),) for _ in range(nv)]
colors = [tuple(chance.randrange(256) for _ in range(4)) for _ in range(nv)]
sys.stdout.buffer.write(
    START + frame(
        b"key heights", column(b"control", b"position", b"v", b"d", p), column(b"control", b"triangles", b"f", b"u", t),
        column(b"control", b"crease", b"f", b"b", crease) if share else b"",
        column(b"displacement", b"height", b"v", b"d", heights),
            column(b"displacement", b"level", b"-", b"u", [(level,)]),
        column(b"displacement", b"color", b"v", b"b", colors)) + END)
