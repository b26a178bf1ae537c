# Which way is up, and colours by columns of all kinds.
echo '-- up along another axis is a model that is turned'
mr-make bumpy -n 300 -o model.mrs
turned() { # axis, matrix that brings it to y
	mr-render --size 60x40 --up "$1" -i model.mrs up.png
	mr-transform --matrix "$2" model.mrs | mr-render --size 60x40 turned.png
	cmp up.png turned.png && echo "$1: the same picture"
}
turned x 0,0,1,0,1,0,0,0,0,1,0,0
turned z 1,0,0,0,0,0,1,0,0,-1,0,0

colours() { # file: how many hues there are in a picture, in steps of 30 degrees, of what is no grey
	python3 - "$1" <<'X'
import colorsys, struct, sys, zlib
data = open(sys.argv[1], "rb").read()
w, h = struct.unpack(">II", data[16:24])
at, packed = 8, b""
while at < len(data):
	n, kind = struct.unpack(">I4s", data[at:at + 8])
	packed += data[at + 8:at + 8 + n] if kind == b"IDAT" else b""
	at += 12 + n
raw, rows, before = zlib.decompress(packed), [], bytearray(3 * w)
for j in range(h):
	how, line = raw[j * (3 * w + 1)], bytearray(raw[j * (3 * w + 1) + 1:(j + 1) * (3 * w + 1)])
	for i in range(3 * w):
		a, b, c = line[i - 3] if i > 2 else 0, before[i], before[i - 3] if i > 2 else 0
		p = a + b - c
		near = a if abs(p - a) <= abs(p - b) and abs(p - a) <= abs(p - c) else b if abs(p - b) <= abs(p - c) else c
		line[i] = line[i] + (0, a, b, (a + b) // 2, near)[how] & 255
	rows.append(line)
	before = line
pixels = [tuple(row[i:i + 3]) for row in rows for i in range(0, 3 * w, 3)]
hues = {}
for p in pixels:
	hue, saturation, _ = colorsys.rgb_to_hsv(*(x / 255 for x in p))
	if saturation > 0.25:
		hues[round(12 * hue) % 12] = hues.get(round(12 * hue) % 12, 0) + 1
print(sum(n > 90 for n in hues.values()), "hues")
X
}
draw() {
	mr-render --size 80x60 --view front --no-labels "$@" && colours picture.png
}
echo '-- by a column of faces, of bytes, of text, of one that is not there'
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a\nf 1 2 3\ng b\nf 1 3 4\n' | mr-import -o groups.mrs
draw -i groups.mrs picture.png
draw -i groups.mrs -c group picture.png
printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 255 0 0\n3 0 1 2\n3 0 2 3\n' | mr-import -o bytes.mrs
draw -i bytes.mrs -c color picture.png
draw -i groups.mrs -c groups picture.png
echo "exit $?"
draw -i groups.mrs -c nowhere picture.png
echo "exit $?"
