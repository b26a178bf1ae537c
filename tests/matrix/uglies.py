"""uglies -- surfaces and clouds that no tool is glad of, as OBJ files: each a function here, its name that of the file."""
import math
import os
import random


def sphere(n=12, radius=1.0, centre=(0, 0, 0)):
    """Of n rings of 2 n vertices; its poles are vertices of many faces."""
    v = [(0, 0, 1)]
    for i in range(1, n):
        a = math.pi * i / n
        v += [(math.sin(a) * math.cos(math.pi * j / n), math.sin(a) * math.sin(math.pi * j / n), math.cos(a)) for j in range(2 * n)]
    v += [(0, 0, -1)]
    m, last = 2 * n, len(v) - 1
    f = [(0, 1 + j, 1 + (j + 1) % m) for j in range(m)]
    for i in range(n - 2):
        for j in range(m):
            a, b, c, d = (1 + (i + k) * m + (j + l) % m for k, l in ((0, 0), (1, 0), (1, 1), (0, 1)))
            f += [(a, b, c), (a, c, d)]
    f += [(last, last - m + (j + 1) % m, last - m + j) for j in range(m)]
    return [tuple(radius * x + c for x, c in zip(p, centre)) for p in v], f


def grid(nu, nv, place, wrap_u=False, wrap_v=False, flip=False):
    """A sheet of nu by nv squares, place(u, v) with both from 0 to 1; what is wrapped may be flipped on the way."""
    cols, rows = nu + (not wrap_u), nv + (not wrap_v)
    v = [place(i / nu, j / nv) for j in range(rows) for i in range(cols)]

    def at(i, j):
        if i == nu and wrap_u:
            i, j = 0, (rows - j) % rows if flip and wrap_v else rows - 1 - j if flip else j
        return (j % rows if wrap_v else j) * cols + i
    f = []
    for j in range(nv):
        for i in range(nu):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            f += [(a, b, c), (a, c, d)]
    return v, f


def ring(u, v, thick=0.3):
    a, b = 2 * math.pi * u, 2 * math.pi * v
    return (1 + thick * math.cos(b)) * math.cos(a), (1 + thick * math.cos(b)) * math.sin(a), thick * math.sin(b)


def joined(*models):
    v, f = [], []
    for points, faces in models:
        f += [tuple(i + len(v) for i in face) for face in faces]
        v += points
    return v, f


def times(model, x, y=None, z=None, move=0.0):
    y, z = x if y is None else y, x if z is None else z
    return [(x * p[0] + move, y * p[1] + move, z * p[2] + move) for p in model[0]], model[1]


def shaken(model, by, seed=1):
    draw = random.Random(seed)
    return [tuple(x + draw.gauss(0, by) for x in p) for p in model[0]], model[1]


def moebius(u, v):
    a, t = 2 * math.pi * u, v - 0.5
    return (1 + t * math.cos(a / 2)) * math.cos(a), (1 + t * math.cos(a / 2)) * math.sin(a), t * math.sin(a / 2)


def strewn(n, seed=1):
    draw = random.Random(seed)
    return [tuple(draw.uniform(-1, 1) for _ in range(3)) for _ in range(n)]


def fan(n, height=1.0):
    """n triangles at one edge."""
    v = [(0, 0, 0), (0, 0, height)] + [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0) for i in range(n)]
    return v, [(0, 1, i + 2) for i in range(n)]


torus = grid(24, 12, ring, True, True)
sheet = grid(12, 12, lambda u, v: (u, v, 0.1 * math.sin(6 * u) * math.cos(5 * v)))
triangle = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]
bumps = shaken(sphere(8), 0.01)
pillow = triangle[0], [(0, 1, 2), (0, 2, 1)]

MODELS = {
    "empty": lambda: ([], []),
    "one-vertex": lambda: ([(1, 2, 3)], []),
    "two-vertices": lambda: ([(1, 2, 3), (3, 2, 1)], []),
    "one-triangle": lambda: triangle,
    "two-triangles": lambda: (triangle[0] + [(1, 1, 0.5)], [(0, 1, 2), (2, 1, 3)]),
    "two-apart": lambda: joined(triangle, times(triangle, 1, move=5)),
    "pillow": lambda: pillow,
    "sphere-and-pillow": lambda: joined(sphere(), pillow),
    "tetrahedron": lambda: ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]),
    "zero-area": lambda: ([p if i % 7 else torus[0][i - 1] for i, p in enumerate(torus[0])], torus[1]),
    "all-zero-area": lambda: ([(math.sin(i), 0, 0) for i in range(99)], [(i, i + 1, i + 2) for i in range(97)]),
    "repeated-corners": lambda: (sheet[0], sheet[1] + [(i, i, i + 1) for i in range(9)]),
    "all-equal": lambda: ([(1, 2, 3)] * 99, [(i, i + 1, i + 2) for i in range(97)]),
    "collinear": lambda: ([(i, 2 * i, 3 * i) for i in range(99)], []),
    "coplanar": lambda: grid(12, 12, lambda u, v: (u, v, 0)),
    "coplanar-tilted": lambda: ([(x, y, x / 3 - y / 7) for x, y, z in strewn(300)], []),
    "needles": lambda: times(torus, 1, 1e-6, 1),
    "needles-worse": lambda: times(torus, 1, 1e-12, 1e-6),
    "one-needle": lambda: ([(0, 0, 0), (1, 0, 0), (0.5, 1e-9, 0)], [(0, 1, 2)]),
    "long-strip": lambda: grid(200, 1, lambda u, v: (1000 * u, v, 0)),
    "spike": lambda: (bumps[0][:-1] + [(0, 0, -1e3)], bumps[1]),
    "hairs": lambda: ([tuple((9 if i % 11 == 0 else 1) * x for x in p) for i, p in enumerate(sphere(12)[0])], sphere(12)[1]),
    "fine-and-coarse": lambda: joined(sphere(), times(sphere(), 1e-9, move=3)),
    "duplicate-faces": lambda: (torus[0], torus[1] + torus[1][:50]),
    "duplicate-vertices": lambda: joined(*[([torus[0][i] for i in face], [(0, 1, 2)]) for face in torus[1]]),
    "twice": lambda: joined(torus, torus),
    "folded": lambda: ([(x, y if y < 0.5 else 1 - y, z) for x, y, z in sheet[0]], sheet[1]),
    "crumpled": lambda: shaken(sheet, 0.3),
    "isolated": lambda: (strewn(50) + torus[0] + strewn(50, 2), [tuple(i + 50 for i in face) for face in torus[1]]),
    "fan-of-3": lambda: fan(3),
    "fan-of-50": lambda: fan(50),
    "umbrella": lambda: (fan(500)[0], [(1, i + 2, (i + 1) % 500 + 2) for i in range(500)]),
    "bow-tie": lambda: ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, -1, 0)], [(0, 1, 2), (0, 3, 4)]),
    "two-spheres-at-a-vertex": lambda: (sphere()[0] + [(x, y, z - 2) for x, y, z in sphere()[0][1:]],
                                sphere()[1] + [tuple(len(sphere()[0]) - 1 + i for i in face) for face in sphere()[1]]),
    "moebius": lambda: grid(40, 4, moebius, True, flip=True),
    "klein": lambda: grid(24, 12, ring, True, True, flip=True),
    "half-turned": lambda: (torus[0], [face[::-1] if i % 2 else face for i, face in enumerate(torus[1])]),
    "inside-out": lambda: (torus[0], [face[::-1] for face in torus[1]]),
    "sphere-in-sphere": lambda: joined(sphere(), times(sphere(), 0.5)),
    "shell": lambda: joined(sphere(), (times(sphere(), 0.999)[0], [face[::-1] for face in sphere()[1]])),
    "spheres-that-cross": lambda: joined(sphere(), times(sphere(), 1, move=0.5)),
    "many-specks": lambda: joined(*[times(sphere(2), 0.01, move=float(i)) for i in range(40)]),
    "nine-hundred-loops": lambda: (sheet[0], sheet[1][::3]),
    "noise": lambda: (strewn(400), []),
    "noisy-sphere": lambda: (shaken(sphere(20), 0.2)[0], []),
    "many-equal": lambda: (sphere()[0] * 20, []),
    "two-clusters": lambda: (times(sphere(), 1e-6)[0] + times(sphere(), 1e-6, move=1e6)[0], []),
    "a-far-point": lambda: (sphere()[0] + [(1e12, 0, 0)], []),
    "a-vertex-at-1e150": lambda: (torus[0][:-1] + [(1e150, 0, 0)], torus[1]),
    "offset-1e6": lambda: times(torus, 1, move=1e6),
    "offset-1e15": lambda: times(torus, 1, move=1e15),
    **{"size-1e%d" % e: lambda e=e: times(torus, 10.0 ** e) for e in (-300, -200, -100, -30, -29, -12, 12, 29, 30, 100, 200, 300)},
    "size-of-subnormals": lambda: times(torus, 5e-324),
    "off-by-subnormals": lambda: ([(1.4, 5e-324 * (i % 2), 0) for i in range(99)], [(i, i + 1, i + 2) for i in range(97)]),
    "the-largest-numbers": lambda: ([(math.copysign(1.7976931348623157e308, x), y, z) for x, y, z in torus[0]], torus[1]),
}


def write(folder, wanted):
    """Those whose path is wanted to folder; gives their paths."""
    os.makedirs(folder, exist_ok=True)
    paths = []
    for name, made in MODELS.items():
        path = os.path.join(folder, name + ".obj")
        if not wanted(path):
            continue
        paths.append(path)
        vertices, faces = made()
        with open(paths[-1], "w") as out:
            out.writelines("v %r %r %r\n" % tuple(map(float, p)) for p in vertices)
            out.writelines("f %d %d %d\n" % tuple(i + 1 for i in face) for face in faces)
    return paths
