# Closed forms, topology, columns that refer to the result; the same bytes for any number of threads.
figure() { # name, file: a number of a line of JSON
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" "$2"
}
within() { # what, least, value, most
	awk -v w="$1" -v a="$2" -v x="$3" -v b="$4" 'BEGIN { print w, (a <= x && x <= b ? "ok" : "bad: " x) }'
}

echo 'a cube of many faces is 12, and nothing is lost'
mr-make cube -n 5000 -o cube.mrs
mr-simplify -e 1e-9 --stats stats.json cube.mrs -o out.mrs
echo "$(figure faces stats.json) faces"
mr-compare -a mesh -b mesh --json cube.mrs <out.mrs >compare.json
within distance 0 "$(sed 's/.*"max":\([^,}]*\).*/\1/' compare.json)" 1e-9

echo 'a flat square is two triangles'
mr-make plane -n 2000 -o plane.mrs
mr-simplify -e 1e-9 --stats stats.json plane.mrs -o out.mrs
echo "$(figure faces stats.json) faces"
mr-info --json out.mrs >info.json
within area 3.999999999 "$(figure area info.json)" 4.000000001

echo 'a sphere: the volume stays, and the distance falls as one over the number of faces'
mr-make sphere -n 20000 -o sphere.mrs
for n in 250 1000; do
	mr-simplify -n $n sphere.mrs -o out.mrs
	mr-info --json out.mrs >info.json
	within volume 4.186 "$(figure volume info.json)" 4.19
	mr-compare -a mesh -b mesh --json sphere.mrs <out.mrs | sed 's/.*"both":{[^}]*"mean":\([^,}]*\).*/\1/' >mean-$n
done
within ratio 3.6 "$(paste mean-250 mean-1000 | awk '{ print $1 / $2 }')" 4.4

echo 'topology and shape'
for shape in torus knot bumpy boxes plane cylinder; do
	mr-make $shape -n 6000 -o in.mrs && mr-simplify -n 500 in.mrs -o out.mrs || exit
	mr-simplify -j 1 -n 500 in.mrs | cmp - out.mrs || echo "$shape: depends on threads"
	mr-info --json -l mesh in.mrs >before.json && mr-info --json -l mesh out.mrs >after.json || exit
	for name in euler boundary_loops components nonmanifold_edges degenerate_faces folded_edges; do
		b=$(figure $name before.json) a=$(figure $name after.json)
		[ "$a" = "$b" ] || echo "$shape: $name: $b became $a"
	done
	within "$shape: faces" 499 "$(figure faces after.json)" 500
	within "$shape: least angle" 2.5 "$(figure angle_min after.json)" 60
done

echo 'what cannot be merged stays'
mr-make boxes -n 2000 | mr-simplify -n 1 -v --stats stats.json -o out.mrs 2>err
grep -c 'faces are left, not 1' err
mr-info --json out.mrs >after.json
echo "genus $(figure genus after.json)"

echo 'the base keeps its map'
mr-make bumpy -n 6000 | mr-smooth -o base.mrs
mr-simplify -r 0.2 base.mrs -o out.mrs && mr-info --check out.mrs >info.txt && grep -o source_face info.txt
mr-select --free all --fixed below:y,0.1 --handle 1=above:y,0.9 out.mrs | mr-encode |
	mr-pose -H 1 --translate 0,1,0 | mr-solve | mr-decode | mr-info --check >info.txt && echo posed
mr-simplify -l base -r 0.5 out.mrs | mr-info --check | grep -o source_face

echo 'a control mesh goes by the points'
mr-make sphere -n 3000 | mr-export -f off - >control.off
mr-make sphere --points 6400 -o points.mrs
mr-import -l control control.off | mr-cat --merge - points.mrs | mr-simplify -o out.mrs || exit
mr-info --json -l control out.mrs >after.json
echo "$(figure faces after.json) faces"
echo 'two shells near each other pass through each other where few faces are left'
mr-make sphere -n 2000 | mr-export -f off - | awk 'NR == 2 { n = $1; m = $2 } NR > 2 && NR <= n + 2 { p[NR - 3] = $0 } NR > n + 2 { t[NR] = $0 }
	END { print "OFF\n" 2 * n, 2 * m, 0; for (i = 0; i < n; i++) print p[i]
		for (i = 0; i < n; i++) { split(p[i], x, " "); print .97 * x[1], .97 * x[2], .97 * x[3] }
		for (i = n + 3; i <= NR; i++) { split(t[i], v, " "); print t[i]; print 3, v[2] + n, v[4] + n, v[3] + n } }' >shells.off
mr-import shells.off | mr-simplify -n 150 2>&1 >/dev/null | sed 's/, as at.*//'

echo 'a rod of CAD, whose slivers are all alike; what is lost; what cannot be had'
awk 'BEGIN { n = 96; for (k = 0; k < 2; k++) for (i = 0; i < n; i++) print "v", cos(6.2831853071795862 * i / n), sin(6.2831853071795862 * i / n), 20 * k
	print "v 0 0 0"; print "v 0 0 20"
	for (i = 0; i < n; i++) { a = i + 1; b = (i + 1) % n + 1; print "f", a, b, b + n; print "f", a, b + n, a + n; print "f", b, a, 2 * n + 1; print "f", a + n, b + n, 2 * n + 2 } }' >rod.obj
mr-simplify -n 20 rod.obj | mr-info | grep -E 'faces|volume'
printf 'v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\nf 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n' >octahedron.obj
mr-simplify -r .5 octahedron.obj 2>&1 >out.mrs | grep -o 'mesh: .*'
mr-make boxes --genus 20 | mr-simplify -n 20 2>&1 >out.mrs | grep -o 'not 20.*'
echo 'what takes the place of another surface, and what goes with detail'
mr-make torus -n 500 | mr-smooth -o smooth.mrs
mr-encode smooth.mrs | mr-simplify -l mesh -r 0.5 2>&1 >out.mrs | grep -o 'mesh has.*'
mr-select --free all --handle 0=above:x,0.8 smooth.mrs | mr-encode | mr-pose --translate 0,0,1 | mr-solve -o posed.mrs
mr-simplify -l mesh -r 0.5 posed.mrs 2>&1 >out.mrs | grep -o 'mesh has.*'
mr-decode -q posed.mrs | mr-simplify -l mesh -r 0.5 2>&1 >out.mrs && echo none behind mr-decode
echo 'a part that is cut off, though little of the area is lost'
for n in 60 200; do
	mr-make bumpy -n 3000 | mr-simplify -n $n 2>&1 >out.mrs | grep -o 'what was near.*' || echo "none of $n faces"
done
echo 'blocks of a large mesh: the same for any number of threads, and no farther off than one block would be'
mr-make bumpy -n 60000 -o large.mrs && mr-simplify -j 1 -n 4000 large.mrs -o out.mrs && mr-simplify -j 3 -n 4000 large.mrs | cmp - out.mrs
mr-info --json out.mrs | grep -o '"faces":[0-9]*'
mr-compare -a mesh -b mesh large.mrs out.mrs | awk '/both, %/ { print $4 < 0.1 ? "near" : $0 }'
echo 'two triangles side by side stay, with and without vertices in common'
printf 'v 0 0 0\nv 0 2 0\nv 2 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nf 3 2 1\nf 4 6 5\n' >two.obj
for weld in '' '--weld 0'; do
	mr-import -q $weld two.obj | mr-simplify -q -n 1 | mr-info --json | grep -o '"faces":[0-9]*\|"area":[0-9.]*'
done

echo 'a texture of which each face has its own piece: the seams give way'
mr-make sphere -n 1000 | mr-export -q -f obj - | awk '
	/^v / { print }
	/^f / {
		x = n % 40 * 0.025
		y = int(n * 0.025) * 0.025
		n++
		print "vt", x, y; print "vt", x + 0.02, y; print "vt", x, y + 0.02
		printf "f %d/%d %d/%d %d/%d\n", $2, 3 * n - 2, $3, 3 * n - 1, $4, 3 * n
	}' >pieces.obj
mr-import -q pieces.obj | mr-simplify -n 100 2>err | mr-info | grep -c '100 faces\|corner_texcoord.* 100 rows'
grep -c 'seams give way' err

echo 'two spheres, one just inside the other: each keeps its colour'
for shell in '1 1 0 0' '0.96 0 0 1'; do
	mr-make sphere -n 1000 | mr-export -q -f obj - |
		awk -v shell="$shell" 'BEGIN { split(shell, s) } /^v / { print "v", s[1] * $2, s[1] * $3, s[1] * $4, s[2], s[3], s[4] } /^f / { print }' >shell.obj
	mr-import shell.obj
done | mr-cat --append | mr-simplify -q -n 60 | mr-split | mr-export -q 'shell%d.obj'
for i in 1 2; do awk '/^v / { print $5, $6, $7 }' shell$i.obj | sort -u; done
