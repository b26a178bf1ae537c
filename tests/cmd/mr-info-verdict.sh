# One word for each frame, by the findings that it carries.
python3 - >all.mrs <<'X'
import struct, sys, zlib
def record(name, data=b"", layer=b""):
	head = layer.ljust(16, b"\0") + name.ljust(24, b"\0") + b"-t\1\0"
	tail = struct.pack("<QQ", len(data), len(data))
	crc = struct.pack("<I", zlib.crc32(data, zlib.crc32(head + bytes(4) + tail)))
	return head + crc + tail + data + bytes(-len(data) % 64)
def line(kind, count):
	return b"mr-x\t%s\tmesh\t%d\t900\t0\t0\t\t\t\t\t\n" % (kind, count)
out = record(b"START", layer=b"mrmesh1\n")
for lines in ([], [(b"lost", 3)], [(b"lost", 3), (b"folded", 1)], [(b"folded", 1), (b"crossing", 90)]):
	out += record(b"FRAME", b"key x") + record(b"findings", b"".join(line(*x) for x in lines)) + record(b"ENDFRAME")
sys.stdout.buffer.write(out + record(b"END"))
X
mr-info --verdict all.mrs
