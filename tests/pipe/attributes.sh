# Textures, materials and colours of a simplified or remeshed mesh are those of the places on the mesh that it was; seams, borders
# and what is locked stay.  Beside formulas, from OBJ files alone.
cat >check.py <<'PY'
import math, sys

def read(path):
    points, coordinates, faces, material = [], [], [], None
    for word in (line.split() for line in open(path) if line.strip()):
        if word[0] == "v":
            points.append(tuple(map(float, word[1:4])))
        elif word[0] == "vt":
            coordinates.append(tuple(map(float, word[1:3])))
        elif word[0] == "usemtl":
            material = word[1]
        elif word[0] == "f":
            faces.append((material, [[int(x) - 1 for x in corner.split("/")[:2]] for corner in word[1:]]))
    return points, coordinates, faces

def write(path, points, coordinates, faces):
    with open(path, "w") as file:
        for p in points:
            print("v", *map(repr, p), file=file)
        for t in coordinates:
            print("vt", *map(repr, t), file=file)
        for material, face in faces:
            if material:
                print("usemtl", material, file=file)
            print("f", *("%d/%d" % (a + 1, b + 1) if coordinates else a + 1 for a, b in face), file=file)

def at(u, v):
    t, s = 2 * math.pi * u, math.pi * v
    return (math.sin(s) * math.cos(t), -math.cos(s), -math.sin(s) * math.sin(t))

def make_sphere(n, name, jag=0):  # unwelded along the meridian u = 0 and at the poles; a seam with teeth of jag cells
    points = [at(i / (2 * n), j / n) for j in range(n + 1) for i in range(2 * n + 1)]
    coordinates = [(i / (2 * n), j / n) for j in range(n + 1) for i in range(2 * n + 1)]
    coordinates += [(u + 1, v) for u, v in coordinates if jag]
    w, faces = 2 * n + 1, []
    for j in range(n):
        for i in range(2 * n):
            a, b, c, d = j * w + i, j * w + i + 1, (j + 1) * w + i + 1, (j + 1) * w + i
            around = len(points) if i < jag and j // jag % 2 else 0
            faces += [("checker", [(k, k + around) for k in t]) for t in ([] if j == 0 else [(a, b, c)]) +
                      ([] if j == n - 1 else [(a, c, d)])]
    write(name, points, coordinates, faces)

def check_sphere(name, most):
    points, coordinates, faces = read(name)
    assert 0 < len(faces) <= most and {m for m, _ in faces} == {"checker"}, len(faces)
    for _, face in faces:
        us = [coordinates[t][0] for _, t in face]
        assert max(us) - min(us) < 0.5, us
        for p, t in face:
            x, y, z = points[p]
            r, (u, v) = math.hypot(x, y, z), coordinates[t]
            off = abs(u - math.atan2(-z, x) / 2 / math.pi) % 1
            assert abs(r - 1) < 0.05 and abs(v - 1 + math.acos(y / r) / math.pi) < 0.02, (r, v)
            assert abs(y / r) > 0.98 or min(off, 1 - off) < 0.02, (u, points[p])

def make_square(n, name):  # two materials, left and right of x = 0.5
    points = [(i / n, j / n, 0.0) for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for side in "red", "blue":
        for j in range(n):
            for i in range(n):
                a, b, c, d = j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i
                if (i < n / 2) == (side == "red"):
                    faces += [(side, [(k, 0) for k in t]) for t in ((a, b, c), (a, c, d))]
    write(name, points, [], faces)

def check_square(name):
    points, _, faces = read(name)
    area = {"red": 0, "blue": 0}
    for material, face in faces:
        (ax, ay, _), (bx, by, _), (cx, cy, _) = (points[c[0]] for c in face)
        area[material] += ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
        assert all(x <= 0.5 + 1e-9 if material == "red" else x >= 0.5 - 1e-9 for x in (ax, bx, cx))
    assert all(abs(a - 0.5) < 1e-9 for a in area.values()), area

def rim(name):
    return sorted(p for p in read(name)[0] if p[0] in (0, 1) or p[1] in (0, 1))

what, name, *more = sys.argv[1:]
if what == "rim":
    assert rim(name) == rim(more[0])
else:
    globals()[what](*([int(more[0]), name, *map(int, more[1:])] if what.startswith("make") else [name, *map(int, more)]))
PY
python3 check.py make_sphere sphere.obj 24 && mr-import -q sphere.obj -o sphere.mrs || exit
for share in 0.5 0.2 0.1; do
	mr-simplify -r $share sphere.mrs | mr-export -q out.obj || exit
	python3 check.py check_sphere out.obj "$(awk -v s=$share 'BEGIN { print int(s * 2208) + 1 }')" || exit
	mr-simplify -j 1 -r $share sphere.mrs | mr-export -q one.obj && cmp out.obj one.obj || exit
done
for ratio in 0.7 1 2; do
	mr-remesh -r $ratio sphere.mrs | mr-export -q -l base out.obj && python3 check.py check_sphere out.obj 5000 || exit
	mr-remesh -j 1 -r $ratio sphere.mrs | mr-export -q -l base one.obj && cmp out.obj one.obj || exit
done
mr-import -q sphere.obj | mr-simplify -n 300 | mr-info --json >info.json || exit
grep -q '"euler":2,.*"boundary_loops":0' info.json || { echo 'a seam has parted'; cat info.json; exit 1; }

# A seam with teeth costs little of the shape.
python3 check.py make_sphere jagged.obj 24 1 && mr-import -q jagged.obj -o jagged.mrs || exit
for name in sphere jagged; do
	mr-simplify -q -n 100 $name.mrs | mr-compare -q --json $name.mrs | grep -o '"mean":[^,]*' | sed -n '1s/.*://p' >mean.$name || exit
done
awk 'NR == FNR { most = 1.1 * $1; next } $1 > most { print $1, "of", most; exit 1 }' mean.sphere mean.jagged ||
    { echo 'a seam with teeth takes faces from the shape'; exit 1; }

python3 check.py make_square square.obj 20 && mr-import -q square.obj -o square.mrs || exit
mr-simplify -n 40 square.mrs | mr-export -q out.obj && python3 check.py check_square out.obj || exit
mr-remesh -r 1.5 square.mrs | mr-export -q -l base out.obj && python3 check.py check_square out.obj || exit
for lock in boundary region:0; do
	mr-select --free all --fixed boundary square.mrs | mr-simplify --lock $lock -r 0.2 | mr-export -q out.obj || exit
	python3 check.py rim out.obj square.obj || exit
done

# Colours are the mean of those around: a function linear in the place comes back.
awk 'BEGIN { print "ply\nformat ascii 1.0\nelement vertex 441\nproperty double x\nproperty double y\nproperty double z"
	print "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 800"
	print "property list uchar int vertex_indices\nend_header"
	for (j = 0; j <= 20; j++) for (i = 0; i <= 20; i++) print i / 20, j / 20, 0, 12 * i, 12 * j, 7
	for (j = 0; j < 20; j++) for (i = 0; i < 20; i++) { a = 21 * j + i; print 3, a, a + 1, a + 22; print 3, a, a + 22, a + 21 } }' >colour.ply
cat >linear.awk <<'END'
	/end_header/ { at = NR } at && NR > at && NF >= 6 { n++; for (k = 1; k <= 2; k++) {
		x = $k < 0 ? 0 : $k > 1 ? 1 : $k; d = $(k + 3) - 240 * x; if (d > 1 || d < -1 || $6 != 7) { print; bad = 1 } } }
	END { exit bad || n < 40 }
END
mr-import colour.ply | mr-simplify -n 100 | mr-export -f ply-ascii - | awk -f linear.awk &&
    mr-import colour.ply | mr-remesh -r 2 | mr-export -l base -f ply-ascii - | awk -f linear.awk &&
    mr-import colour.ply | mr-simplify --to control | mr-fit | mr-sample | mr-decode | mr-export -f ply-ascii - |
    awk -f linear.awk ||
    { echo 'colours are off'; exit 1; }

# A flat square in two colours: their border stays where it is, which distances alone do not tell.
awk '/end_header/ { at = NR } at && NR > at && NF >= 6 { $4 = $1 + $2 / 3 < 0.6 ? 200 : 40; $5 = $6 = $4 } { print }' colour.ply >step.ply
cat >step.py <<'END'
import sys
lines = open(sys.argv[1]).read().split("end_header\n")[1].split("\n")
points = [list(map(float, line.split())) for line in lines if len(line.split()) > 4]
off = total = 0
for face in (list(map(int, line.split()[1:])) for line in lines if len(line.split()) == 4):
    (ax, ay, _, ac, *_), (bx, by, _, bc, *_), (cx, cy, _, cc, *_) = (points[v] for v in face)
    area = abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
    for i in range(10):
        for j in range(10 - i):
            u, v = (i + 1 / 3) / 10, (j + 1 / 3) / 10
            x, y, c = (a + u * (b - a) + v * (d - a) for a, b, d in ((ax, bx, cx), (ay, by, cy), (ac, bc, cc)))
            off += area / 55 * abs(c - (200 if x + y / 3 < 0.6 else 40))
    total += area
assert abs(total - 1) < 1e-9, total
print(off)
END
for weight in 0 1; do
	mr-import step.ply | mr-simplify -n 60 --attributes $weight | mr-export -f ply-ascii - >out.ply &&
	    python3 step.py out.ply >off.$weight || exit
done
awk 'NR == FNR { most = $1 / 2; next } $1 > most { print $1, "of", 2 * most; exit 1 }' off.0 off.1 || { echo 'the border of colours moved'; exit 1; }
