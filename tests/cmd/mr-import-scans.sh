# What scanners write besides positions comes in: packed points, places of the scanner, intensities, labels.
python3 - <<'END'
import struct

def lzf(data): # greedy, by a table of the last place of each three bytes
    out, seen, i, start = bytearray(), {}, 0, 0
    def literals(a, b):
        while a < b:
            n = min(32, b - a)
            out.append(n - 1)
            out.extend(data[a:a + n])
            a += n
    while i + 2 < len(data):
        key = data[i:i + 3]
        at = seen.get(key, -1)
        seen[key] = i
        if at < 0 or i - at > 8192:
            i += 1
            continue
        n = 3
        while n < 264 and i + n < len(data) and data[at + n] == data[i + n]:
            n += 1
        literals(start, i)
        back, code = i - at - 1, n - 2
        out.append((min(code, 7) << 5) | back >> 8)
        if code >= 7:
            out.append(code - 7)
        out.append(back & 255)
        i += n
        start = i
    literals(start, len(data))
    return bytes(out)

n = 3000
points = [(i % 60 * 0.5, i // 60 * 0.25, 0.001 * (i * i % 997)) for i in range(n)]
points[7] = (float("nan"), 0, 0)
label = [i % 5 for i in range(n)]
rgb = [i << 8 & 0xffffff for i in range(n)]
head = ("VERSION .7\nFIELDS x y z rgb label _ shape\nSIZE 4 4 4 4 2 1 4\nTYPE F F F U U U F\nCOUNT 1 1 1 1 1 2 3\n"
        "WIDTH %d\nHEIGHT 1\nVIEWPOINT 1 2 3.5 1 0 0 0\nPOINTS %d\nDATA %%s\n" % (n, n))
fields = [b"".join(struct.pack("<f", p[k]) for p in points) for k in range(3)]
fields += [b"".join(struct.pack("<I", c) for c in rgb), b"".join(struct.pack("<H", l) for l in label), bytes(2 * n), bytes(12 * n)]
packed = lzf(b"".join(fields))
def put(name, size, unpacked, data):
    open(name, "wb").write((head % "binary_compressed").encode() + struct.pack("<II", size, unpacked) + data)
put("packed.pcd", len(packed), 32 * n, packed)
with open("plain.pcd", "wb") as f:
    f.write((head % "binary").encode())
    for p, c, l in zip(points, rgb, label):
        f.write(struct.pack("<3fIH", *p, c, l) + bytes(14))
with open("text.pcd", "w") as f:
    f.write(head % "ascii")
    for p, c, l in zip(points, rgb, label):
        f.write("%r %r %r %d %d 0 0 0 0 0\n" % (*(struct.unpack("<f", struct.pack("<f", x))[0] for x in p), c, l))
put("long.pcd", len(packed) + 1, 32 * n, packed)
put("size.pcd", len(packed), 32 * n - 1, packed)
put("short.pcd", len(packed) - 9, 32 * n, packed[:-9])
put("before.pcd", 3, 32 * n, b"\x20\x05\x00" * 2000)
open("huge.pcd", "wb").write((head % "binary_compressed").replace("3000", "4000000000").encode() + struct.pack("<II", 8, 0))
END
echo 'a packed PCD is what it was'
sed 1d text.pcd >bare.pcd
for file in packed plain text bare; do
	mr-import --no-history -q $file.pcd | mr-info | sed 's/^[a-z]*:/PCD:/' >$file.txt
	mr-import -q $file.pcd | mr-export -q - -f ply-ascii >$file.ply
	cmp packed.ply $file.ply
	cmp packed.txt $file.txt
done
head -n 8 packed.txt
sed -n '1,/end_header/p' packed.ply
mr-import packed.pcd | mr-export -f xyz - | sed -n 1,2p

echo 'damaged ones'
for file in long size short before huge; do
	mr-import $file.pcd >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(cat err)"
done

echo 'each scan of a PTX was seen from its own place'
for x in 1 20; do
	printf '2\n1\n%s 2 3\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n%s 2 3 1\n1 1 1 0.25\n0 0 0 0\n' $x $x
done >two.ptx
mr-import --no-history two.ptx | mr-transform --translate 0,0,1 | mr-export -q - -f ply-ascii | sed '1,/end_header/d'
mr-import --no-history two.ptx -o two.mrs
strings two.mrs | grep -xE 'scanner|intensity'
mr-import two.ptx | mr-crop --keep column:intensity,0.2,0.3 | mr-info | grep -E 'points:|scanner'

echo 'what of a scan has no place: how the scanner was turned, the lower bits of colours'
printf 'VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 1 2 3 %s\nDATA ascii\n0 0 0\n' '0.5 0.5 0.5 0.5' >turned.pcd
printf 'VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 1 2 3%s\nDATA ascii\n0 0 0\n' '' >place.pcd
python3 - <<'END'
import struct
head = bytearray(227)
head[:4], head[24:26], head[104] = b"LASF", b"\1\2", 2
struct.pack_into("<HI", head, 94, 227, 227)
struct.pack_into("<HI", head, 105, 26, 1)
struct.pack_into("<3d", head, 131, 1, 1, 1)
for name, color in ("coarse", (0x1200, 0xffff, 0x3434)), ("fine", (0x1200, 0xfffe, 0x3435)), ("bytes", (1, 2, 255)):
    open(name + ".las", "wb").write(head + struct.pack("<3i8x3H", 1, 2, 3, *color))
END
printf 'VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n' >grid.pcd
printf '2\n2\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 3 1\n1 1 1 .1\n2 1 1 .2\n1 2 1 .3\n2 2 1 .4\n' >grid.ptx
for file in turned.pcd place.pcd grid.pcd grid.ptx coarse.las fine.las bytes.las; do
	echo "$file: $(mr-import $file 2>&1 >out.mrs)"
	mr-export -q -i out.mrs -f ply-ascii - | sed '1,/end_header/d'
done

echo 'LAZ'
{ printf 'LASF'; head -c 100 /dev/zero; printf '\202'; head -c 200 /dev/zero; } >packed.laz
mr-import packed.laz
echo "exit $?"

echo 'columns under their names'
printf 'x y z Intensity red label\n0 0 0 0.5 7 3\n1 0 0 0.25 8 nan\n' >named.xyz
printf '2\n0 0 0 -17 1 2 3\n1 1 1 20 4 5 6\n' >scan.pts
printf '0 0 0 9.5 1\n1 1 1 8.5 2\n' >plain.xyz
for file in named.xyz scan.pts plain.xyz; do
	mr-import $file | mr-export -q - -f ply-ascii | sed '/^ply/d; /^format/d; /^element/d'
done
mr-import scan.pts | mr-export -f pts - | cmp - scan.pts && echo 'a PTS comes back'
mr-import plain.xyz | mr-export -f pts -
echo 'and what a LAS tells, but for what is 0 everywhere'
python3 - <<'END'
import struct
for form, name in ((1, "old.las"), (8, "new.las")):
    size = {1: 28, 8: 38}[form]
    head = bytearray(375)
    head[0:4] = b"LASF"
    head[24:26] = bytes((1, 4))
    struct.pack_into("<HIIBHI", head, 94, 375, 375, 0, form, size + 2, 2)
    struct.pack_into("<6d", head, 131, 0.01, 0.01, 0.01, 0, 0, 5)
    struct.pack_into("<Q", head, 247, 2)
    points = b""
    for i in range(2):
        p = struct.pack("<3iH", 100 * i, 200, 300, 60000 + i)
        if form == 1:
            p += struct.pack("<BBbBHd", 0b01010010, 0b10100110, -15, 0, 12, 1e9 + i)
        else:
            p += struct.pack("<BBBBhHd3HH", 0b01010010, 0b01100001, 200, 0, -2500, 12, 1e9 + i, 256, 512, 768, 999)
        points += p + b"\1\1"
    open(name, "wb").write(bytes(head) + points)
END
for file in old.las new.las; do
	mr-import $file 2>said | mr-export -q - -f ply-ascii | sed '/^ply/d; /^format/d; /^element/d'
	cat said
done
