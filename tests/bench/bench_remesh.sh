# Remeshing to the same edge length beside CGAL, medians of three: the algorithm alone, then what came out.
figure() { # name, file: a number of a line of JSON
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" "$2"
}
median() {
	sort -g | sed -n 2p
}
describe() { # who, file with one line of mr-info --json
	for name in voronoi_error angle_error angle_min valence6; do
		echo "$model-$name $1 $(figure $name "$2") -"
	done
}
case_of() { # model: remeshes base.mrs
	model=$1
	for i in 1 2 3; do
		mr-remesh --stats stats.json base.mrs -o out.mrs || exit
		figure seconds stats.json
	done | median >ours
	mr-info --json -l base out.mrs >ours.json
	echo "$model-seconds mr $(cat ours) s"
	describe mr ours.json
	[ -x "$BUILD/bench/peer_remesh" ] || return 0
	mr-export -l base -i base.mrs base.off || exit
	for i in 1 2 3; do
		peer_remesh base.off peer.off "$(figure length stats.json)" 5
	done | median >peer
	mr-import peer.off | mr-info --json -l mesh >peer.json
	echo "$model-seconds cgal $(cat peer) s"
	describe cgal peer.json
}
mr-make bumpy -n 50000 | mr-smooth -o base.mrs && case_of bumpy-100k
for file in nefertiti.obj.gz igea.ply.gz; do
	[ -f "$DATA/meshes/$file" ] || continue
	mr-import "$DATA/meshes/$file" | mr-smooth -o base.mrs && case_of "${file%%.*}"
done
