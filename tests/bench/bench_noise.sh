# Clouds with noise and outliers, whose surface is known: seconds of the whole pipe; how far the truth is from the result,
# the result from the truth, and both, mean and largest, of the truth's diagonal; flaws.  By triangles and robustly, beside
# Open3D's Poisson, which gets its outliers removed and normals oriented (skipped where python3 has no open3d).
figure() { # name, file: a number of the last line of JSON
	sed -n '$s/.*"'"$1"'":\([^,}]*\).*/\1/p' "$2"
}
share() { # which way, mean or max: of a distance to the truth, in per cent
	sed 's/.*"'"$1"'_relative":{\([^}]*\)}.*/\1/; s/.*"'"$2"'":\([^,}]*\).*/\1/' compare.json | awk '{ print 100 * $1 }'
}
describe() { # who, stream
	mr-compare -a mesh -b mesh --json "$2" <truth.mrs >compare.json || exit
	for end in mean max; do
		echo "$model-from-truth-$end $1 $(share a_to_b $end) %"
		echo "$model-to-truth-$end $1 $(share b_to_a $end) %"
	done
	echo "$model-both-mean $1 $(share both mean) %"
	mr-info --json -l mesh "$2" >info.json
	for flaw in genus folded_edges intersecting_pairs; do
		echo "$model-$flaw $1 $(figure $flaw info.json) -"
	done
}
pipe() { # method
	mr-shrinkwrap points.mrs | mr-simplify | mr-fit | mr-sample -m "$1" | mr-decode -o out.mrs
}
case_of() { # name; points.mrs, truth.mrs
	model=$1
	for method in robust triangle; do
		who=mr
		[ $method = robust ] || who=mr-$method
		begin=$(date +%s.%N)
		pipe $method || exit
		echo "$(date +%s.%N) $begin" | awk -v c="$model" -v w=$who '{ print c "-seconds", w, $1 - $2, "s" }'
		describe $who out.mrs
	done
	[ -n "$PYTHON" ] || return 0
	mr-export -l points -i points.mrs points.xyz || exit
	echo "$model-seconds open3d $($PYTHON "$TOP/tests/bench/peer_open3d.py" points.xyz peer.ply) s"
	mr-import peer.ply -o peer.mrs
	describe open3d peer.mrs
}
dirty() { # stream of a mesh, deviation (of the diagonal), outliers (of the points): points.mrs
	mr-export -i "$1" clean.off || exit
	awk -v s="$2" -v o="$3" '
		function uniform() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
		function normal() { return sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform()) }
		BEGIN { seed = 20010 }
		FNR == 2 { n = $1 }
		FNR > 2 && FNR <= n + 2 {
			for (k = 1; k <= 3; k++) {
				x[FNR, k] = $k
				if (FNR == 3 || $k < low[k]) low[k] = $k
				if (FNR == 3 || $k > high[k]) high[k] = $k
			}
		}
		END {
			for (k = 1; k <= 3; k++) d += (high[k] - low[k]) ^ 2
			d = sqrt(d)
			for (i = 3; i <= n + 2; i++) print x[i, 1] + s * d * normal(), x[i, 2] + s * d * normal(), x[i, 3] + s * d * normal()
			for (i = 0; i < o * n; i++) {
				for (k = 1; k <= 3; k++) p[k] = low[k] - 0.05 * d + (high[k] - low[k] + 0.1 * d) * uniform()
				print p[1], p[2], p[3]
			}
		}' clean.off >dirty.xyz
	mr-import --points dirty.xyz -o points.mrs
}

. "$TOP/tests/bench/common.sh"
PYTHON=$(python_of_open3d)
[ -n "$PYTHON" ] || echo "bench_noise: without Open3D, which python3 has not: tests/bench/README.md says how to get it" >&2
mr-make torus -n 8000 -o truth.mrs && dirty truth.mrs 0.01 0.2 && case_of torus-1-20
mr-make knot -n 10000 -o truth.mrs && dirty truth.mrs 0.005 0.1 && case_of knot-0.5-10
mr-make bumpy -n 20000 -o truth.mrs && dirty truth.mrs 0.005 0.1 && case_of bumpy-0.5-10
data() { # name, mesh, points
	[ -f "$DATA/$2" ] && [ -f "$DATA/$3" ] || return 0
	mr-import "$DATA/$2" -o truth.mrs && mr-import --points "$DATA/$3" -o points.mrs && case_of "$1"
}
data bunny-0.5-5 meshes/bunny00.off.gz points/bunny_noise0.5pct_outliers5pct.xyz.gz
data elephant-1-20 meshes/elephant.off points/elephant_noise1pct_outliers20pct.xyz
if [ -f "$DATA/meshes/armadillo.off.gz" ]; then
	mr-import "$DATA/meshes/armadillo.off.gz" -o truth.mrs && dirty truth.mrs 0.003 0.05 && case_of armadillo-0.3-5
fi
