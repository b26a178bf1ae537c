# Normals of points and surfaces, against those that are known.
agree() { # the figures, behind the pipe before
	mr-normals --stats stats.json "$@" -o out.mrs && sed 's/.*\("kept".*\)}/\1/' stats.json | tr -d '"'
}
echo 'bodies of points: their own normals are on the same side'
for shape in sphere torus cube knot 'boxes --genus 2' 'bumpy --noise 0.5%'; do
	echo "$shape $(mr-make $shape --points 6000 | agree | sed 's/agree:0\.99[0-9]*/nearly all/')"
done
echo "turned over $(mr-make torus --points 6000 | agree --flip)"
mr-make sphere --points 3000 >ball.mrs
mr-normals ball.mrs | mr-export -q - -f ply-ascii | awk 'body { r = sqrt($1^2 + $2^2 + $3^2)
	if (($1 * $4 + $2 * $5 + $3 * $6) / r < 0.99 || ($4^2 + $5^2 + $6^2 - 1)^2 > 1e-12) bad++; n++ }
	/end_header/ { body = 1 } END { print n, "unit normals,", bad + 0, "not along the radius" }'

echo 'a plane has one side, towards who looks'
mr-make plane --points 500 -o plane.mrs
sides() { # how many normals point up, and down
	mr-export -q - -f ply-ascii | awk 'body { if ($6 > 0.999) up++; if ($6 < -0.999) down++ } /end_header/ { body = 1 }
		END { print up + 0, down + 0 }'
}
mr-normals plane.mrs | sides | grep -E '^(500 0|0 500)$' >same && echo same
mr-normals --from 0,0,5 plane.mrs | sides
mr-normals --from 9,0,-1 plane.mrs | sides
mr-normals --from 0,0,5 --neighbours 7 --flip plane.mrs | sides
printf '3\n3\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 9 1\n' >grid.ptx
for i in 1 2 3; do printf "$i %s -9 0.5\n" 1 2 3 >>grid.ptx; done
mr-import -q grid.ptx | mr-normals | sides
mr-import -q grid.ptx | mr-normals --from 0,0,-9 | sides

echo 'kept where they fit: not zero, not a number, not along the plane, and telling the rest'
mr-crop --keep above:z,0.1 ball.mrs | mr-export - -f ply-ascii | awk '/end_header/ { body = 1; print; next } !body { print; next }
	{ n++; if (n % 4 == 1) print $1, $2, $3, -3 * $4, -3 * $5, -3 * $6
	else if (n % 4 == 2) print $1, $2, $3, 0, 0, 0
	else if (n % 4 == 3) print $1, $2, $3, $5, -$4, 0; else print $1, $2, $3, -$4, -$5, -$6 }' >some.ply
mr-import some.ply | agree --keep | sed 's/agree:.*/agree/'
mr-export -q - -f ply-ascii <out.mrs | awk 'body { n++; d = $1 * $4 + $2 * $5 + $3 * $6; if (d > 0) bad++; if (d < -2) long++ }
	/end_header/ { body = 1 } END { print n, bad + 0, "on the other side,", long, "as long as they were" }'

echo 'a part of which no direction tells is as without them; directions that contradict each other are told of'
outward() { # of two balls six apart: normals that point away from their own, of each
	mr-export -q - -f ply-ascii | awk 'body { k = $1 > 3; n[k]++; if (($1 - 6 * k) * $4 + $2 * $5 + $3 * $6 > 0) out[k]++ }
		/end_header/ { body = 1 } END { print out[0] + 0, "of", n[0], "and", out[1] + 0, "of", n[1] }'
}
mr-transform --translate 6,0,0 ball.mrs | mr-cat --append ball.mrs - >two.mrs
mr-normals two.mrs | mr-export -q - -f ply-ascii >two.ply
awk '!body { print } body { print $1, $2, $3, $4 * ($1 < 3), $5 * ($1 < 3), $6 * ($1 < 3) } /end_header/ { body = 1 }' two.ply >half.ply
mr-import half.ply | mr-normals --keep 2>&1 >half.mrs
outward <half.mrs
awk '!body { print } body { print $1, $2, $3, 0, 0, 0 } /end_header/ { body = 1 }' two.ply >none.ply
mr-import none.ply | mr-normals --keep | outward
awk '!body { print } body { n++; s = n % 5 ? 1 : -1; print $1, $2, $3, s * $4, s * $5, s * $6 } /end_header/ { body = 1 }' two.ply >fifth.ply
mr-import fifth.ply | mr-normals --keep 2>err | outward
sed 's/first near ([^)]*)/first near .../; s/[0-9.]* % of neighbours/.../' err

echo 'repeated points have one normal, outliers that of the nearest point'
printf '0 0 0\n1 0 0\n0 1 0\n1 1 0\n1 1 0\n' >twice.xyz
mr-import twice.xyz | mr-normals --from 0,0,1 | mr-export -q - -f ply-ascii | sed '1,/end_header/d'

echo 'surfaces'
mr-make cube -n 8 | mr-normals | mr-export -q - -f ply-ascii | sed '1,/end_header/d' | sed -n 1,2p
mr-make cube -n 8 | mr-normals --flip | mr-export -q - -f ply-ascii | sed '1,/end_header/d' | sed -n 1,2p

echo 'refusals'
refused() {
	mr-normals "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
mr-make cube -n 8 >cube.mrs
refused --from 1,2 ball.mrs
refused --from x,y,z ball.mrs
refused --neighbours 2 ball.mrs
refused --neighbours 129 ball.mrs
refused --from 0,0,0 cube.mrs
refused --neighbours 9 cube.mrs
refused -l base ball.mrs
printf '0 0 0\n1 1 1\n2 2 2\n3 3 3\n' >line.xyz
mr-import line.xyz | refused
printf '0 0 0\n0 0 0\n1 0 0\n' >two.xyz
mr-import two.xyz | refused

echo 'a thin half shell, of enough points and of few'
for n in 30000 6000; do
	mr-make sphere --points $n | mr-export -l points -f xyz - | awk '$3 < 0 { # walls, and one point in ten on the rim
		k = NR % 10; t = k < 5 ? 1.1 : k < 9 ? 0.9 : 0.9 + 0.2 * (NR % 7) / 6; r = sqrt($1^2 + $2^2)
		if (k == 9) { $1 /= r; $2 /= r; $3 = 0 }
		print 0.35 * t * $1, 0.25 * t * $2, 0.2 * t * $3
	}' >shell.xyz
	mr-import --points shell.xyz | mr-normals 2>&1 >/dev/null | grep -c uncertain
done

echo 'a deep cup, whose inner wall hardly any flood comes to, is right' >&2
awk 'function u() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
function point(r, z) { a = 6.283185307 * u(); print r * cos(a), r * sin(a), z }
BEGIN { seed = 5; while (n++ < 20000) { w = u() * 333
	if (w < 151) point(3, 8 * u()); else if (w < 276) point(2.6, 0.4 + 7.6 * u()); else if (w < 304) point(3 * sqrt(u()), 0)
	else if (w < 326) point(2.6 * sqrt(u()), 0.4); else point(sqrt(6.76 + 2.24 * u()), 8) } }' >cup.xyz
mr-import --points cup.xyz | mr-normals 2>&1 >out | grep -c uncertain >&2
mr-make sphere --points 20000 | mr-normals -o out
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\n' | mr-import | mr-normals -o out

echo 'a tetrahedron, across whose sharp edges planes look alike with the wrong sign'
awk 'function u() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
BEGIN { seed = 7; while (n++ < 10000) { a = u(); b = u(); if (a + b > 1) { a = 1 - a; b = 1 - b }
	w = u() * 2.366; if (w < 0.5) print a, b, 0; else if (w < 1) print a, 0, b; else if (w < 1.5) print 0, a, b; else print a, b, 1 - a - b } }' >tetra.xyz
mr-import --points tetra.xyz | mr-normals | mr-export -q - -f ply-ascii | awk 'body { # the normal of the face that the point is on
	out = $3 < 1e-9 ? -$6 : $2 < 1e-9 ? -$5 : $1 < 1e-9 ? -$4 : $4 + $5 + $6; bad += out < 0 } /end_header/ { body = 1 }
	END { print bad < 100 ? "at most 1 % are inside out" : bad " of 10000 are inside out" }'

echo 'an open sheet, of hills and valleys: one side, and that it is arbitrary' >&2
awk 'function u() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
BEGIN { seed = 9; while (n++ < 20000) { x = 12 * u(); y = 9 * u(); print x, y, 0.6 * sin(2 * x) * cos(2 * y) } }' >hills.xyz
mr-import --points hills.xyz | mr-normals | mr-export -q - -f ply-ascii | awk 'body { up += $6 > 0 } /end_header/ { body = 1 }
	END { print "hills:", up == 0 || up == 20000 ? "all on one side" : up " of 20000 up" }'

