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
import records, sys
for layer, name, shape, rows, data in records.read(sys.stdin.buffer.read()):
	layer, name = layer.decode(), name.decode()
	if name.isupper():
		print((name + " " + (data.decode() if name == "FRAME" else "")).strip())
	else:
		print(("%s %s %s%d %d" % (layer, name, shape[:2].decode(), shape[2], rows)).strip())' | grep -v START
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
sed -E 's/"(seconds|peak_bytes)":[^,}]*,?//g; s/,}/}/' stats

echo '-- positions within 24 bits of the extent, other numbers of the largest, wherever the model is'
cat >near.py <<'X'
import records, sys
def columns(path):
	"""Of the first frame, as the page reads them: sums of steps as numbers; without a place of its own base is where it was encoded."""
	out = records.first_frame(path)
	for how, layer, name, *more in (line.split(" ") for line in out.get(("", "page"), b"").decode().splitlines()):
		out[layer, name] = sums(out[layer, name], [float(x) for x in more])
	return {("base", "encoded"): out["base", "position"], **out}
def sums(stored, numbers):
	width = len(stored[0])
	before, at, rows = [0] * width, [0] * width, []
	for row in stored:
		code = [(x - y) % 2 ** 32 for x, y in zip(row, before)]
		at, before = [x + (c >> 1 ^ -(c & 1)) for x, c in zip(at, code)], row
		rows.append(tuple(numbers[0] * x + (numbers[1 + k] if width <= 3 else 0) for k, x in enumerate(at)) if numbers else tuple(x % 2 ** 32 for x in at))
	return rows
def worst(name, a, b):
	d = max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q))
	extent = max(max(p[c] for p in a) - min(p[c] for p in a) for c in range(3)) if name in ("position", "encoded") else max(abs(x) for p in a for x in p)
	return "good" if len(a) == len(b) and 0 < d / extent <= 2 ** -24 else d / extent
def centred(response, text):
	"""As the page has it: to maps about the place that its text tells."""
	c = [float(x) for line in text.splitlines() if line.startswith("steps base response") for x in line.split(" ")[4:]]
	return [[x - c[i % 4] * p[i - i % 4 + 3] if i % 4 < 3 else x for i, x in enumerate(p)] for p in response]
a, b = (columns(path) for path in sys.argv[1:3])
for layer, name in (("mesh", "position"), ("base", "position"), ("base", "encoded"), ("base", "response"), ("mesh", "detail_bary"), ("mesh", "detail_height")):
	of = centred(a[layer, name], b["", "page"].decode()) if name == "response" else a[layer, name]
	print(layer, name, worst(name, of, b[layer, name]))
print("whole numbers", *(("the same" if a[key] == b[key] else "other:") + " %s.%s" % key for key in b if b[key] and type(b[key][0]) is tuple and type(b[key][0][0]) is int))
X
python3 near.py edit.mrs edit.back
mr-make bumpy -n 400 | mr-transform --translate 5e5,4e6,-3e5 | mr-smooth | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
	mr-solve --basis | mr-encode -o far.mrs && mr-view -i far.mrs far.html && stream_of far.html >far.back && python3 near.py far.mrs far.back

echo '-- the same bytes, to a file, to stdout, through a pipe, behind a link, by any number of threads'
mr-view -j 3 - <edit.mrs | cmp - edit.html && echo same
mkfifo pipe
mr-view -i edit.mrs pipe & cat pipe >read.html
wait; [ -p pipe ] && cmp edit.html read.html && echo 'same through a pipe'
ln -s real.html link.html; : >real.html
mr-view -i edit.mrs link.html && [ -L link.html ] && cmp edit.html real.html && echo 'same behind a link'
mr-view --sync -i edit.mrs one.HTML && cmp edit.html one.HTML && echo 'same on the disk'

echo '-- names are in the data alone'
python3 - >hostile.mrs <<'X'
import struct, sys
from records import START, END, frame, record
evil = b"<script>alert(1)</script>"[:16]
sys.stdout.buffer.write(START + frame("key x<!--<script>'\"&\u202egnp".encode(),
	record(evil, b"position", b"vd\3", 3, struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)),
	record(evil, b"triangles", b"fu\3", 1, struct.pack("<3I", 0, 1, 2)),
	record(evil, b"<script>alert(1)", b"vd\1", 3, struct.pack("<3d", 0, 1, 2))) + END)
X
mr-view -i hostile.mrs hostile.html && stream_of hostile.html >hostile.back && columns hostile.back
cut() { # page, without its data
	grep -v 'class="stream"' "$1"
}
cut hostile.html >a && cut edit.html | cmp - a && echo 'the same around them'

echo '-- a frame without a layer to see is a page, a stream without a frame is not'
mr-make cube -n 8 | mr-select --free all -o cube.mrs
python3 -c '
from records import *
void = frame(b"key void", record(b"handles", b"transform", b"vd\14", 1, bytes(96)))
__import__("sys").stdout.buffer.write(START + void + END)' >void.mrs
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
echo '-- a basis that mr-decode would refuse is not taken; without the base it is not asked for'
cat >change.py <<'X'
"""The stream, with the first values, or the components, of a column changed."""
import records, struct, subprocess, sys
wanted, what, value = sys.argv[1:]
def other(layer, name, shape, rows, data):
	if name != wanted.encode():
		return layer, name, shape, rows, data
	if what == "components":
		n = int(value)
		return layer, name, shape[:2] + bytes([n, 0]), rows, data[:rows * 8 * n]
	first = struct.pack(what, float(value) if what == "<d" else int(value))
	return layer, name, shape, rows, first + data[len(first):]
stream = subprocess.run(["mr-cat", "-u", "edit.mrs"], stdout=subprocess.PIPE, check=True).stdout
sys.stdout.buffer.write(records.changed(stream, other))
X
for change in 'response <d nan' 'response components 5' 'detail_face <I 1000000' 'detail_bary <d 7' 'encoded <d inf'; do
	python3 change.py $change >changed.mrs
	mr-view -i changed.mrs none.html; echo "$change: exit $?"
	mr-view -l mesh -i changed.mrs changed.html || echo "the mesh: exit $?"
done
echo '-- a frame that is left out'
cat edit.mrs cube.mrs | mr-view -k -l base left.html; echo "exit $?"
stream_of left.html >left.back && cmp left.back base.back && echo 'the others are there'
echo '-- a displaced subdivision surface is control mesh and heights; mesh is not stored where mr-decode made it on the finest level'
mr-make sphere -n 400 | mr-simplify -t control -n 40 | mr-sample -n 2 -o with-mesh.mrs
mr-export -l control -f off -i with-mesh.mrs - | mr-import -l control -o control.mrs
mr-make sphere --points 500 | mr-cat --merge - control.mrs | mr-sample -q -n 2 -o scan.mrs
surface() { # stream, options: what is stored, but for points
	of=$1; shift
	mr-view "$@" -i "$of" scan.html && stream_of scan.html >scan.back && columns scan.back | grep -v points && mr-cat -u scan.back | tr '\0' '\n' | grep -a '^surface'
}
surface scan.mrs
for j in 2 1; do
	mr-decode -q --level $j scan.mrs -o decoded.mrs && surface decoded.mrs
done
surface with-mesh.mrs | grep -v control
surface decoded.mrs -l mesh
surface scan.mrs -l displacement
echo '-- one that mr-decode would refuse is refused'
mr-view -l displacement -i edit.mrs none.html; echo "exit $?"
mr-view -l displacement -i cube.mrs none.html; echo "exit $?"
sed 's/edit.mrs/scan.mrs/' change.py >change-scan.py
for change in 'height <d nan' 'level <I 3' 'level <I 77' 'triangles <I 5'; do
	python3 change-scan.py $change >changed.mrs
	mr-view -i changed.mrs none.html; echo "$change: exit $?"
	mr-view -l points -i changed.mrs changed.html || echo "the points: exit $?"
done
