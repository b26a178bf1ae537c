# Pictures on surfaces: one for all, or those of the materials, whose files are where --materials says.
cat >card.obj <<'END'
mtllib card.mtl
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl front
f 1/1 2/2 3/3
usemtl back
f 1/1 3/3 4/4
END
mr-import card.obj -o card.mrs
mr-make torus -n 500 | mr-render -s 64x64 --no-labels torus.png
printf 'newmtl front\nKd 1 0 0\nmap_Kd torus.png\nnewmtl back\nKd 0 1 0\n' >card.mtl
render() { # NAME, option...
	name=$1
	shift
	mr-render -s 80x60 --no-labels --view front -i card.mrs "$@" "$name.png" || echo "exit $?"
}
differ() {
	cmp -s "$1.png" "$2.png" && echo "$1 looks like $2" || echo "$1 and $2 differ"
}
render plain
render texture --texture torus.png
render materials --materials .
differ plain texture
differ texture materials
render one -j 1 --materials . && render three -j 3 --materials . && differ one three
mkdir away && mv card.mtl torus.png away
render away --materials away && differ away materials

echo '-- a column goes before pictures'
mr-select --free all -l mesh card.mrs -o regions.mrs
mr-render -s 80x60 -c region -i regions.mrs region.png
mr-render -s 80x60 -c region --texture away/torus.png -i regions.mrs textured.png && differ region textured

echo '-- what is not there'
render gone --materials . && differ gone plain
render none --texture nothing.png
echo 'no picture' >text.png
render none --texture text.png
head -c 60 away/torus.png >cut.png
render none --texture cut.png
printf '\377\330\377\340 no picture' >cut.jpg
render none --texture cut.jpg
small=$TOP/tests/fuzz/seeds/jpeg-small
render whole --texture "$small"
head -c 312 "$small" >cut.jpg
render none --texture cut.jpg
echo '-- bytes before the last marker that say nothing, and what may be the rest of a picture'
padded() { # bytes
	size=$(wc -c <"$small")
	head -c $((size - 2)) "$small"
	head -c "$1" /dev/zero
	tail -c 2 "$small"
}
padded 4 >padded.jpg
render padded --texture padded.jpg && differ whole padded
padded 100 >damaged.jpg
render none --texture damaged.jpg
mr-make torus -n 300 | mr-render --texture away/torus.png none.png
echo "exit $?"
mr-make torus -n 300 | mr-render --materials away none.png
echo "exit $?"
mr-render -i card.mrs --texture away/torus.png --materials away none.png
echo "exit $?"
ls none.png 2>/dev/null

echo '-- of the picture all frames but the first have the texture from before'
mr-cat card.mrs card.mrs | mr-render -s 40x40 --texture away/torus.png 'card-%d.png' && differ card-1 card-2

echo '-- pictures that announce more than their bytes can hold'
python3 - <<'END'
import struct, zlib
chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
open("huge.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 32767, 32767, 8, 2, 0, 0, 0)) +
                             chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b""))
parts = b"\1\x11\0\2\x11\0\3\x11\0"
open("huge.jpg", "wb").write(b"\xff\xd8\xff\xc0" + struct.pack(">HBHHB", 17, 8, 30000, 30000, 3) + parts +
                             b"\xff\xda" + struct.pack(">HB", 12, 3) + b"\1\0\2\0\3\0\0\x3f\0" + bytes(1000))
END
mr-make sphere -n 60 --texcoords -o ball.mrs
for picture in huge.png huge.jpg; do
	mr-render --texture $picture --size 32x32 out.png <ball.mrs
	echo "exit $?"
done

echo '-- 16 bits are as bright as 8'
python3 - <<'END'
import struct, zlib
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
for depth in 8, 16:
    open("gray%d.png" % depth, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, depth, 0, 0, 0, 0)) +
        chunk(b"IDAT", zlib.compress(b"\0" + b"\x9c" * (depth // 8))) + chunk(b"IEND", b""))
END
render eight --texture gray8.png && render sixteen --texture gray16.png && differ eight sixteen

echo '-- statements that are no numbers, and numbers that are no shares'
printf 'newmtl front\nKd red green blue\nKd 1,0,0\nd nan\nnewmtl back\nKd 2 0 -1\nd 2\n' >card.mtl
render odd --materials .
