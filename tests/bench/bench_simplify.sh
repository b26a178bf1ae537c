# Simplification to 1,000 vertices beside CGAL, medians of three: the algorithm alone, then what came out.
figure() { # name, file: a number of a line of JSON
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" "$2"
}
median() {
	sort -g | sed -n 2p
}
describe() { # who, stream: distances both ways in % of the diagonal, and shape
	mr-compare -a mesh -b mesh --json in.mrs <"$2" >compare.json || exit
	sed 's/.*"both":{\([^}]*\)}.*/\1/' compare.json >both
	awk -v m="$(figure mean both)" -v h="$(sed 's/.*"max":\([^,}]*\).*/\1/' both)" -v d="$(figure diagonal compare.json)" \
	    -v c="$model" -v w="$1" 'BEGIN { print c "-mean", w, 100 * m / d, "%"; print c "-hausdorff", w, 100 * h / d, "%" }'
	mr-info --json -l mesh "$2" >info.json
	for name in angle_error angle_min; do
		echo "$model-$name $1 $(figure $name info.json) deg"
	done
}
case_of() { # model: simplifies in.mrs
	model=$1
	for i in 1 2 3; do
		mr-simplify -n 2000 --stats stats.json in.mrs -o out.mrs || exit
		figure seconds stats.json
	done | median >ours
	echo "$model-seconds mr $(cat ours) s"
	describe mr out.mrs
	[ -x "$BUILD/bench/peer_simplify" ] || return 0
	mr-export -i in.mrs in.off || exit
	for method in gh lt; do
		for i in 1 2 3; do
			peer_simplify in.off peer.off 2000 $method
		done | median >peer
		mr-import peer.off -o peer.mrs
		echo "$model-seconds cgal-$method $(cat peer) s"
		describe cgal-$method peer.mrs
	done
}
mr-make bumpy -n 50000 -o in.mrs && case_of bumpy-100k
if [ -f "$DATA/meshes/igea.ply.gz" ]; then
	mr-import "$DATA/meshes/igea.ply.gz" -o in.mrs && case_of igea
fi
if [ -f "$DATA/meshes/armadillo.off.gz" ]; then
	mr-import "$DATA/meshes/armadillo.off.gz" | mr-subdivide -n 1 -o in.mrs && case_of armadillo-208k
fi
