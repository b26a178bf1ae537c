# A model that is read and written says what it said: polygons, corners, marks, properties, to the bit.
for python in python3 /usr/bin/python3; do
	$python -c 'import numpy' 2>/dev/null && break
	python=
done
[ -n "$python" ] || { echo 'no Python with numpy'; exit 77; }

# Of our own making: quads, n-gons, concave ones and one around a hole; seams, creases, corners without; marks that
# come, change and go; properties of every type.
$python - <<'X'
import math, random, struct
random.seed(1)
n = 12
out = ["mtllib some colours.mtl", "mtllib b.mtl"]
for i in range(n + 1):
    for j in range(n):
        a, b = math.pi * i / n, 2 * math.pi * j / n
        out.append("v %r %r %r" % (math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)))
out += ["vt %r %r" % (random.random(), random.random()) for _ in range(300)]
out += ["vn %r %r %r" % tuple(random.uniform(-1, 1) for _ in range(3)) for _ in range(200)]
def corner(v, k):
    t, m = random.randint(1, 300), random.randint(1, 200)
    return ["%d" % v, "%d/%d" % (v, t), "%d//%d" % (v, m), "%d/%d/%d" % (v, t, m)][k]
for i in range(n):
    out.append(["o ball of wool", "g a b", "usemtl red", "s %d" % i, "s off", "usemtl"][i % 6])
    for j in range(n):
        ring = [i * n + j + 1, (i + 1) * n + j + 1, (i + 1) * n + (j + 1) % n + 1, i * n + (j + 1) % n + 1]
        k = random.randint(0, 3)
        r = random.randint(0, 3)
        out.append("f " + " ".join(corner(v, k) for v in ring[r:] + ring[:r]))
base = n * (n + 1)
for x, y in [(0, 0), (9, 0), (9, 9), (0, 9), (3, 3), (3, 6), (6, 6), (6, 3), (5, 1), (20, 0), (22, 4), (24, 0), (22, 9)]:
    out.append("v %d %d 7" % (x, y))
hole = [0, 1, 2, 3, 0, 4, 5, 6, 7, 4]
out.append("g flat\nf " + " ".join(str(base + 1 + k) for k in hole))
out.append("f " + " ".join(str(base + 1 + k) for k in [10, 11, 12, 9]))
open("own.obj", "w").write("\n".join(out) + "\n")

types = [("char", "b"), ("uchar", "B"), ("short", "h"), ("ushort", "H"), ("int", "i"), ("uint", "I"), ("float", "f"),
         ("double", "d")]
limits = {"b": (-128, 127), "B": (0, 255), "h": (-32768, 32767), "H": (0, 65535), "i": (-2**31, 2**31 - 1),
          "I": (0, 2**32 - 1)}
def value(c):
    if c in limits:
        return random.choice(limits[c] + (0, 1))
    return struct.unpack("f", struct.pack("f", random.uniform(-9, 9)))[0] if c == "f" else random.uniform(-9, 9)
for order, name in (("<", "little"), (">", "big")):
    head = "ply\nformat binary_%s_endian 1.0\nelement vertex 60\n" % name
    head += "".join("property double %s\n" % s for s in ("x", "y", "z", "nx", "ny", "nz"))
    head += "".join("property %s v_%s\n" % (t, t) for t, _ in types) + "property float quality\n"
    head += "element face 40\nproperty list uchar uint vertex_indices\nproperty list uchar float texcoord\n"
    head += "".join("property %s f_%s\n" % (t, t) for t, _ in types) + "property float quality\nproperty uchar red\n"
    body = b""
    for i in range(60):
        body += struct.pack(order + "6d", *(random.uniform(-1, 1) for _ in range(6)))
        body += b"".join(struct.pack(order + c, value(c)) for _, c in types) + struct.pack(order + "f", value("f"))
    for i in range(40):
        k = random.randint(3, 7)
        corners = random.sample(range(60), k)
        body += struct.pack(order + "B%dI" % k, k, *corners)
        body += struct.pack(order + "B%df" % (2 * k), 2 * k, *(value("f") for _ in range(2 * k)))
        body += b"".join(struct.pack(order + c, value(c)) for _, c in types)
        body += struct.pack(order + "fB", value("f"), i)
    open("own-%s.ply" % name, "wb").write(head.encode() + b"end_header\n" + body)
X
mkdir out
touch 'some colours.mtl' b.mtl 'out/some colours.mtl' out/b.mtl
most=200000
[ -z "$LONG" ] || most=1000000
n=-3 # the first three are our own
for file in own.obj own-little.ply own-big.ply "$DATA"/meshes/*; do
	n=$((n + 1))
	[ $n -le 0 ] || [ $((n % SPARSE)) -eq 0 ] || continue
	[ -n "$LONG" ] || [ "$(wc -c <"$file")" -lt 2000000 ] || continue
	name=${file##*/}
	case $(echo "$name" | tr '[:upper:]' '[:lower:]') in
	*.obj | *.obj.gz) format=obj ;;
	*.off | *.off.gz) format=off ;;
	*.ply | *.ply.gz) format=ply ;;
	*.stl | *.stl.gz) format=stl ;;
	*) continue ;;
	esac
	mr-import "$file" 2>said | mr-export -f $format "out/$name" 2>>said || { echo "$name is not read"; exit 1; }
	case $file in
	# Of 300 that corners choose from; the polygon around a hole.
	own*) ! grep -v -e 'that no corner names' -e 'polygons that are none any more' said || exit 1 ;;
	esac
	# The largest are read by Python in no time that a test may take.
	[ "$(wc -c <"$file")" -gt $most ] || printf '%s\t%s\t%s\n' $format "$file" "out/$name"
done >list
$python "$TOP/tests/pipe/same-model.py" <list || exit
# In PLY faces and texture coordinates of corners go out and come back, too.
sed -E '/^(vn|mtllib|o|g|s|usemtl)/d; /^f/s,/([0-9]*)/[0-9]*,/\1,g' own.obj >bare.obj
for format in ply ply-ascii; do
	mr-import -q bare.obj | mr-export -q -f $format own.x && mr-import own.x | mr-export -q out/again.obj || exit
	printf 'obj\tbare.obj\tout/again.obj\n' | $python "$TOP/tests/pipe/same-model.py" || exit
done
