# What one surface looks like, as pictures for another: colours, pictures, points, and what is refused.
cat >look.py <<'END2'
import struct, sys, zlib
def picture(name):
    data, at, body = open(name, 'rb').read(), 8, b''
    while at < len(data):
        size, kind = struct.unpack('>I4s', data[at:at + 8])
        if kind == b'IHDR':
            w, h = struct.unpack('>II', data[at + 8:at + 16])
        if kind == b'IDAT':
            body += data[at + 8:at + 8 + size]
        at += 12 + size
    body, rows = zlib.decompress(body), [bytes(3 * w)]
    for y in range(h):
        row = body[y * (3 * w + 1):(y + 1) * (3 * w + 1)]
        assert row[0] in (0, 2)
        rows.append(bytes((a + b * (row[0] == 2)) & 255 for a, b in zip(row[1:], rows[-1])))
    return w, h, rows[1:]
def corners(name): # of an OBJ's faces: places, texture coordinates, normals
    of = {'v': [], 'vt': [], 'vn': []}
    for line in open(name):
        word = line.split()
        if word and word[0] in of:
            of[word[0]].append([float(x) for x in word[1:]])
        if word and word[0] == 'f':
            yield [[of[k][int(i) - 1] for k, i in zip(('v', 'vt', 'vn'), c.split('/'))] for c in word[1:]]
def texel(picture, u, v):
    w, h, rows = picture
    x, y = min(int(u * w), w - 1), min(int((1 - v) * h), h - 1)
    return rows[y][3 * x:3 * x + 3]
END2
figures() {
	sed 's/.*"width"/"width"/; s/,"findings.*//; s/}$//; s/"//g; s/texels:[0-9]*/texels:N/; s/charts:[1-9][0-9]*/charts:N/' "$@"
}
# Red is x, green is y, blue is z.
mr-make sphere -n 5000 | mr-export -f obj - | awk '/^v / { print $0, 0.5 + 0.4 * $2, 0.5 + 0.4 * $3, 0.5 + 0.4 * $4; next } { print }' >ball.obj
mr-import -q ball.obj -o ball.mrs
mr-make sphere -n 60 | mr-transform --scale 1,1,0.8 -o coarse.mrs

cat >judge.py <<'END2'
import math, sys
from look import *
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def unit(a): return [x / dot(a, a) ** 0.5 for x in a]
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def less(a, b): return [x - y for x, y in zip(a, b)]
color, off, angles, plain = picture(sys.argv[2]), 0, [], []
normal = picture(sys.argv[3]) if len(sys.argv) > 3 else None
for face in corners(sys.argv[1]):
    e, d = ([less(face[k][j], face[0][j]) for k in (1, 2)] for j in (0, 1))
    tangent = [a * d[1][1] - b * d[0][1] for a, b in zip(*e)]
    for s in range(1, 8): # places inside, where the texel's own is near
        for t in range(1, 8 - s):
            w = (1 - (s + t) / 8, s / 8, t / 8)
            p, uv, n = ([sum(w[k] * face[k][j][i] for k in range(3)) for i in range(m)] for j, m in ((0, 3), (1, 2), (2, 3)))
            n = unit(n)
            a = dot(p, n)
            root = (a * a - dot(p, p) + 1) ** 0.5
            t0 = min(-a - root, -a + root, key=abs)
            p = [x + t0 * y for x, y in zip(p, n)] # what the texel sees of the sphere
            off = max([off] + [abs(c - 255 * (0.5 + 0.4 * x)) for c, x in zip(texel(color, *uv), p)])
            if normal:
                x, y, z = (c / 127.5 - 1 for c in texel(normal, *uv))
                t1 = unit(less(tangent, [dot(tangent, n) * x for x in n]))
                b1 = cross(n, t1)
                baked = [x * a + y * b + z * c for a, b, c in zip(t1, b1, n)]
                angles.append(math.degrees(math.acos(min(1, dot(unit(baked), p)))))
                plain.append(math.degrees(math.acos(min(1, dot(n, p)))))
def stretch(face): # least and greatest length of the texture for one on the face, and both areas
    e, d = ([less(face[k][j], face[0][j]) for k in (1, 2)] for j in (0, 1))
    (a, b, c), (A, B, C) = ((dot(v[0], v[0]), dot(v[0], v[1]), dot(v[1], v[1])) for v in (e, d))
    det, half = a * c - b * b, (A * c + C * a - 2 * B * b) / 2
    root = max(half * half - det * (A * C - B * B), 0) ** 0.5
    return ((half - root) / det) ** 0.5, ((half + root) / det) ** 0.5, det ** 0.5, (A * C - B * B) ** 0.5
of = [stretch(face) for face in corners(sys.argv[1])]
mean = (sum(s[3] for s in of) / sum(s[2] for s in of)) ** 0.5
if any(s[1] > 2 * mean or s[0] < mean / 2 for s in of):
    print('stretched')
print('colours are the sphere\'s' if off < 8 else 'off by %g' % off)
if normal:
    print('normals are the sphere\'s' if sum(angles) < sum(plain) / 2 else 'normals: %g for %g' % (sum(angles), sum(plain)))
END2
echo '-- colours of vertices'
mr-map --bake ball.mrs -w maps/none coarse.mrs >/dev/null
echo "exit $?"
mkdir maps
mr-map --bake ball.mrs -w maps/ball --size 512 --stats stats coarse.mrs -o baked.mrs
figures stats
ls maps
cat maps/ball.mtl
mr-info baked.mrs | sed -n '/mesh:/,/mtllib/p' | cut -c1-33
mr-export maps/ball.obj <baked.mrs
python3 judge.py maps/ball.obj maps/ball-color.png maps/ball-normal.png
mr-export --materials maps maps/ball.glb <baked.mrs && strings maps/ball.glb | grep -o 'baseColorTexture\|normalTexture' | sort -u

echo '-- the same for every number of threads'
for j in 1 3; do
	mr-map -j $j --bake ball.mrs -w t$j --size 256 coarse.mrs --no-history | mr-info >said$j
done
cmp t1-color.png t3-color.png && cmp t1-normal.png t3-normal.png && echo same

echo '-- texture coordinates that are there and do not overlap serve'
mr-map --bake ball.mrs -w again --size 512 --stats stats baked.mrs -o again.mrs
figures stats
mr-export again.obj <again.mrs
python3 judge.py again.obj again-color.png again-normal.png

echo '-- a picture becomes a picture'
mr-export maps/textured.obj <baked.mrs
mr-simplify -q -n 60 ball.mrs | mr-map --bake maps/textured.obj -w third --size 256 | mr-export third.obj
python3 judge.py third.obj third-color.png
mr-simplify -q -n 60 ball.mrs | mr-map --bake again.obj --texture maps/ball-color.png -w third --size 256 | mr-export third.obj
python3 judge.py third.obj third-color.png

echo '-- points'
mr-import -q --points ball.obj | mr-export points.ply
mr-map --bake points.ply -w points --size 256 coarse.mrs | mr-export points.obj
ls points-*
python3 judge.py points.obj points-color.png

echo '-- a displaced surface'
mr-simplify -q --to control -n 40 ball.mrs | mr-sample -q -n 3 -o scan.mrs
mr-map --bake points.ply -w scan --size 256 --stats stats scan.mrs -o scan-baked.mrs
figures stats
ls scan-*
mr-info scan-baked.mrs | sed -n '/control:/,/mtllib/p' | cut -c1-33

echo '-- refusals'
refused() {
	rm -f no-*
	mr-map "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(sed 's/[0-9]* charts/N charts/; 1q' err)"
	ls no-* no.mtl 2>/dev/null || true
}
mr-make sphere -n 100 --points 50 | mr-export -f xyz - | awk '{ print $1, $2, $3 }' >bare.xyz
refused --bake ball.mrs coarse.mrs
refused --bake ball.mrs -r no.png coarse.mrs
refused --bake - -w no coarse.mrs
refused --bake absent.mrs -w no coarse.mrs
refused --bake look.py -w no coarse.mrs
refused --bake ball.mrs -w no -n 2 coarse.mrs
refused --bake ball.mrs -w no --range 0,1 coarse.mrs
refused --bake ball.mrs -w no -l points coarse.mrs
refused -w no -l mesh coarse.mrs
refused -w no --texture a.png coarse.mrs
refused --bake ball.mrs -w no --texture absent.png coarse.mrs
refused --bake baked.mrs -w no --texture absent.png coarse.mrs
refused --bake bare.xyz -w no coarse.mrs
refused --bake ball.mrs -w no --size 4 coarse.mrs
refused --bake ball.mrs -w no points.ply
