# Pictures one behind the other: those of the frames, each whole, as another program reads them.
cat >pictures.py <<'P'
import struct, sys, zlib
def ppm(data, at):
	"""Width, height, rows of bytes, and where it ends."""
	magic, width, height, most = (data[at:at + 40].split(None, 4))[:4]
	assert magic == b"P6" and most == b"255"
	at += len(b"P6\n%s %s\n255\n" % (width, height))
	width, height = int(width), int(height)
	assert at + 3 * width * height <= len(data)
	return width, height, [data[at + 3 * width * y:at + 3 * width * (y + 1)] for y in range(height)], at + 3 * width * height
def png(data, at):
	assert data[at:at + 8] == b"\x89PNG\r\n\x1a\n"
	at, packed, kind = at + 8, b"", b""
	while kind != b"IEND":
		size, kind = struct.unpack(">I4s", data[at:at + 8])
		body = data[at + 8:at + 8 + size]
		assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body)
		if kind == b"IHDR":
			width, height, depth, color = struct.unpack(">IIBB", body[:10])
			assert (depth, color) == (8, 2)
		packed += body if kind == b"IDAT" else b""
		at += 12 + size
	raw, rows, before = zlib.decompress(packed), [], bytes(3 * width)
	for y in range(height):
		line = raw[y * (3 * width + 1):(y + 1) * (3 * width + 1)]
		assert line[0] in (0, 2)
		before = bytes((a + b) & 255 for a, b in zip(line[1:], before)) if line[0] else line[1:]
		rows.append(before)
	return width, height, rows, at
def all_of(path):
	data, at, out = open(path, "rb").read(), 0, []
	while at < len(data):
		width, height, rows, at = (ppm if data[at:at + 2] == b"P6" else png)(data, at)
		out.append((width, height, rows))
	return out
P
mr-make torus -n 500 | mr-select --free all --handle 0=above:z,0.8 | mr-pose --frames 3 --translate 1,0,0 >poses.mrs
mr-make cube -n 100 >cube.mrs
cat poses.mrs cube.mrs >frames.mrs
mr-render -q -s 64x48 'each-%d.png' <frames.mrs && cat each-?.png >each
mr-render -q -s 64x48 -f png - <frames.mrs >all.png && cmp each all.png && echo 'the pictures of the frames'
mr-render -q -s 64x48 -f ppm - <frames.mrs >all.ppm
python3 -c 'from pictures import *; a, b = all_of("all.png"), all_of("all.ppm"); print(*("%dx%d" % p[:2] for p in b), "the same" if a == b else "other")'
mr-render -q -s 64x48 -f ppm 'each-%d.ppm' <frames.mrs && cat each-?.ppm | cmp - all.ppm && echo 'the same as files'
mr-render -q -s 64x48 --same -f ppm - <frames.mrs >same.ppm && mr-render -q -s 64x48 --same -f ppm 'same-%d.ppm' <frames.mrs && cat same-?.ppm | cmp - same.ppm && echo 'of one camera'
mr-render -q -s 64x48 --sheet --columns 5 -f ppm - <frames.mrs >sheet.ppm && python3 -c 'from pictures import *; print(*("%dx%d" % p[:2] for p in all_of("sheet.ppm")))'
mr-render -q -s 64x48 -f ppm --sync one.ppm <cube.mrs && tail -c "$(wc -c <one.ppm)" all.ppm | cmp - one.ppm && echo "one of them"

echo '-- what fails'
mr-render -q -s 64x48 - <frames.mrs >none 2>err; echo "exit $?, $(wc -c <none) bytes: $(head -n 1 err)"
mr-render -f ppm a.png <cube.mrs 2>err; echo "exit $?: $(head -n 1 err)"
mr-render -f ppm cube.mrs 2>err; echo "exit $?: $(head -n 1 err)"
mr-render -f gif - <cube.mrs >none 2>err; echo "exit $?, $(wc -c <none) bytes: $(head -n 1 err)"
head -c 64 cube.mrs >empty.mrs && tail -c 64 cube.mrs >>empty.mrs
mr-render -f ppm - <empty.mrs >none 2>err; echo "exit $?, $(wc -c <none) bytes: $(head -n 1 err)"
head -c $(($(wc -c <frames.mrs) - 64)) frames.mrs | mr-render -q -s 64x48 -f ppm - >cut.ppm 2>err; echo "exit $?"
python3 -c 'from pictures import *; print(len(all_of("cut.ppm")), "whole pictures")'
mr-render -q -f ppm - <frames.mrs | head -c 100 >/dev/null; echo 'nobody reads on'
