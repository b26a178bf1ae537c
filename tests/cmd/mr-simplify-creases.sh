# Sharp edges of points are kept, by all that subdivides; smooth surfaces have none.
figure() { # FILE, name
	grep -o "\"$2\":[0-9.e+-]*" "$1" | cut -d: -f2
}
# The mean distance of the edges of a cube from a surface, in ten-thousandths of its diagonal.
awk 'BEGIN { for (i = 0; i < 200; i++) for (s = -1; s < 2; s += 2) for (t = -1; t < 2; t += 2) {
	x = (2 * i + 1) / 200 - 1; print x, s, t; print s, x, t; print s, t, x } }' >edges.xyz
mr-import --points edges.xyz -o edges.mrs
off() {
	mr-compare -a points -b mesh --json "$1" <edges.mrs | sed 's/.*"a_to_b":{[^}]*"mean":\([0-9.e-]*\).*/\1/' |
	    awk '{ printf "%.0f", $1 / sqrt(12) * 1e4 }'
}
mr-make cube -n 10000 --points 10000 | mr-shrinkwrap -o wrap.mrs
mr-simplify -n 300 --smooth wrap.mrs | mr-fit | mr-sample | mr-decode -o round.mrs
mr-simplify -n 300 --stats stats wrap.mrs -o simple.mrs
mr-fit simple.mrs -o fit.mrs && mr-sample fit.mrs -o scan.mrs && mr-decode scan.mrs -o sharp.mrs
creases=$(figure stats creases)
[ "$creases" -ge 36 ] && echo 'creases are marked' || echo "only $creases creases are marked"
round=$(off round.mrs) sharp=$(off sharp.mrs)
[ "$round" -ge $((2 * sharp)) ] && echo 'edges are sharp' || echo "edges are $sharp off, and without creases $round"
mr-info fit.mrs | grep 'crease ' | cut -c1-30
mr-export -l control control.obj <fit.mrs
mr-export -l control control.glb <fit.mrs
mr-simplify -n 300 -j 1 wrap.mrs | cmp - simple.mrs && echo 'the same by one thread'

echo 'curves are whole, for any number of faces'
for shape in cube cylinder; do
	for n in 2000 6000 20000; do
		mr-make $shape --points $n | mr-shrinkwrap -q -o whole.mrs
		for faces in 300 1000; do
			mr-simplify -q -n $faces --stats stats whole.mrs -o /dev/null
			[ "$(figure stats creases)" -ge 24 ] || echo "$shape of $n points, $faces faces: $(figure stats creases)"
		done
	done
done

echo 'edits, equalizing, maps and mirrors keep them'
mr-equalize --gain 1 scan.mrs --no-history | mr-decode --no-history -o equal.mrs
mr-decode --no-history scan.mrs | mr-compare -a mesh -b mesh --json equal.mrs | grep -oE '"vertex_max_relative":(0}|[0-9.]*e-1[0-9])' | cut -c1-22
mr-map -w cube scan.mrs | mr-map -r cube-height.png | mr-decode -o back.mrs
[ "$(off back.mrs)" -le $((sharp + 1)) ] && echo 'maps do'
mr-select --free all --handle 0=above:y,0.5 scan.mrs | mr-pose --translate 0,0,0 | mr-solve | mr-info | grep 'crease ' | cut -c1-30
mr-subdivide -n 2 --limit -l control fit.mrs | mr-transform -l mesh --scale -1,1,1 -o after.mrs
mr-transform -l control --scale -1,1,1 fit.mrs | mr-subdivide -n 2 --limit -l control |
    mr-compare -a mesh -b mesh --json after.mrs | grep -o '"hausdorff":[0-9.e-]*' | head -n 1 | awk -F: '{ print ($2 < 1e-9 ? "mirrors do" : "mirrors do not: " $2) }'

echo 'where there are none'
mr-make torus --points 8000 | mr-shrinkwrap | mr-simplify --stats stats -o torus.mrs
figure stats creases
mr-info torus.mrs | grep -c 'crease '
mr-make cube --points 10000 --noise 1% | mr-shrinkwrap -q -o noisy.mrs && mr-simplify noisy.mrs | mr-info | grep -c 'crease '
mr-simplify noisy.mrs --creases --stats stats >/dev/null
figure stats creases

echo 'refusals'
mr-make torus | mr-simplify --creases
echo "exit $?"
mr-simplify --creases --to base wrap.mrs
echo "exit $?"
