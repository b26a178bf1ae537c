# Maps of heights and normals: what is written, what is read, and what is refused.
texts() { # PNG: what its texts say
	python3 - "$1" <<'END'
import struct, sys
data, at = open(sys.argv[1], 'rb').read(), 8
while at < len(data):
    size, kind = struct.unpack('>I4s', data[at:at + 8])
    if kind == b'IHDR':
        print('IHDR', *struct.unpack('>IIBB', data[at + 8:at + 18]))
    if kind == b'tEXt':
        print(data[at + 8:at + 8 + size].decode().replace('\0', ': '))
    at += 12 + size
END
}
figures() {
	sed 's/.*"level"/"level"/; s/}$//; s/"//g' "$@"
}
# A pyramid whose heights are easy: control of 5 vertices, the base open.
cat >control.off <<'END'
OFF
5 4 0
-1 -1 0
1 -1 0
1 1 0
-1 1 0
0 0 1
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
END
mr-make plane -n 400 | mr-export -f off - | mr-import -l mesh -o plane.mrs
mr-import -l control control.off | mr-cat --merge - plane.mrs | mr-sample -q -n 2 -o scan.mrs

echo '-- written'
mr-map -w maps/pyramid scan.mrs >/dev/null
echo "exit $?"
mkdir maps
mr-map -w maps/pyramid --stats stats scan.mrs -o mapped.mrs
figures stats | sed 's/,low.*high:[^,]*//'
ls maps
cat maps/pyramid.mtl | sed 's/-mm.* /-mm ... /'
texts maps/pyramid-height.png | sed 's/range: .*/range: .../'
texts maps/pyramid-normal.png
mr-info mapped.mrs | sed -n '/control:/,$p' | grep -E 'control|displ|normal|texcoord|material|mtllib|height|level|range'
mr-export -l control maps/pyramid.obj <mapped.mrs
grep -E '^(mtllib|usemtl|vt)' maps/pyramid.obj | head -n 5
mr-export -l control --materials maps maps/pyramid.glb <mapped.mrs
mr-import maps/pyramid.glb 2>&1 >/dev/null

echo '-- read'
mr-import -l control maps/pyramid.obj | mr-map -r maps/pyramid-height.png --stats stats -o back.mrs
figures stats | sed 's/,low.*high:[^,]*//'
mr-decode scan.mrs -o a.mrs && mr-decode back.mrs | mr-compare -a mesh -b mesh --json a.mrs |
    grep -o '"vertex_max_relative":[0-9.]*e-0[6-9]' | cut -c1-22

echo '-- a range, a level, a gutter'
mr-map -w ranged --range=-2,2 --gutter 1 scan.mrs --stats stats -o ranged.mrs
figures stats
mr-map -w cut --range=-0.1,0.1 --level 1 scan.mrs -o cut.mrs
mr-map -w '%s-%d' scan.mrs -o named.mrs && ls *-1-*
python3 - <<'END' # the same without its texts
import struct
data, at, out = open('ranged-height.png', 'rb').read(), 8, b'\x89PNG\r\n\x1a\n'
while at < len(data):
    size, kind = struct.unpack('>I4s', data[at:at + 8])
    if kind != b'tEXt':
        out += data[at:at + 12 + size]
    at += 12 + size
open('bare.png', 'wb').write(out)
END
mr-map -r ranged-height.png ranged.mrs --no-history -o a.mrs
mr-map -r bare.png --range=-2,2 -n 2 ranged.mrs --no-history | cmp - a.mrs && echo 'the same without texts'
mr-map -r bare.png --range=-2,2 -n 1 ranged.mrs | mr-info | grep 'height  '
mr-map -r bare.png --range=-2,2 -n 3 ranged.mrs >/dev/null # warns: between texels

echo '-- equalizing makes the range another'
mr-equalize --gain 2 mapped.mrs | mr-info | grep -c 'range  '

echo '-- refusals'
refused() {
	rm -f no-*
	mr-map "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
	ls no-* 2>/dev/null
}
refused scan.mrs
refused -w no -r no-height.png scan.mrs
refused -r bare.png --size 9 scan.mrs
refused -r bare.png --gutter 9 scan.mrs
refused -w no --gutter 0 scan.mrs
refused -w no --range 2,1 scan.mrs
refused -w no%x scan.mrs
refused -w '' scan.mrs
refused -w maps/ scan.mrs
refused -w "$(printf 'no\nno')" scan.mrs
refused -w no --level 3 scan.mrs
refused -w no --size 20 scan.mrs
refused -w no --size 9 scan.mrs
refused -w no plane.mrs
refused -r bare.png ranged.mrs
refused -r bare.png -n 2 ranged.mrs
refused -r absent.png ranged.mrs
refused -r maps/pyramid-height.png scan.mrs
refused -r maps/pyramid-normal.png mapped.mrs
refused -r maps/pyramid.obj mapped.mrs
for bytes in 0 7 30 60 200 $(($(wc -c <ranged-height.png) - 13)) $(($(wc -c <ranged-height.png) - 1)); do
	head -c "$bytes" ranged-height.png >short.png
	refused -r short.png ranged.mrs
done
python3 - <<'END' # damaged: pictures by hand
import struct, zlib
def chunk(kind, body):
    return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
def png(name, width, height, depth, color, texts=(), rows=None, slope=0):
    row = b'\0' + bytes(k % slope if slope else 0 for k in range(width * depth // 8 * (3 if color == 2 else 1)))
    open(name, 'wb').write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, depth, color, 0, 0, 0)) +
        b''.join(chunk(b'tEXt', t.encode()) for t in texts) +
        chunk(b'IDAT', zlib.compress(row * (height if rows is None else rows))) + chunk(b'IEND', b''))
good = ['Height level\0002', 'Height range\000-1 1', 'Height size\00030 30']
png('bytes.png', 30, 30, 8, 0, good)
png('colors.png', 30, 30, 16, 2, good)
png('resized.png', 15, 15, 16, 0, good)
png('few.png', 30, 30, 16, 0, good, 7)
png('huge.png', 40000, 1, 16, 0, good)
png('level.png', 30, 30, 16, 0, ['Height level\00016'] + good[1:])
png('fraction.png', 30, 30, 16, 0, ['Height level\0001.5'] + good[1:])
png('word.png', 30, 30, 16, 0, ['Height level\000two'] + good[1:])
png('reversed.png', 30, 30, 16, 0, good[:1] + ['Height range\0001 -1'] + good[2:])
png('nan.png', 30, 30, 16, 0, good[:1] + ['Height range\000nan 1'] + good[2:])
png('half.png', 30, 30, 16, 0, good[:1] + ['Height range\0001'] + good[2:])
png('slope.png', 30, 30, 16, 0, good, slope=60)
END
for picture in bytes colors resized few huge level fraction word reversed nan half; do
	refused -r $picture.png ranged.mrs
done
mr-map -r slope.png ranged.mrs -o out.mrs && echo 'seams are told'
mr-cat scan.mrs scan.mrs -o two.mrs
mr-map -w no two.mrs -o out.mrs
echo "exit $?"

echo "-- control's own texture coordinates"
mr-make sphere -n 60 --texcoords | mr-export own.obj
mr-import -l control own.obj -o own.mrs
mr-make sphere -n 900 | mr-cat --merge - own.mrs | mr-sample -q -n 1 | mr-map -w own | mr-equalize -g 1 | mr-map -w again | mr-info | grep texcoord

echo "-- a file of the model's own materials is not written over"
{ echo 'mtllib keep.mtl' && cat own.obj; } >kept.obj
echo 'newmtl own' >keep.mtl
mr-make sphere -n 900 | mr-export body.obj
mr-import -q -l control kept.obj -o kept.mrs
mr-import body.obj | mr-cat --merge - kept.mrs | mr-sample -q -n 1 -o kept-scan.mrs
refused -w keep kept-scan.mrs
cat keep.mtl
echo '-- nor is any that no map is of; its own is'
echo notes >notes.mtl
refused -w notes scan.mrs
cat notes.mtl
mr-map -w twice scan.mrs -o out.mrs && mr-map -w twice scan.mrs -o out.mrs && echo twice
echo '-- each frame of several streams has its number'
mr-map -w several-%d scan.mrs scan.mrs -o out.mrs && ls several-*
echo '-- no picture holds what is infinitely far apart'
refused -w no --range=-1e308,1e308 scan.mrs
echo '-- columns of the displacement go to a coarser level, not to a finer one'
mr-make sphere -n 500 | mr-export -f obj - | awk '/^v / { print $2, $3, $4, int(127 + 100 * $2), 127, 127 }' >colors.xyz
mr-import colors.xyz | mr-shrinkwrap -q | mr-simplify -q -n 60 | mr-fit -q | mr-sample -q -n 2 | mr-map -w colors -n 2 -o colors.mrs
for n in 1 2 3; do
	mr-map -r colors-height.png -n $n colors.mrs 2>said -o out.mrs && mr-info --check out.mrs | sed -n '/^  displacement/,/^  [a-z]*:/p' | grep -c 'color  '
	grep -o 'lost: .*' said || true
done
