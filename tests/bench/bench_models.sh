# What remeshing by default options makes of models, before and after: the table of README.md beside this, a row each.
figure() { # name, file: a number of a line of JSON
	grep -o "\"$1\":[^,}]*" "$2" | head -n 1 | cut -d : -f 2
}
echo '| model | vertices | areas | angles | valence 6 | distance | Euler number, loops | folded, flipped |'
echo '| --- | --- | --- | --- | --- | --- | --- | --- |'
row() { # model, file
	mr-import "$2" | mr-smooth -o before.mrs && mr-remesh --stats stats.json before.mrs -o after.mrs || exit
	for state in before after; do
		mr-info --json --no-intersections -l base $state.mrs >$state || exit
		for name in vertices voronoi_error angle_error valence6 euler boundary_loops; do
			figure $name $state
		done | tr '\n' ' '
	done >row
	mr-compare -a base -b base --json before.mrs <after.mrs | sed 's/.*"both_relative":{"hausdorff":\([^,}]*\).*/\1/' >distance
	echo "$(cat row) $(cat distance) $(figure folded stats.json) $(figure flipped stats.json)" | awk -v m="$1" '{
		printf "| %s | %d | %.2g to %.2g %% | %.3g to %.2g | %.0f to %.0f %% | %.2g %% | %s | %d, %d |\n",
			m, $7, 100 * $2, 100 * $8, $3, $9, 100 * $4, 100 * $10, 100 * $13,
			$5 == $11 && $6 == $12 ? "kept" : $5 ", " $6 " to " $11 ", " $12, $14, $15 }'
}
mr-make bumpy -o bumpy.mrs && mr-export bumpy.ply <bumpy.mrs && row bumpy bumpy.ply
for file in bunny00.off.gz armadillo.off.gz horse.ply.gz igea.ply.gz nefertiti.obj.gz elephant.off lion-head.off.gz \
    fandisk.obj.gz knot1.off cheese.off.gz; do
	[ ! -f "$DATA/meshes/$file" ] || row "${file%%.*}" "$DATA/meshes/$file"
done
