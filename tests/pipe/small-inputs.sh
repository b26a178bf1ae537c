# Small inputs on which tools of this kind go wrong: numbers of the result, and what is said.
fails() { echo "$*"; exit 1; }
is() { # what, JSON of mr-info, then members and values
	what=$1 json=$(mr-info --json "$2" 2>/dev/null) || fails "$what"
	shift 2
	for pair; do
		got=$(echo "$json" | grep -o "\"${pair%=*}\":[^,}]*" | tail -n 1 | cut -d: -f2)
		test "$got" = "${pair#*=}" || awk -v a="$got" -v b="${pair#*=}" 'BEGIN { exit !(a != "" && (a - b) ^ 2 <= 1e-12 * (1 + b * b)) }' ||
			fails "$what: $pair: $got"
	done
}
silent() { # what, file: a line for standard error that none may be like
	! grep -q "${3:-.}" "$2" || fails "$1: $(cat "$2")"
}

# A weight is no colour, coordinates that no corner uses are no loss, indices count back from where they stand.
awk 'BEGIN { for (i = 0; i < 8; i++) print "v", i % 2, int(i / 2) % 2, int(i / 4), 1.0
	split("1 3 4 2,5 6 8 7,1 2 6 5,3 7 8 4,1 5 7 3,2 4 8 6", f, ","); for (i = 1; i <= 6; i++) print "f", f[i] }' >cube.obj
mr-import cube.obj 2>said | mr-export cube.stl 2>>said && silent 'a cube of quads' said
mr-import cube.obj | mr-export -f ply-ascii - 2>>said | grep -q red && fails 'a weight is a colour'
mr-import cube.obj -o cube.mrs && is cube cube.mrs vertices=8 volume=1 boundary_loops=0
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 9 9\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/3 3/4 4/5\n' >square.obj
mr-import square.obj 2>said | mr-export square-out.obj 2>>said && silent 'unused vt' said
grep -c '^vt' square-out.obj | grep -qx 4 || fails 'unused vt'
for i in 0 1 2; do printf "o o$i\nv $i 0 0\nv $i.5 0 0\nv $i 1 0\nv $i 0 1\nf -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n"; done >three.obj
mr-import three.obj -o three.mrs && is 'counted back' three.mrs vertices=12 faces=12 components=3 boundary_loops=0 volume=0.25

# Properties of PLY in any order, before their list, blue first; strips of triangles, their highest byte first.
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar blue\nproperty uchar green\nproperty uchar red\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty int material_index\nproperty list uchar int vertex_indices\nend_header\n200 201 202 0 0 0\n200 201 202 1 0 0\n200 201 202 0 1 0\n7 3 0 1 2\n' >order.ply
mr-import order.ply | mr-export -f ply-ascii - >out.ply
grep -q ' 202 201 200' out.ply && grep -q '^3 0 1 2 7$' out.ply || fails "order of properties: $(cat out.ply)"
python3 - <<'PY'
import struct
w, h = 5, 4
with open("strips.ply", "wb") as file:
    file.write(b"ply\nformat binary_big_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
               b"element tristrips 1\nproperty list int int vertex_indices\nend_header\n" % (w * h))
    for i in range(w * h):
        file.write(struct.pack(">3f", i % w, i // w, 0))
    strip = [k for y in range(h - 1) for k in [*(v for x in range(w) for v in (y * w + w + x, y * w + x)), -1]]
    file.write(struct.pack(">%di" % (len(strip) + 1), len(strip), *strip))
PY
mr-import strips.ply -o strips.mrs && is strips strips.mrs vertices=20 faces=24 boundary_loops=1 area=12 oriented=true

# Cubes that share an edge, and a corner, are parted.
awk 'function corner(k) { return x + k % 2 " " y + int(k / 2) % 2 " " z + int(k / 4) }
	BEGIN { split("0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5", q, " "); print "solid"
	for (c = 0; c < 3; c++) { x = c; y = c; z = c == 2 ? 1 : 0
		for (f = 0; f < 6; f++) for (h = 0; h < 2; h++) { print "facet normal 0 0 0\nouter loop"
			for (i = 0; i < 3; i++) print "vertex", corner(q[4 * f + 1 + (i ? i + h : 0)]); print "endloop\nendfacet" } }
	print "endsolid" }' >kiss.stl
mr-import -q --weld 0 --repair kiss.stl -o kiss.mrs && is kissing kiss.mrs components=3 volume=3 boundary_loops=0 nonmanifold_edges=0

# Triangles that touch, of vertices of their own, are all there.
awk 'BEGIN { for (i = 0; i < 6; i++) { for (k = i; k < i + 3; k++) print "v", int(k / 2), k % 2, 0
		print i % 2 ? "f -1 -2 -3" : "f -3 -2 -1" } }' >row.obj
for n in 1 2 4; do
	mr-import row.obj | mr-simplify -n $n -o row.mrs 2>said && silent "a row to $n" said gone && is "a row to $n" row.mrs area=3
done

# A dome in sectors, each with a tip of its own, is as near as with one.
awk 'BEGIN { p = 4 * atan2(1, 1)
	for (s = 0; s < 8; s++) { for (j = 1; j <= 4; j++) for (i = 0; i <= 2; i++) { a = (s + i / 2) * p / 4; b = j * p / 8; if (i < 2) at(a, b) } tip[s] = ++n; print "v 0 0 1" }
	for (s = 0; s < 8; s++) for (i = 0; i < 2; i++) { a = 8 * 0 + 9 * s + i; b = i ? 9 * ((s + 1) % 8) : a + 1
		print "f", tip[s], a + 1, b + 1
		for (j = 0; j < 3; j++) { print "f", a + 2 * j + 1, a + 2 * j + 3, b + 2 * j + 3; print "f", a + 2 * j + 1, b + 2 * j + 3, b + 2 * j + 1 } } }
	function at(a, b) { n++; printf "v %.9f %.9f %.9f\n", sin(b) * cos(a), sin(b) * sin(a), cos(b) }' >dome.obj
far() { mr-compare --json -a mesh -b mesh dome.mrs "$1" | sed 's/.*"both_relative":{[^}]*"max":\([^,}]*\).*/\1/'; }
mr-import dome.obj -o dome.mrs
mr-simplify -r 0.2 dome.mrs -o tips.mrs && mr-import -q --weld 1e-7 dome.obj | mr-simplify -r 0.2 -o tip.mrs
awk -v a="$(far tips.mrs)" -v b="$(far tip.mrs)" 'BEGIN { exit !(a <= 0.05 && a <= 1.5 * b) }' || fails "dome: $(far tips.mrs), $(far tip.mrs)"

# Tiles that keep their rims fit together; a plate with holes keeps them, a cube its edges.
awk 'BEGIN { for (t = 0; t < 2; t++) { f = t ? "right.obj" : "left.obj"
	for (j = 0; j <= 20; j++) for (i = 0; i <= 20; i++) { x = i / 4 + 5 * t; print "v", x, j / 4, sin(x) * cos(j / 4) / 2 >f }
	for (j = 0; j < 20; j++) for (i = 0; i < 20; i++) { a = 21 * j + i + 1; print "f", a, a + 1, a + 22 >f; print "f", a, a + 22, a + 21 >f } } }'
for side in left right; do
	mr-import $side.obj | mr-simplify --lock boundary -r 0.2 | mr-export $side-few.obj
	awk '$1 == "v" && $2 == 5' $side-few.obj | sort >$side.rim
	mr-info --json $side-few.obj | grep -q '"faces":160,' || fails "$side has not 160 faces"
done
awk '$1 == "v" && $2 == 5' left.obj | sort | cmp - left.rim && cmp left.rim right.rim && test "$(wc -l <left.rim)" = 21 || fails 'tiles'
mr-remesh -q -L 0.1 --feature auto cube.obj | mr-cat --no-history -o sharp.mrs
mr-info --json -l base sharp.mrs | grep -q '"euler":2,' || fails "cube remeshed"
mr-transform -s -1,1,1 cube.obj -o mirror.mrs && is mirror mirror.mrs volume=1

# Clouds: two sheets of two colours, a tunnel, normals of no length.
awk 'BEGIN { for (k = 0; k < 2; k++) { srand(k); for (i = 0; i < 1600; i++) print 4 * (i % 40 + rand()) / 40, 4 * (int(i / 40) + rand()) / 40, 0.6 * k, k ? "200 0 0" : "0 200 0" } }' >sheets.txt
{ echo 'x y z red green blue'; cat sheets.txt; } >sheets.xyz
whole() { mr-import --points "$1" | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample | mr-decode -o "$2"; }
whole sheets.xyz sheets.mrs 2>said && is sheets sheets.mrs components=2 boundary_loops=2
mr-export -q -f ply-ascii - <sheets.mrs | awk 'NF > 5 && ($3 < 0.3 ? $4 + 0 != 0 || $5 + 0 != 200 : $4 + 0 != 200 || $5 + 0 != 0) && $1 + 0 == $1 { bad++ } END { exit bad > 0 }' || fails 'colours of sheets'
awk 'BEGIN { srand(3); for (i = 0; i < 3000; i++) { a = 6.283185307 * rand(); print cos(a) / 2, sin(a) / 2, 4 * rand() } }' >tunnel.xyz
whole tunnel.xyz tunnel.mrs 2>said; is tunnel tunnel.mrs euler=0 boundary_loops=2
awk 'BEGIN { srand(4); for (i = 0; i < 1500; i++) { z = 2 * rand() - 1; a = 6.283185307 * rand(); r = sqrt(1 - z * z); print r * cos(a), r * sin(a), z, 0, 0, 0 } }' >ball.txt
{ printf 'ply\nformat ascii 1.0\nelement vertex 1500\n'; printf 'property float %s\n' x y z nx ny nz; echo end_header; cat ball.txt; } >ball.ply
whole ball.ply ball.mrs 2>said; is ball ball.mrs euler=2 boundary_loops=0
grep -q 'normals of the points have no length' said && test "$(wc -l <said)" = 1 || fails "normals: $(cat said)"
