# What points have besides their places comes out on the mesh: colours, numbers, labels; of levels, edits, streams without points.
awk 'BEGIN { # points of a bumpy sphere; red, green and intensity are linear in place, the label tells its halves
	n = 6000
	print "ply\nformat ascii 1.0\nelement vertex " n + 2
	for (k = 1; k <= split("double x,double y,double z,uchar red,uchar green,uchar blue,float intensity,ushort label,float height,int side", p, ","); k++)
		print "property " p[k]
	print "end_header"
	for (i = 0; i < n; i++) {
		z = 1 - (2 * i + 1) / n; r = sqrt(1 - z * z); a = 2.399963229728653 * i; s = 1 + 0.1 * sin(4 * z)
		put(s * r * cos(a), s * r * sin(a), s * z, i % 100 ? s * r * cos(a) + 2 * s * z : "nan", z > 0)
	}
	put(9, 9, 9, 1000, 7) # an outlier, and a point that repeats the place of another
	put(s * r * cos(a), s * r * sin(a), s * z, 1000, 7)
}
function put(x, y, z, intensity, label) {
	print x, y, z, int(127.5 + 100 * x), int(127.5 + 100 * z), 255, intensity, 300 + label, 1, (label > 1 ? 7 : 5 - 10 * label)
}' >scan.ply
mr-import scan.ply | mr-shrinkwrap -q | mr-simplify | mr-fit -q | mr-sample -o sampled.mrs || exit
mr-info sampled.mrs | sed -n '/^  displacement/,$p'

judge() { # stream: greatest errors of its mesh, in spacings, which are 0.045
	mr-export -f ply - <"$1" >out.ply || return
	python3 - out.ply <<'END'
import re, struct, sys
data = open(sys.argv[1], 'rb').read()
at = data.index(b'end_header\n') + 11
head = data[:at].decode().split('element face')[0]
names = re.findall(r'property (\w+) (\w+)', head)
row = struct.Struct('<' + ''.join({'double': 'd', 'float': 'f', 'uchar': 'B', 'ushort': 'H', 'int': 'i', 'uint': 'I'}[t] for t, _ in names))
n = int(re.search(r'vertex (\d+)', head).group(1))
print(' '.join(name for _, name in names))
near, color, labels = 0, 0, 0
for i in range(n):
    v = dict(zip((name for _, name in names), row.unpack_from(data, at + i * row.size)))
    near = max(near, abs(v['intensity'] - v['x'] - 2 * v['z']) / 5 ** 0.5)
    color = max(color, abs(v['red'] - 127 - 100 * v['x']) / 100, abs(v['green'] - 127 - 100 * v['z']) / 100)
    labels += abs(v['z']) > 0.06 and v['label'] != 300 + (v['z'] > 0)
    labels += abs(v['z']) > 0.06 and v['side'] != 5 - 10 * (v['z'] > 0)
    labels += v['blue'] != 255 or v['alpha'] != 255
print(n, 'vertices: intensity', 'near' if near < 0.045 else near, 'color', 'near' if color < 0.05 else color, 'labels wrong', labels)
END
}
mr-decode sampled.mrs -o mesh.mrs && judge mesh.mrs
mr-decode --level 2 sampled.mrs -o coarse.mrs && judge coarse.mrs

without() { # stream, pattern of LAYER.COLUMN: the stream without those
	python3 - "$@" <<'END'
import re, records, sys
def kept(layer, name, *rest):
    return None if re.fullmatch(sys.argv[2], (layer + b'.' + name).decode()) else (layer, name, *rest)
sys.stdout.buffer.write(records.changed(open(sys.argv[1], 'rb').read(), kept))
END
}
echo 'without points, and onto a mesh that has them already: nothing is lost, so there is no warning'
without sampled.mrs 'points.*' | mr-decode | mr-decode -o again.mrs
mr-export mesh.ply <mesh.mrs
mr-export again.ply <again.mrs
cmp mesh.ply again.ply && echo same
for format in obj glb; do
	mr-export mesh.$format <mesh.mrs
	mr-import mesh.$format | mr-info -l mesh | grep color
done

echo 'a pose keeps them, and deltas do not send them again'
mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 sampled.mrs | mr-solve -q --basis |
	mr-pose --rotate 1,0,0,40 --frames 3 | mr-decode -o film.mrs

python3 - film.mrs <<'END'
import records, sys
sent = []
for layer, name, *_ in records.read(open(sys.argv[1], 'rb').read()):
    layer, name = layer.decode(), name.decode()
    sent = [] if name == 'FRAME' else sent + [layer + '.' + name] if layer == 'mesh' else sent
    if name == 'ENDFRAME':
        print(*sent)
END

echo 'sampled anew without them they are gone; the same bytes for any number of threads'
without sampled.mrs 'points.(color|intensity|label|height|side)' | mr-sample -q | mr-info | sed -n '/^  displacement/,$p'
mr-sample --no-history -q -j 1 sampled.mrs -o one.mrs
mr-sample --no-history -q -j 3 sampled.mrs | cmp - one.mrs && echo same

echo 'what all points share comes out exactly'
mr-make sphere --points 2000 | mr-export -f xyz - | awk 'BEGIN { print "ply\nformat ascii 1.0\nelement vertex 2000"
	for (k = 1; k <= split("double x,double y,double z,double depth", p, ","); k++) print "property " p[k]
	print "end_header" } { print $1, $2, $3, 0.1 }' >same.ply
mr-import -q same.ply | mr-shrinkwrap -q | mr-simplify -q -n 100 | mr-sample -q | mr-decode | mr-export -q -f ply-ascii - |
	awk 'body && NF == 4 && $0 !~ /^3 / { print $4 } /end_header/ { body = 1 }' | sort | uniq -c | wc -l

echo 'columns that do not fit'
python3 - sampled.mrs >short.mrs <<'END' # labels for half of the vertices
import records, sys
def half(layer, name, shape, rows, data):
    if (layer, name) == (b'displacement', b'label'):
        rows //= 2
        data = data[:4 * rows]
    return layer, name, shape, rows, data
sys.stdout.buffer.write(records.changed(open(sys.argv[1], 'rb').read(), half))
END
mr-decode short.mrs -o out.mrs
echo "exit $?"
echo a dark point among a hundred leaves no spot:
mr-make sphere --points 4000 | mr-export -q -l points -f xyz - | awk '
	BEGIN { print "ply\nformat ascii 1.0\nelement vertex 4000\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header" }
	!/#/ { print $1, $2, $3, NR % 100 ? int(200 + 50 * $1) " 150 120" : "0 0 0" }' >spots.ply
mr-import --points spots.ply | mr-shrinkwrap -q | mr-simplify -q | mr-fit -q | mr-sample -q | mr-decode | mr-export -q -l mesh -f off - |
	awk 'NF == 7 && ($4 < 140 || $5 < 140) { n++ } END { print n + 0 }'
