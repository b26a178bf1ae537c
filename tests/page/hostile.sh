# Names that would be markup, scripts or another direction of text, if they were anything but text: nothing of them is
# run.
. "$TOP/tests/page/begin"
python3 - >hostile.mrs <<'X'
import struct, sys
from records import END, START, frame, record
def hostile(name, layer, column):
	return frame(name.encode(),
		record(layer, b"position", b"vd\3", 4, struct.pack("<12d", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)),
		record(layer, b"triangles", b"fu\3", 2, struct.pack("<6I", 0, 1, 2, 0, 2, 3)),
		record(layer, b"group", b"fu\1", 2, struct.pack("<2I", 0, 1)),
		record(layer, b"groups", data="</script><img src=x onerror=alert(1)>\n\u202e\u0001'\"&lt;\n".encode()),
		record(layer, column, b"vd\1", 4, struct.pack("<4d", 0, 1, 2, 3)),
		record(b"", b"history", data=b"<script>alert(1)</script> --\x02>\n"))
sys.stdout.buffer.write(START
	+ hostile("key <script>alert(1)<\\script>", b"<b>bold<|b>", b"<img/src=x/onerror=e>")
	+ hostile("key \u202egnp.exe\"'--><!--]]>", b"\"onclick=alert()", b"__proto__")
	+ hostile("key <script>window.ran=1<\u2215script>", b"constructor", b"</textarea>") + END)
X
mr-view -i hostile.mrs hostile.html || exit
exec python3 "$TOP/tests/page/hostile.py"
