# Loop subdivision of about 1,000 triangles five times, to a million, beside OpenMesh; medians of five, the algorithm alone.
figure() { # name: a number of stats.json
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" stats.json
}
median() {
	sort -g | sed -n 3p
}
mr-make sphere -n 502 -o coarse.mrs && mr-export coarse.off <coarse.mrs || exit
for options in '' --limit '-j 1'; do
	for i in 1 2 3 4 5; do
		mr-subdivide -n 5 $options --stats stats.json coarse.mrs -o out.mrs || exit
		figure seconds
	done | median >"ours$options"
done
echo "subdivide-1M-faces mr $(figure faces) -"
echo "subdivide-1M mr $(cat ours) s"
echo "subdivide-1M-one-thread mr $(cat 'ours-j 1') s"
echo "subdivide-1M-limit mr $(cat ours--limit) s"
[ -x "$BUILD/bench/peer_subdivide" ] || exit 0
for i in 1 2 3 4 5; do
	peer_subdivide coarse.off 5
done | median >peer
echo "subdivide-1M openmesh $(cat peer) s"
echo "subdivide-1M-one-thread openmesh $(cat peer) s"
