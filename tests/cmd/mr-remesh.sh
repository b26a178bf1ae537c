# Remeshing keeps the topology and evens the areas; what it cannot work on is refused by name.
figure() { # name, file: a number of a line of JSON
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" "$2"
}
for shape in torus knot bumpy boxes plane; do
	mr-make $shape -n 6000 | mr-smooth -t 2 -o in.mrs && mr-remesh --stats stats.json in.mrs -o out.mrs || exit
	mr-info --json -l mesh in.mrs >before.json && mr-info --json -l base out.mrs >after.json || exit
	for name in euler boundary_loops components nonmanifold_edges degenerate_faces folded_edges; do
		b=$(figure $name before.json) a=$(figure $name after.json)
		[ "$a" = "$b" ] && echo "$shape: $name: ok" || echo "$shape: $name: $b became $a"
	done
	for name in flipped folded; do
		echo "$shape: $name: $(figure $name stats.json)"
	done
	awk -v b="$(figure area_variance_before stats.json)" -v a="$(figure area_variance_after stats.json)" -v s=$shape \
	    'BEGIN { print s ": area variance", (a < b / 2 ? "ok" : "bad: " b " " a) }'
done
echo 'the source map lies on the mesh'
mr-info --check out.mrs >/dev/null && echo ok
echo 'twice, coarser: the maps compose'
mr-make bumpy -n 6000 | mr-smooth | mr-remesh | mr-remesh -r 2 -o twice.mrs && mr-info --check twice.mrs >/dev/null && echo ok
echo 'a plate thinner than an edge: no fold'
printf 'OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 .02\n1 0 .02\n1 1 .02\n0 1 .02\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n' >plate.off
mr-import plate.off | mr-remesh -L .1 --stats stats.json >/dev/null && echo "$(figure flipped stats.json) $(figure folded stats.json)"
echo 'edges of ten and of twenty times the thickness: what is folded is merged away'
mr-import plate.off | mr-remesh -L .2 --stats stats.json >/dev/null && echo "$(figure flipped stats.json) $(figure folded stats.json)"
sed 's/ \.02$/ .005/' plate.off >thin.off && mr-import thin.off | mr-remesh -L .1 --stats stats.json >/dev/null && echo "$(figure flipped stats.json) $(figure folded stats.json)"
echo 'as many as are wanted'
for n in '--vertices 2000' '--faces 10000' '--vertices 5000 --adaptive 0.2%'; do
	mr-make bumpy -n 4000 | mr-remesh $n --stats stats.json >/dev/null &&
	    awk -v v="$(figure vertices stats.json)" -v f="$(figure faces stats.json)" -v n="$n" 'BEGIN {
		split(n, word, " ")
		x = (word[1] == "--faces" ? f : v) / word[2]
		print n ": " (x > 0.95 && x < 1.05 ? "ok" : x) }'
done
echo 'rounds end where they even out nothing any more'
mr-make bumpy -n 3000 --noise .01 -o noisy.mrs
for adaptive in 0 0.1%; do
	for n in 50 100; do
		mr-remesh --adaptive $adaptive -n $n --stats stats.json noisy.mrs >/dev/null && figure splits stats.json
	done | uniq | wc -l
done
echo 'a length that takes too much is refused with one to take'
mr-make sphere -n 500 | mr-remesh -L 1e-9 2>&1 >/dev/null | sed 's/where at most [^ ]* may be: take a length of [0-9.e-]*/where at most M may be: take a length of L/'
printf 'OFF\n3 1 0\n0 0 0\n1e7 0 0\n0 1e-7 0\n3 0 1 2\n' >needle.off
mr-import needle.off | mr-remesh >out.mrs
echo $?
echo 'two triangles on one another stay'
printf 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n' >pillow.off
mr-import pillow.off | mr-remesh --stats stats.json >/dev/null && figure faces stats.json
echo 'not a manifold'
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' >fan.off
mr-import fan.off | mr-remesh >out.mrs
echo $?

echo 'nor one whose faces no number counts'
mr-make sphere -n 500 | mr-remesh -L 1e-300 >out.mrs
echo $?
echo 'a ring of thin wire loses volume rather than area'
awk 'BEGIN { n = 150; k = 12; print "OFF\n" n * k, 2 * n * k, 0
	for (i = 0; i < n; i++) for (j = 0; j < k; j++) {
		a = 6.283185307 * i / n; b = 6.283185307 * j / k; r = 1 + .08 * cos(b); print r * cos(a), r * sin(a), .08 * sin(b) }
	for (i = 0; i < n; i++) for (j = 0; j < k; j++) {
		p = i * k + j; q = (i + 1) % n * k + j; s = i * k + (j + 1) % k; t = (i + 1) % n * k + (j + 1) % k
		print 3, p, q, t; print 3, p, t, s } }' >ring.off
mr-import ring.off | mr-remesh -r 2.5 >/dev/null
mr-make boxes --genus 9 -n 4000 | mr-remesh --vertices 12 2>&1 >/dev/null | sed -n 's/.* vertices and .* faces are .* times as many as were wanted/more than wanted/p'

echo 'four faces that meet at acute edges'
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >corner.off
for length in 10% 5% 2%; do
	mr-remesh -q -L $length corner.off | mr-info -l base | sed -n '/base:/,$p' | awk '/flaws/ { flaws = $2 } /  size/ { print ($5 + 0 > 1.8 && $5 + 0 < 2.366), flaws }'
done

echo 'a rod of CAD, of faces as long as it'
awk 'BEGIN { n = 64; for (k = 0; k < 2; k++) for (i = 0; i < n; i++) print "v", cos(6.2831853071795862 * i / n), sin(6.2831853071795862 * i / n), 50 * k
	print "v 0 0 0"; print "v 0 0 50"
	for (i = 0; i < n; i++) { a = i + 1; b = (i + 1) % n + 1; print "f", a, b, b + n; print "f", a, b + n, a + n; print "f", b, a, 2 * n + 1; print "f", a + n, b + n, 2 * n + 2 } }' >rod.obj
mr-remesh -L 0.5 rod.obj -o rod.mrs
mr-info --check rod.mrs >checked || cat checked
mr-info -l base rod.mrs | sed -n '/base:/,$p' | grep -E 'topology|flaws|volume'
mr-encode rod.mrs | mr-decode -o back.mrs && mr-compare -l mesh rod.mrs back.mrs | awk '/^  both  / { print ($5 < 1e-8 ? "and back" : $5) }'

echo 'bodies that share a wall: finer, more pairs of faces coincide, in the same places' >&2
mr-make cube -n 12 -o cube.mrs
mr-transform --translate 2,0,0 cube.mrs | mr-cat --append cube.mrs - | mr-remesh -L 8% --feature 40 2>&1 >out | sed 's/vertex.*/vertex/' >&2

echo 'so many vertices as a surface has room for, limbs thinner than an edge is long at half as many: no warning, none flat' >&2
mr-make torus -n 1000 | mr-remesh --vertices 320 -o torus.mrs
mr-compare -a base -b mesh <torus.mrs | awk '/^  both, %/ { print ($6 < 1 ? "near" : $6) }'
mr-make knot -n 2000 | mr-remesh --vertices 1000 >/dev/null
mr-make cylinder -n 6000 | mr-transform --scale 0.2,0.2,1 | mr-remesh --vertices 1000 --stats stats.json >/dev/null
sed 's/.*"vertices":\([0-9]*\).*/\1/' stats.json | awk '{ print ($1 > 950 && $1 < 1050 ? "a thousand" : $1) }'

echo 'what another layer than mesh had from its file'
printf 'COFF\n4 4 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n0 0 1 9 9 9 255\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >colors.off
for layer in base fine mesh; do
	mr-import -l $layer colors.off | mr-remesh -l $layer -L 0.3 2>&1 >out.mrs | sed -n 's/.*\(base is made\)/\1/p'
done

echo 'parts that are thinner than the edges, of which the sum does not tell' >&2
mr-make cube -n 602 -o body.mrs
mr-make cube -n 8 | mr-transform -s 0.02,1,0.02 -t 1.5,0,0 -o pole.mrs
mr-cat --append body.mrs pole.mrs | tee parts.mrs | mr-remesh >/dev/null
mr-simplify -n 300 parts.mrs >/dev/null

echo 'an angle iron whose fillet long edges cut across, so that there is more of it' >&2
awk 'function p(a, b) { x[n] = a; y[n++] = b }
BEGIN { n = 0; w = 0.06; r = 0.3; p(0, 0); p(1, 0); p(1, w)
	for (i = 0; i <= 8; i++) { a = -1.570796 - 1.570796 * i / 8; p(w + r + r * cos(a), w + r + r * sin(a)) }
	p(w, 1); p(0, 1)
	for (z = 0; z < 2; z++) for (i = 0; i < n; i++) print "v", x[i], y[i], z
	for (i = 1; i < n - 1; i++) { print "f", 1, i + 2, i + 1; print "f", n + 1, n + i + 1, n + i + 2 }
	for (i = 0; i < n; i++) { j = (i + 1) % n; print "f", i + 1, j + 1, n + j + 1; print "f", i + 1, n + j + 1, n + i + 1 } }' |
	mr-import -f obj -o iron.mrs
mr-remesh -r 20 --feature 40 iron.mrs >/dev/null
mr-remesh -r 6 --feature 40 iron.mrs >/dev/null
