# Whole commands as one runs them, start and files included: wall seconds, medians of RUNS, ours and the peer's by turns.
# Of CGAL and OpenMesh only the algorithm is timed, without reading and writing.  Nothing else should run meanwhile.
# Knobs: RUNS (default 5), ROWS (a pattern of their names, default all).  Without $DATA/meshes shapes of mr-make are used.
RUNS=${RUNS:-5}
median() {
	sort -g | awk '{ x[NR] = $1 } END { print x[int((NR + 1) / 2)] }'
}
wall() { # command line: appends its seconds to $times
	begin=$(date +%s.%N)
	sh -c "$1" >/dev/null 2>err || { cat err >&2; exit 1; }
	echo "$(date +%s.%N) $begin" | awk '{ print $1 - $2 }' >>"$times"
}
row() { # case, ours, peer's name, command: a line each; of a peer's command that prints a number, that is its time
	echo "$1" | grep -qE -e "${ROWS:-.}" || return 0
	rm -f mr.times peer.times
	for i in $(seq "$RUNS"); do
		times=mr.times wall "$2"
		case $3 in
		'') ;;
		cat) times=peer.times wall "$4" ;;
		*) sh -c "$4" >>peer.times || return ;;
		esac
	done
	echo "$1 mr $(median <mr.times) s"
	[ ! -e peer.times ] || echo "$1 $3 $(median <peer.times) s"
}
peer() { # name: it, if it is built
	[ ! -x "$BUILD/bench/peer_$1" ] || echo "$2"
}
model() { # name, file in $DATA/meshes, vertices of a shape instead: NAME.mrs
	if [ -e "$DATA/meshes/$2" ]; then
		mr-import -q --repair "$DATA/meshes/$2" -o "$1.mrs"
	else
		mr-make bumpy -n "$3" -o "$1.mrs"
	fi
}

model bunny bunny00.off.gz 35000 && model nefertiti nefertiti.obj.gz 50000 && model igea igea.ply.gz 134000 &&
    model dragon dragon_vrip.ply.gz 430000 || exit
ends='mr-select --free all --fixed below:y,0.3 --handle 0=above:y,0.8'
turn='mr-pose --rotate 0,1,0,30'
for name in bunny igea; do
	row smooth-$name "mr-smooth $name.mrs -o smooth.mrs"
	mr-smooth -q $name.mrs | mr-remesh -q | $ends -q >$name.selected.mrs
	row encode-$name "mr-encode $name.selected.mrs -o encoded.mrs"
	mr-encode -q $name.selected.mrs -o $name.encoded.mrs
	row pose-and-solve-$name "$turn $name.encoded.mrs | mr-solve -o solved.mrs"
	$turn -q $name.encoded.mrs | mr-solve -q -o $name.solved.mrs
	row decode-$name "mr-decode $name.solved.mrs -o decoded.mrs"
	row edit-$name "mr-smooth $name.mrs | mr-remesh | $ends | mr-encode | $turn | mr-solve | mr-decode -o edited.mrs"
done
row poses-300-bunny "$turn -F 299 bunny.encoded.mrs | mr-solve | mr-decode"
row basis-300-bunny "mr-solve --basis bunny.encoded.mrs | $turn -F 299 | mr-decode"
for name in nefertiti igea dragon; do
	mr-smooth -q $name.mrs -o base.mrs
	mr-remesh -q --stats stats.json base.mrs -o /dev/null
	mr-export -q -l base -i base.mrs base.off
	row remesh-$name "mr-remesh base.mrs -o out.mrs" "$(peer remesh cgal)" \
	    "peer_remesh base.off peer.off $(sed 's/.*"length":\([^,}]*\).*/\1/' stats.json) 5"
done
mr-export -q -i igea.mrs igea.off
row simplify-igea "mr-simplify -n 1000 igea.mrs -o out.mrs" "$(peer simplify cgal)" "peer_simplify igea.off peer.off 1000 lt"
mr-make sphere -n 502 -o coarse.mrs && mr-export -i coarse.mrs coarse.off
row subdivide-1M "mr-subdivide -n 5 coarse.mrs -o out.mrs" "$(peer subdivide openmesh)" "peer_subdivide coarse.off 5"
for size in 35 134 1000; do
	mr-make bumpy -n ${size}000 --points ${size}000 -o points.mrs
	row points-${size}k "mr-shrinkwrap points.mrs | mr-simplify | mr-fit | mr-sample -o out.mrs"
done
mr-subdivide -q -n 1 igea.mrs | mr-export -q -l mesh igea4.obj
row import-obj "mr-import igea4.obj -o out.mrs"
for i in 1 2 3 4 5 6 7 8; do echo dragon.mrs; done | xargs mr-cat -o long.mrs
row cat "mr-cat long.mrs | cat" cat "cat long.mrs | cat"
