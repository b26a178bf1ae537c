# usage: maps.py DOMAIN.obj DECODED.obj CONTROL.glb HEIGHT.png NORMAL.png
# Displaces DOMAIN along its normals by HEIGHT at its texture coordinates, as a program does that knows nothing of mr, and
# compares with DECODED; looks at both sides of each seam between texels; and turns NORMAL by the frames of CONTROL.
import json
import struct
import sys
import zlib
from math import acos, atan2, degrees, sqrt


def picture(path):
    data, at, packed, text = open(path, 'rb').read(), 8, b'', {}
    while at < len(data):
        size, kind = struct.unpack('>I4s', data[at:at + 8])
        body, at = data[at + 8:at + 8 + size], at + 12 + size
        if kind == b'IHDR':
            width, height, depth, color = struct.unpack('>IIBB', body[:10])
        elif kind == b'tEXt':
            key, value = body.split(b'\0')
            text[key.decode()] = value.decode()
        elif kind == b'IDAT':
            packed += body
    raw, rows = zlib.decompress(packed), []
    each = {0: 1, 2: 3}[color] * depth // 8
    above = bytes(width * each)
    for y in range(height):
        start = y * (width * each + 1)
        line = raw[start + 1:start + 1 + width * each]
        if raw[start] == 2:
            line = bytes((a + b) & 255 for a, b in zip(line, above))
        else:
            assert raw[start] == 0, 'a filter that mr does not use'
        above = line
        rows.append(struct.unpack('>%dH' % width, line) if depth == 16 else line)
    return width, height, rows, text


def obj(path):
    v, vt, vn, faces = [], [], [], []
    for line in open(path):
        word = line.split()
        if word and word[0] in ('v', 'vt', 'vn'):
            {'v': v, 'vt': vt, 'vn': vn}[word[0]].append([float(x) for x in word[1:]])
        elif word and word[0] == 'f':
            faces.append([[int(x) - 1 for x in corner.split('/') if x] for corner in word[1:]])
    return v, vt, vn, faces


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = sqrt(dot(a, a))
    return [x / length for x in a] if length else a


def angle(a, b):
    c = cross(a, b)
    return degrees(atan2(sqrt(dot(c, c)), dot(a, b)))


def vertex_normals(v, faces):
    normal = [[0, 0, 0] for _ in v]
    for f in faces:
        p = [v[c[0]] for c in f]
        n = unit(cross(sub(p[1], p[0]), sub(p[2], p[0])))
        for k in range(3):
            a, b = unit(sub(p[(k + 1) % 3], p[k])), unit(sub(p[(k + 2) % 3], p[k]))
            w = acos(max(-1, min(1, dot(a, b))))
            normal[f[k][0]] = [x + w * y for x, y in zip(normal[f[k][0]], n)]
    return [unit(n) for n in normal]


def bilinear(image, uv):
    width, height, rows, _ = image
    x, y = uv[0] * width - 0.5, (1 - uv[1]) * height - 0.5
    i, j = int(x), int(y)
    s, t = x - i, y - j
    i1, j1 = min(i + 1, width - 1), min(j + 1, height - 1)
    return (1 - t) * ((1 - s) * rows[j][i] + s * rows[j][i1]) + t * ((1 - s) * rows[j1][i] + s * rows[j1][i1])


fail = 0


def check(good, *what):
    global fail
    if not good:
        print(*what)
        fail = 1


heights, normals = picture(sys.argv[4]), picture(sys.argv[5])
width, height, rows, text = heights
low, high = [float(x) for x in text['Height range'].split()]
step = (high - low) / 65535
check((width, height) == tuple(map(int, text['Height size'].split())), 'the size is another one')

# Displacement.
v, vt, vn, faces = obj(sys.argv[1])
truth, _, _, decoded = obj(sys.argv[2])
worst = off = differ = 0
for f in faces:
    for a, t, n in f:
        x, y = vt[t][0] * width - 0.5, (1 - vt[t][1]) * height - 0.5
        off = max(off, abs(x - round(x)), abs(y - round(y)))
        h = low + step * rows[round(y)][round(x)]
        p = [c + h * d for c, d in zip(v[a], vn[n])]
        worst = max(worst, sqrt(dot(sub(p, truth[a]), sub(p, truth[a]))))
check(len(faces) == len(decoded) and len(v) == len(truth), 'another mesh')
check(off < 1e-9, 'vertices are', off, 'of a texel off their centres')
check(worst < 0.5001 * step + 1e-12, 'the surface is', worst / step, 'steps off')

# Seams: halfway between two vertices, and a third of the way, from both sides.
sides = {}
for f in faces:
    for k in range(3):
        a, b = f[k], f[(k + 1) % 3]
        uv = (vt[a[1]], vt[b[1]]) if a[0] < b[0] else (vt[b[1]], vt[a[1]])
        sides.setdefault((min(a[0], b[0]), max(a[0], b[0])), []).append(uv)
for both in sides.values():
    if len(both) == 2 and both[0] != both[1]:
        for t in (1 / 2, 1 / 3):
            a, b = [bilinear(heights, [(1 - t) * p + t * q for p, q in zip(*side)]) for side in both]
            differ = max(differ, abs(a - b))
check(differ < 0.5, 'the sides of a seam differ by', differ, 'steps')

# Normals, at the corners of control, in the frames that the format asks viewers for: within what 8 bits round, where the map has them.
data = open(sys.argv[3], 'rb').read()
size = struct.unpack('<I', data[12:16])[0]
doc, blob = json.loads(data[20:20 + size]), data[28 + size:]


def values(accessor, width):
    a = doc['accessors'][accessor]
    start = doc['bufferViews'][a['bufferView']]['byteOffset']
    kind = {5123: 'H', 5125: 'I', 5126: 'f'}[a['componentType']]
    flat = struct.unpack_from('<%d%s' % (a['count'] * width, kind), blob, start)
    return [flat[i:i + width] for i in range(0, len(flat), width)]


def tangent(corners, normal):
    """Where u increases on a triangle, across the normal, and to which side of it v then does (Mikkelsen)."""
    p, q = [place[i] for i in corners], [uv[i] for i in corners]
    ab, ac, (du, dv), (eu, ev) = sub(p[1], p[0]), sub(p[2], p[0]), sub(q[1], q[0]), sub(q[2], q[0])
    side = 1 if du * ev - eu * dv < 0 else -1  # v runs down
    t = [side * (dv * y - ev * x) for x, y in zip(ab, ac)]
    along = dot(t, normal) / dot(normal, normal)
    return unit([x - along * y for x, y in zip(t, normal)]), side


part = doc['meshes'][0]['primitives'][0]
n, uv = values(part['attributes']['NORMAL'], 3), values(part['attributes']['TEXCOORD_0'], 2)
index, place = values(part['indices'], 1), values(part['attributes']['POSITION'], 3)
level = int(text['Height level'])
true = vertex_normals(truth, decoded)
most = used = 0
for f in range(len(index) // 3):
    # control's triangle f, and the fine ones at its corners
    for k in range(3):
        i = index[3 * f + k][0]
        fine = f * 4 ** level + k * (4 ** level - 1) // 3
        x, y = uv[i][0] * width - 0.5, uv[i][1] * height - 0.5
        check(abs(x - round(x)) < 0.01 and abs(y - round(y)) < 0.01, 'a corner is on no texel')
        c = [2 * b / 255 - 1 for b in normals[2][round(y)][3 * round(x):3 * round(x) + 3]]
        t, side = tangent([index[3 * f + j][0] for j in range(3)], n[i])
        b = [side * d for d in cross(n[i], t)]
        shown = unit([c[0] * p + c[1] * q + c[2] * r for p, q, r in zip(t, b, n[i])])
        check(abs(dot(t, n[i])) < 1e-5 and abs(dot(t, t) - 1) < 1e-5, 'no frame')
        if dot(true[decoded[fine][k][0]], n[i]) > 0.05:
            used += 1
            most = max(most, angle(shown, true[decoded[fine][k][0]]))
check(used > 0.9 * len(index), 'only', used, 'of', len(index), 'corners look the way control does')
check(most < 0.5, 'normals are', most, 'degrees off')
material = doc['materials'][part['material']]
check('normalTexture' in material, 'no picture of normals')
print('steps', worst / step, 'seams', differ, 'degrees', most, file=sys.stderr)
sys.exit(fail)
