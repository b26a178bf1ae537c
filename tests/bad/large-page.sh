# More data than a browser takes: one sentence that says what to do, and no page; fewer layers of the same make one.
[ -z "$SAN" ] || { echo "gigabytes, in which sanitizers see what is in megabytes"; exit 77; }
[ -n "$LONG" ] || { echo "gigabytes: make check-long"; exit 77; }
cat >noise.py <<'X'
import random, struct, sys
from records import END, START, record
random.seed(1)
n = 2000000
noise = random.randbytes(4 * n)
def frame(name):
	yield record(b"", b"FRAME", data=b"key " + name)
	for layer, columns in ((b"points", 6), (b"few", 0)):
		rows = n if columns else 3
		yield record(layer, b"position", b"vd\3", rows, struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes(24 * (rows - 3)))
		for i in range(columns):
			yield record(layer, b"noise%d" % i, b"vb\4", rows, noise[i:] + noise[:i])
	yield record(b"", b"ENDFRAME")
sys.stdout.buffer.write(START)
for i in range(int(sys.argv[1])):
	for piece in frame(b"noise-%d" % i):
		sys.stdout.buffer.write(piece)
sys.stdout.buffer.write(END)
X
python3 noise.py 7 | mr-view page.html 2>err
code=$?
[ $code -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && grep -q '^mr-view: frame 7 (noise-6): the page comes to 33[0-9] MB, and browsers take some 300: pick fewer layers by -l' err ||
	{ echo "exit $code: $(cat err)"; exit 1; }
[ ! -e page.html ] || { echo "a page of a stream that was refused"; exit 1; }
python3 noise.py 1 | mr-view -l few page.html && [ -s page.html ] || { echo "no page of one layer"; exit 1; }
