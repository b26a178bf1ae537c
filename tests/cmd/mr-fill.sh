# Holes are filled: what was there stays, columns go on, options choose loops, what cannot be filled stays open.
figures() {
	mr-fill --stats stats.json "$@" >out.mrs
	echo "$*: $(sed 's/.*\("loops".*\)}/\1/' stats.json | tr -d '"')"
}
topology() { mr-info "$@" | sed -n 's/^    topology *//p'; }

echo 'a ball without its cap'
mr-make sphere -n 3000 -o ball.mrs
mr-crop --drop above:y,0.9 ball.mrs -o open.mrs
figures open.mrs
topology out.mrs
mr-export -f off - <open.mrs | sed 1,2d >before
mr-export -f off - <out.mrs | sed 1,2d >after
grep -vxFf after before | wc -l
mr-compare --json -a mesh -i out.mrs ball.mrs | grep -o '"both":{[^}]*}' | tr ',' '\n' | sed -n 's/.*"max":\([0-9.]*\).*/\1/p' |
	awk '{ print ($1 < 0.02 ? "near the ball" : "far: " $1) }'
mr-fill ball.mrs | cmp ball.mrs - >diff; mr-fill --no-history ball.mrs | cmp ball.mrs - && echo 'closed: as it was'

echo 'loops: the rim of an open surface stays, options choose'
mr-crop --drop above:y,0.9+above:x,0.5 --drop below:z,0.05 ball.mrs -o holes.mrs
for o in '' '--loops 1' '--max-length 80%' '--max-length 1e-3' '-k 1' '-k 3'; do
	figures $o holes.mrs
	topology out.mrs
done
mr-make sphere -n 1000 | mr-crop --keep above:y,0.6 -o dome.mrs
figures dome.mrs
figures --loops 1 dome.mrs
topology out.mrs

echo 'loops that touch at a vertex'
awk 'BEGIN {
	for (i = 0; i < 36; i++) print "v", i % 6, int(i / 6), 0
	for (i = 0; i < 30; i++) if (i % 6 < 5 && i != 14 && i != 21) print "f", i + 1, i + 2, i + 8, i + 7
}' >touch.obj
mr-import touch.obj | mr-fill --stats stats.json | mr-info | grep topology
echo 'and by two vertices at one place'
sed -e '$a v 3 3 0' -e 's/^f 21 22 28 27$/f 21 37 28 27/' touch.obj >twice.obj
mr-import twice.obj | mr-info | grep topology
mr-import twice.obj | mr-fill --stats stats.json | mr-info | grep topology

echo 'colours go on, labels are those around, polygons stay'
cat >cube.obj <<'OBJ'
usemtl red
v 0 0 0 1 0 0
v 1 0 0 1 0 0
v 1 1 0 1 0 0
v 0 1 0 1 0 0
v 0 0 1 0 0 1
v 1 0 1 0 0 1
v 1 1 1 0 0 1
v 0 1 1 0 0 1
f 4 3 2 1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
mr-import cube.obj | mr-fill --loops 1 | mr-export -f obj - | grep -v '^#'
mr-import cube.obj | mr-subdivide --longest 0.2 | mr-fill --loops 1 | mr-export -q -f ply-ascii - |
	sed -n '/end_header/,$p' | awk 'NF > 5 && $3 > 1 { print $4, $5, $6 }' | sort | uniq -c | awk '{ print $2, $3, $4 }'

echo 'texture coordinates of corners go on where no seam crosses the rim; normals are there'
mr-make sphere -n 2000 --texcoords | mr-normals -o textured.mrs
for x in -1 1; do
	mr-crop --drop sphere:$x,0,0,0.3 textured.mrs | mr-fill -o out.mrs && mr-info --check out.mrs >info
	mr-export -q -f obj - <out.mrs | awk -v x=$x '/^f/ { n++; with += /\/[0-9]+\// } END { print x ": " n - with " without" }'
done
mr-export -q -f obj - <out.mrs | awk '/^vn/ && ($2 ^ 2 + $3 ^ 2 + $4 ^ 2 - 1) ^ 2 > 1e-12 { bad++ } END { print bad + 0 " bad normals" }'

echo 'a piece that lies in a hole is joined to it, with colours; turned over it is left alone'
mr-make plane -n 800 | mr-export -f obj - | awk '/^v / { print $1, $2, $3, $4, ($2 + 1) / 2, 0.5, 0; next } { print }' >plane.obj
mr-import -q plane.obj -o plane.mrs
mr-crop --drop sphere:0,0,0,0.4 plane.mrs -o around.mrs
mr-crop --keep sphere:0,0,0,0.2 plane.mrs -o island.mrs
mr-export -q -f obj - <island.mrs | awk '/^f/ { print $1, $2, $4, $3; next } { print }' >over.obj
mr-import over.obj | mr-cat --append around.mrs - -o over.mrs
mr-cat --append around.mrs island.mrs -o both.mrs
for o in over.mrs both.mrs '--loops 1 both.mrs'; do
	figures $o 2>&1
	topology out.mrs
done
mr-export -f off - <both.mrs | sed 1,2d >before
mr-export -f off - <out.mrs | sed 1,2d >after
grep -vxFf after before | wc -l
mr-export -q -f obj - <out.mrs | awk '/^v / { d = $5 - ($2 + 1) / 2; n++; bad += d > 0.01 || d < -0.01 || $4 != 0 } END { print bad + 0 " vertices are off" }'

echo 'a filling that would cross the surface'
cat >crossing.off <<'END'
OFF
7 5 0
0 0 1
1 -1 0
1 1 0
-1 0 0
0.2 0.1 -1
0.2 -0.1 2
0.3 0 0.5
3 0 1 2
3 0 2 3
3 0 3 1
3 4 5 6
3 6 5 4
END
mr-import -q crossing.off | mr-fill --loops 1 --stats stats.json 2>err >out.mrs
sed 's/.*\("loops".*\)}/\1/' stats.json | tr -d '"'
cat err

echo 'a cube without a side, in one piece and with vertices for each face; a small rim with long teeth'
mr-import cube.obj | mr-fill | mr-info | grep topology
awk '/^v/ { v[++n] = $2 " " $3 " " $4 } /^f/ { for (i = 2; i < 6; i++) print "v", v[$i]; print "f -4 -3 -2 -1" }' cube.obj >apart.obj
mr-import apart.obj | mr-fill | mr-info | grep topology
awk 'BEGIN {
	for (i = 0; i < 80; i++) print "v", (i % 2 ? 1.9 : 1) * cos(i * 0.0785398), (i % 2 ? 1.9 : 1) * sin(i * 0.0785398), 0
	for (i = 0; i < 80; i++) print "v", 2 * cos(i * 0.0785398), 2 * sin(i * 0.0785398), -0.1
	print "v 0 0 -0.8"
	for (i = 1; i <= 80; i++) {
		j = i % 80 + 1
		print "f", i + 80, j + 80, j, i "\nf", j + 80, i + 80, 161
	}
}' >teeth.obj
mr-import teeth.obj | mr-fill --stats stats.json | mr-info | grep topology
