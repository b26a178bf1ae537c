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
		echo "$shape: $name: $(figure $name stats.json) of $(figure ${name}_before stats.json)"
	done
	awk -v b="$(figure area_variance_before stats.json)" -v a="$(figure area_variance_after stats.json)" -v s=$shape \
	    'BEGIN { print s ": area variance", (a < b / 2 ? "ok" : "bad: " b " " a) }'
done
echo 'the source map lies on the mesh'
mr-info --check out.mrs >/dev/null && echo ok
echo 'twice, coarser: the maps compose'
mr-make bumpy -n 6000 | mr-smooth | mr-remesh | mr-remesh -r 2 -o twice.mrs && mr-info --check twice.mrs >/dev/null && echo ok
echo 'a plate thinner than an edge: shorter edges at its rim, no fold'
printf 'OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 .02\n1 0 .02\n1 1 .02\n0 1 .02\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n' >plate.off
mr-import plate.off | mr-remesh -L .1 --stats stats.json >/dev/null && echo "$(figure flipped stats.json) $(figure folded stats.json)"
echo 'edges of ten and of twenty times the thickness: what is folded is merged away'
mr-import plate.off | mr-remesh -L .2 --stats stats.json >/dev/null && echo "$(figure flipped stats.json) $(figure folded stats.json)"
sed 's/ \.02$/ .005/' plate.off >thin.off && mr-import thin.off | mr-remesh -L .1 --stats stats.json >/dev/null && echo "$(figure flipped stats.json) $(figure folded stats.json)"
echo 'not a manifold'
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' >fan.off
mr-import fan.off | mr-remesh >out.mrs
echo $?
