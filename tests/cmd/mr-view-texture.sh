# Pictures on the surfaces of a page: where they are stored, what tells of them, and what is no picture.
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
usemtl neither
f 1/1 4/4 3/3
END
printf 'newmtl front\nKd 1 0 0\nmap_Kd torus.png\nnewmtl back\nKd 0 1 0.5\n' >card.mtl
mr-import -q card.obj -o card.mrs
mr-make torus -n 500 | mr-render -s 64x48 --no-labels torus.png
stored() { # page: its pictures, and what its data say
	python3 - "$1" <<'Y'
import base64, re, subprocess, sys
page = open(sys.argv[1], encoding="utf-8").read()
blocks = lambda name: [base64.b64decode(b, validate=True) for b in re.findall('<script type="text/plain" class="%s">([A-Za-z0-9+/=]*)</script>\n' % name, page)]
print("pictures: %d" % len(blocks("picture")), *(kind.decode() for b in blocks("picture") for kind in (b"IHDR", b"tEXt", b"Exif", b"home") if kind in b))
data = subprocess.run(["mr-cat", "-u"], input=b"".join(blocks("stream")), stdout=subprocess.PIPE, check=True).stdout
print("\n".join(sorted(set(re.findall("(?m)^(?:texture|material|same|steps) .*(?:texcoord|texture|material).*|^(?:texture|material) .*", data.replace(b"\0", b"\n").decode("latin-1"))))))
Y
}
echo '-- one for all'
mr-view --texture torus.png -i card.mrs card.html && stored card.html
echo '-- those of materials, and their colours'
mr-view --materials . -i card.mrs card.html && stored card.html
mr-view --materials . two.html card.mrs card.mrs && stored two.html | sed -n 1p
echo '-- without them the page is as it was'
mr-view -i card.mrs plain.html && stored plain.html
echo '-- the same bytes by any number of threads'
mr-view -j 1 --texture torus.png -i card.mrs a.html && mr-view -j 3 --texture torus.png -i card.mrs b.html && cmp a.html b.html && echo same
echo '-- what is said in a picture about it stays outside'
python3 - <<'Y'
import struct, zlib
data = open("torus.png", "rb").read()
chunk = lambda kind, text: struct.pack(">I", len(text)) + kind + text + struct.pack(">I", zlib.crc32(kind + text))
open("said.png", "wb").write(data[:33] + chunk(b"tEXt", b"Comment\0home") + data[33:])
Y
mr-view --texture said.png -i card.mrs said.html && stored said.html | sed -n 1p && mr-view --texture torus.png -i card.mrs card.html && cmp said.html card.html && echo same

echo '-- the places of corners'
mr-make sphere -n 400 --texcoords -o ball.mrs && mr-view --texture torus.png -i ball.mrs ball.html && stored ball.html
echo '-- a frame without texture coordinates beside one that has them'
mr-make torus -n 300 -o bare.mrs && mr-view --texture torus.png both.html bare.mrs card.mrs && stored both.html | sed -n 1p

echo '-- what is not there, or no picture: no page'
fails() {
	mr-view "$@" none.html </dev/null
	echo "exit $?"
}
fails -i card.mrs --texture nothing.png
echo 'no picture' >text.png
fails -i card.mrs --texture text.png
head -c 60 torus.png >cut.png
fails -i card.mrs --texture cut.png
printf '\377\330\377\340 no picture' >cut.jpg
fails -i card.mrs --texture cut.jpg
fails -i bare.mrs --texture torus.png
fails -i bare.mrs --materials .
fails -i card.mrs --texture torus.png --materials .
ls none.html 2>/dev/null
rm torus.png && mr-view --materials . -i card.mrs card.html && stored card.html
cp text.png torus.png && mr-view --materials . -i card.mrs card.html && stored card.html
mkdir away && mr-view --materials away -i card.mrs card.html; stored card.html

echo '-- one that is too large for graphics cards'
mr-make torus -n 300 | mr-render -s 8193x16 --no-labels wide.png
mr-view --texture wide.png -i card.mrs wide.html && stored wide.html | sed -n 1p
