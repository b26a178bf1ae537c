# Names that would be markup, scripts or another direction of text, if they were anything but text: nothing of them is run.
. "$TOP/tests/page/begin"
python3 - >hostile.mrs <<'X'
import struct, sys, zlib
def record(layer, name, shape=(b"-", b"t", 1), rows=0, data=b""):
	h = layer.ljust(16, b"\0") + name.ljust(24, b"\0") + shape[0] + shape[1] + bytes([shape[2], 0])
	tail = struct.pack("<QQ", rows, len(data))
	return h + struct.pack("<I", zlib.crc32(data, zlib.crc32(h + b"\0\0\0\0" + tail))) + tail + data + b"\0" * (-len(data) % 64)
def text(layer, name, s):
	return record(layer, name, rows=len(s), data=s)
def frame(name, layer, column):
	return (text(b"", b"FRAME", name.encode())
		+ record(layer, b"position", (b"v", b"d", 3), 4, struct.pack("<12d", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0))
		+ record(layer, b"triangles", (b"f", b"u", 3), 2, struct.pack("<6I", 0, 1, 2, 0, 2, 3))
		+ record(layer, b"group", (b"f", b"u", 1), 2, struct.pack("<2I", 0, 1))
		+ text(layer, b"groups", "</script><img src=x onerror=alert(1)>\n\u202e\u0001'\"&lt;\n".encode())
		+ record(layer, column, (b"v", b"d", 1), 4, struct.pack("<4d", 0, 1, 2, 3))
		+ text(b"", b"history", b"<script>alert(1)</script> --\x02>\n") + record(b"", b"ENDFRAME"))
sys.stdout.buffer.write(record(b"mrmesh1\n", b"START")
	+ frame("key <script>alert(1)<\\script>", b"<b>bold<|b>", b"<img/src=x/onerror=e>")
	+ frame("key \u202egnp.exe\"'--><!--]]>", b"\"onclick=alert()", b"__proto__")
	+ frame("key <script>window.ran=1<\u2215script>", b"constructor", b"</textarea>") + record(b"", b"END"))
X
mr-view -i hostile.mrs hostile.html || exit
exec python3 "$TOP/tests/page/hostile.py"
