# Displaced subdivision surfaces from clouds: seconds of the whole pipe and its most memory; how far the points are from
# the surface (gap), the surface from the points (back), and from the model that they are the vertices of (truth), of the
# diagonal; the same of the domain without displacement; tries of the search; and what CGAL makes of the same points.
# Medians of three.  Genus by the volume and the speed of large clouds at the end.
figure() { # name, file: a number of the last line of JSON
	sed -n '$s/.*"'"$1"'":\([^,}]*\).*/\1/p' "$2"
}
most() { # key, files: the largest
	key=$1
	shift
	sed -n 's/.*"'"$key"'":\([^,}]*\).*/\1/p' "$@" | sort -g | tail -n 1
}
ends() { # from, to, key: of their distance, in per cent of the diagonal
	sed 's/.*"'"$1_to_$2"'_relative":{\([^}]*\)}.*/\1/' compare.json | sed 's/.*"'"$3"'":\([^,}]*\).*/\1/' | awk '{ print 100 * $1 }'
}
reconstruct() { # stream of points, level or nothing
	mr-shrinkwrap --stats 1.json "$1" | mr-simplify $faces --stats 2.json | mr-fit --stats 3.json |
	    mr-sample ${2:+-n $2} --stats 4.json | tee sampled.mrs | mr-decode --stats 5.json -o out.mrs
}
surface() { # who, stream with points and mesh
	mr-compare --json -a points -b mesh <"$2" >compare.json
	echo "$model-gap-mean $1 $(ends a b mean) %"
	echo "$model-gap-max $1 $(ends a b max) %"
	echo "$model-back-max $1 $(ends b a max) %"
	mr-info --json -l mesh "$2" >info.json
	echo "$model-vertices $1 $(figure vertices info.json) -"
	for flaw in folded_edges intersecting_pairs components genus boundary_loops; do
		echo "$model-$flaw $1 $(figure $flaw info.json) -"
	done
	if [ -f truth.mrs ]; then
		mr-compare --json -a mesh -b mesh truth.mrs <"$2" >compare.json
		echo "$model-truth-mean $1 $(ends a b mean) %"
		echo "$model-truth-max $1 $(ends a b max) %"
	fi
}
case_of() { # name; points.mrs, and truth.mrs with the surface as its base, where it is known
	model=$1
	for i in 1 2 3; do
		begin=$(date +%s.%N)
		reconstruct points.mrs "$level" || return
		echo "$(date +%s.%N) $begin" | awk '{ print $1 - $2 }'
	done | sort -g | sed -n "2s/.*/$model-seconds mr & s/p"
	echo "$model-memory mr $(most peak_bytes [1-5].json | awk '{ print $1 / 1e6 }') MB"
	echo "$model: wrap $(figure seconds 1.json), simplify $(figure seconds 2.json), fit $(figure seconds 3.json), sample $(figure seconds 4.json), decode $(figure seconds 5.json) s;" \
	    "found at the first try $(figure tries_1 4.json), by the fourth $(figure tries_4 4.json), within ten $(figure tries_10 4.json)"
	surface mr out.mrs
	mr-decode --gain 0 sampled.mrs | mr-compare --json -a points -b mesh >compare.json
	echo "$model-gap-mean domain $(ends a b mean) %"
	echo "$model-gap-max domain $(ends a b max) %"
	[ -z "$level" ] || return 0
	mr-shrinkwrap -q points.mrs | mr-simplify -n $((2 * $(figure faces 2.json))) | mr-fit | mr-sample -n "$(figure level 4.json)" |
	    mr-decode -o twice.mrs && surface twice-the-vertices twice.mrs
	[ -x "$BUILD/bench/peer_reconstruct" ] || return 0
	mr-export -l points points.xyz <points.mrs
	for who in poisson front; do
		for i in 1 2 3; do
			peer_reconstruct $who points.xyz peer.off
		done | sort -g | sed -n "2s/.*/$model-seconds cgal-$who & s/p"
		mr-import peer.off | mr-cat --merge points.mrs - >peer.mrs && surface cgal-$who peer.mrs
	done
}
from_mesh() { # file: its vertices
	mr-import --points "$1" -o points.mrs && mr-import "$1" -o truth.mrs
}
faces= level=
mr-make bumpy -n 16000 --points 16000 -o points.mrs && mr-make bumpy -n 60000 -o truth.mrs && case_of bumpy-16k
for file in bunny00.off.gz armadillo.off.gz igea.ply.gz horse.ply.gz lucy.ply.gz mannequin-devil.off.gz; do
	[ -f "$DATA/meshes/$file" ] && from_mesh "$DATA/meshes/$file" && case_of "${file%%.*}"
done
rm -f truth.mrs
for file in kitten.xyz.gz oni.ply ball.ply.gz radar.xyz.gz ocean_r.xyz.gz; do
	[ -f "$DATA/points/$file" ] && mr-import --points "$DATA/points/$file" -o points.mrs && case_of "${file%%.*}"
done

# Of any genus: the vertices of models that have 3, 2, 1, 4 and 3.
for file in elephant.off eight.off knot1.off fertility.off 3holes.off; do
	[ -f "$DATA/meshes/$file" ] || continue
	mr-import --points "$DATA/meshes/$file" | mr-shrinkwrap -q -m volume | mr-simplify | mr-fit -q | mr-sample -q | mr-decode -o out.mrs
	mr-info --json -l mesh out.mrs >info.json
	echo "${file%.off}-volume-genus mr $(figure genus info.json) -"
	echo "${file%.off}-volume-flaws mr $(($(figure folded_edges info.json) + $(figure intersecting_pairs info.json))) -"
done

# The sizes of the paper's cat (5,842 points) and Spock (16,386), which took 24 and 167 s on a Pentium III at 866 MHz.
faces='-n 50' level=4
mr-make bumpy -n 5842 --points 5842 -o points.mrs && case_of paper-cat
faces='-n 150'
mr-make bumpy -n 16386 --points 16386 -o points.mrs && case_of paper-spock

# Speed alone.
faces= level=
for thousands in 6 16 35 170 1000; do
	mr-make bumpy -n $((1000 * thousands)) --points $((1000 * thousands)) -o points.mrs
	begin=$(date +%s.%N)
	reconstruct points.mrs
	echo "$(date +%s.%N) $begin" | awk '{ print $1 - $2 }' | sed "s/.*/cloud-${thousands}k-seconds mr & s/"
	most peak_bytes [1-5].json | awk -v n=$thousands '{ print "cloud-" n "k-memory mr", $1 / n / 1000, "bytes/point" }'
done
