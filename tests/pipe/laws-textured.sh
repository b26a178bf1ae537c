# A textured model that was bent comes back: every corner has its texture coordinates and its material, every face its
# corners; only positions and normals differ, and normals turned with the surface.
fail=0
bad() {
	echo "$*"
	fail=1
}
# The corners with their texture coordinates' values, materials and objects; normals are left out.
corners() {
	awk '$1 == "vt" { uv[++n] = $2 " " $3 }
	$1 == "usemtl" || $1 == "o" || $1 == "g" || $1 == "s" || $1 == "mtllib" { print }
	$1 == "f" { line = "f"
		for (i = 2; i <= NF; i++) { split($i, c, "/"); line = line " " c[1] "(" (c[2] == "" ? "" : uv[c[2]]) ")" }
		print line }' "$1"
}
bend() { # model, tool before the edit
	mr-import --repair "$1" >whole.mrs 2>said || return
	grep -v 'has its materials in' said
	$2 whole.mrs >mesh.mrs && mr-smooth mesh.mrs | mr-remesh | mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 |
	    mr-encode | mr-pose -H 0 --rotate 0,1,0,30 | mr-solve | mr-decode >bent.mrs && mr-export -i mesh.mrs rest.obj 2>said &&
	    mr-export -i bent.mrs bent.obj 2>said || return
	corners rest.obj >rest && corners bent.obj | cmp - rest || bad "$1: corners differ"
	cmp -s rest.obj bent.obj && bad "$1 did not bend"
	mr-import bent.obj 2>/dev/null | mr-export again.obj 2>/dev/null
	corners bent.obj >rest && corners again.obj | cmp - rest && grep '^v ' bent.obj >rest && grep '^v ' again.obj | cmp - rest ||
	    bad "$1: read back, it differs"
}

# A box of quads with a seam at each edge, a crease at each, a material a side.
awk 'BEGIN {
	n = 12
	for (k = 0; k <= n; k++) for (j = 0; j <= n; j++) for (i = 0; i <= n; i++)
		if (i % n == 0 || j % n == 0 || k % n == 0) {
			print "v", i * 3 / n, j / n, k / n
			at[i, j, k] = ++v
		}
	print "mtllib box.mtl\no box"
	for (a = 0; a < 3; a++) for (s = 0; s < 2; s++) {
		print "vn", (a == 0) * (2 * s - 1), (a == 1) * (2 * s - 1), (a == 2) * (2 * s - 1)
		for (q = 0; q <= n; q++) for (p = 0; p <= n; p++) print "vt", a + p / (n + 1), s + q / (n + 1)
	}
	for (a = 0; a < 3; a++) for (s = 0; s < 2; s++) {
		print "usemtl side" a s "\ns " side + 1
		for (q = 0; q < n; q++) for (p = 0; p < n; p++) {
			line = "f"
			for (c = 0; c < 4; c++) {
				x = p + (s ? c == 1 || c == 2 : c == 2 || c == 3)
				y = q + (s ? c == 2 || c == 3 : c == 1 || c == 2)
				w[a] = s * n; w[(a + 1) % 3] = x; w[(a + 2) % 3] = y
				line = line " " at[w[0], w[1], w[2]] "/" side * (n + 1) * (n + 1) + y * (n + 1) + x + 1 "/" side + 1
			}
			print line
		}
		side++
	}
}' >box.obj
touch box.mtl
bend box.obj mr-cat
[ "$(grep -c '^f [^ ]* [^ ]* [^ ]* [^ ]*$' bent.obj)" -eq 864 ] || bad 'not all quads came back'
# PLY has no names of materials and objects.
mr-export -q -i bent.mrs bent.ply && mr-import bent.ply | mr-export again.obj && corners again.obj >again &&
    corners bent.obj | grep '^f' | cmp - again || bad 'PLY differs'
# The sides that do not bend have their normals; at the other end all are turned by 30 degrees.
mr-info bent.mrs | grep -q 'corner_normal  *f d9' || bad 'the normals are gone'
awk '$1 == "vn" { if ($2 > 0.8660 && $2 < 0.8661 && $4 < -0.4999 && $4 > -0.5001) turned++; if ($2 == -1) rest++ }
	END { exit !(turned && rest) }' bent.obj || bad 'the normals do not turn'

# The same where long edges are divided before: what the corners have goes along.
bend box.obj 'mr-subdivide --longest 0.1'
awk '$1 == "usemtl" { n[$2] = 1 } $1 == "f" && $0 !~ /\/.*\/.*\/.*\/.*\/.*\// { bad++ } END { for (m in n) k++; exit k != 6 || bad }' \
    bent.obj || bad 'a corner lost its texture coordinates, or a side its material'

# Real ones.
for name in spot.obj.gz beetle-alt.obj.gz truck.obj fuze.obj spider.obj pirate.obj.gz camel_b.obj; do
	file=$DATA/meshes/$name
	[ ! -e "$file" ] || bend "$file" mr-cat || bad "$name is not bent: $(cat said)"
done
exit $fail
