# The page holds the stream: what it takes of a frame, deltas, the same bytes every time; and no page where something fails.
stream_of() { # page: the stream that it holds
	python3 - "$1" <<'X'
import base64, re, sys
page = open(sys.argv[1], encoding="utf-8").read()
for block in re.findall('<script type="text/plain" class="stream">([A-Za-z0-9+/=]*)</script>\n', page):
	sys.stdout.buffer.write(base64.b64decode(block, validate=True))
X
}
columns() { # stream: layer, column, shape and rows of each frame
	mr-cat -u --no-history "$1" | python3 -c '
import struct, sys
data, at = sys.stdin.buffer.read(), 0
while at < len(data):
	h = data[at:at + 64]
	rows, stored = struct.unpack("<QQ", h[48:64])
	layer, name = h[:16].rstrip(b"\0").decode(), h[16:40].rstrip(b"\0").decode()
	text = data[at + 64:at + 64 + stored].decode() if name == "FRAME" else ""
	print(("%s %s %s%s%d %d" % (layer, name, chr(h[40]), chr(h[41]), h[42], rows)).strip() if not name.isupper() else (name + " " + text).strip())
	at += 64 + (stored + 63) // 64 * 64' | grep -v START
}
echo '-- what is taken of an edit'
mr-make bumpy -n 400 --texcoords | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
	mr-solve --basis | mr-encode >edit.mrs
mr-view -i edit.mrs edit.html && stream_of edit.html >edit.back && columns edit.back
echo '-- one layer of it'
mr-view -l base -i edit.mrs base.html && stream_of base.html >base.back && columns base.back
echo '-- deltas stay deltas'
mr-pose -H 1 --translate 0.1,0,0 --frames 2 edit.mrs | mr-decode >film.mrs
mr-view --stats stats -l mesh film.html <film.mrs && stream_of film.html >film.back && columns film.back
sed -E 's/"(seconds|peak_bytes)":[^,}]*,?//g' stats

echo '-- positions within 24 bits of the extent, other numbers within 24 of their own, wherever the model is'
cat >near.py <<'X'
import struct, subprocess, sys
def column(path, name):
	data, at = subprocess.run(["mr-cat", "-u", path], stdout=subprocess.PIPE, check=True).stdout, 0
	while at < len(data):
		rows, stored = struct.unpack("<QQ", data[at + 48:at + 64])
		if data[at + 16:at + 40].rstrip(b"\0") == name and data[at:at + 4] == b"mesh":
			return struct.unpack("<%dd" % (stored // 8), data[at + 64:at + 64 + stored])
		at += 64 + (stored + 63) // 64 * 64
a, b = (column(path, b"position") for path in sys.argv[1:3])
extent = max(max(a[c::3]) - min(a[c::3]) for c in range(3))
worst = max(abs(x - y) for x, y in zip(a, b)) / extent
print("positions", "good" if 0 < worst <= 2 ** -24 else worst)
a, b = (column(path, b"detail_height") for path in sys.argv[1:3])
worst = max((abs(x - y) / abs(x) for x, y in zip(a, b) if x), default=1)
print("heights", "good" if 0 < worst <= 2 ** -24 else worst)
X
python3 near.py edit.mrs edit.back
mr-transform --translate 5e5,4e6,-3e5 edit.mrs -o far.mrs && mr-view -i far.mrs far.html && stream_of far.html >far.back && python3 near.py far.mrs far.back

echo '-- the same bytes, to a file, to stdout, through a pipe, behind a link, by any number of threads'
mr-view -j 3 - <edit.mrs | cmp - edit.html && echo same
mkfifo pipe
mr-view -i edit.mrs pipe & cat pipe >read.html
wait; [ -p pipe ] && cmp edit.html read.html && echo 'same through a pipe'
ln -s real.html link.html; : >real.html
mr-view -i edit.mrs link.html && [ -L link.html ] && cmp edit.html real.html && echo 'same behind a link'
mr-view --sync -i edit.mrs one.HTML && cmp edit.html one.HTML && echo 'same on the disk'

echo '-- names are in the data alone'
cat >records.py <<'X'
import struct, sys, zlib
def record(layer, name, shape=(b"-", b"t", 1), rows=0, data=b""):
	h = layer.ljust(16, b"\0") + name.ljust(24, b"\0") + shape[0] + shape[1] + bytes([shape[2], 0])
	tail = struct.pack("<QQ", rows, len(data))
	crc = zlib.crc32(data, zlib.crc32(h + b"\0\0\0\0" + tail))
	return h + struct.pack("<I", crc) + tail + data + b"\0" * (-len(data) % 64)
def text(layer, name, s):
	return record(layer, name, rows=len(s), data=s)
def frame(name, *records):
	return text(b"", b"FRAME", name.encode()) + b"".join(records) + record(b"", b"ENDFRAME")
def write(*frames):
	sys.stdout.buffer.write(record(b"mrmesh1\n", b"START") + b"".join(frames) + record(b"", b"END"))
X
python3 - >hostile.mrs <<'X'
from records import *
evil = b"<script>alert(1)</script>"[:16]
write(frame("key x<!--<script>'\"&\u202egnp",
	record(evil, b"position", (b"v", b"d", 3), 3, struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)),
	record(evil, b"triangles", (b"f", b"u", 3), 1, struct.pack("<3I", 0, 1, 2)),
	record(evil, b"<script>alert(1)", (b"v", b"d", 1), 3, struct.pack("<3d", 0, 1, 2))))
X
mr-view -i hostile.mrs hostile.html && stream_of hostile.html >hostile.back && columns hostile.back
cut() { # page, without its data
	grep -v 'class="stream"' "$1"
}
cut hostile.html >a && cut edit.html | cmp - a && echo 'the same around them'

echo '-- a frame without a layer to see is a page, a stream without a frame is not'
mr-make cube -n 8 | mr-select --free all -o cube.mrs
python3 -c 'from records import *; write(frame("key void", record(b"handles", b"transform", (b"v", b"d", 12), 1, bytes(96))))' >void.mrs
mr-view -i void.mrs void.html && stream_of void.html >void.back && columns void.back
head -c 64 cube.mrs >empty.mrs && tail -c 64 cube.mrs >>empty.mrs
mr-view -i empty.mrs none.html; echo "exit $?"
printf x >empty.txt; mr-view -i empty.txt none.html; echo "exit $?"

echo '-- a failure leaves no page, and the old one'
: >old.html
for bytes in 0 1000 $(($(wc -c <edit.mrs) - 64)); do
	head -c "$bytes" edit.mrs | mr-view old.html 2>err; echo "exit $?: $(cat err)"
done
mr-view -l control -i edit.mrs none.html; echo "exit $?"
mr-view -l mesh,control -i edit.mrs none.html; echo "exit $?"
mr-view -i edit.mrs no/such/folder.html; echo "exit $?"
[ -e old.html ] && [ ! -s old.html ] && echo 'the old page'
ls none.html* mr-*~ 2>/dev/null || echo 'no page'
echo '-- a frame that is left out'
cat edit.mrs cube.mrs | mr-view -k -l base left.html; echo "exit $?"
stream_of left.html >left.back && cmp left.back base.back && echo 'the others are there'
