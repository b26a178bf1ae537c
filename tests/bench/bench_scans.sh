# Reconstruct clouds whose surface is known, of every closed model, as somebody would who is new to the tools, and judge what
# comes out by scan_yardstick.c, which says what the kinds of clouds are: a row each, then how many have the right topology.
# Warnings are those of all tools from mr-shrinkwrap to mr-decode but that outliers are left out, which says nothing of the surface.
# Knobs: MODELS (patterns of names in $DATA/meshes, default all; without that directory, shapes of mr-make), KINDS (of clouds),
# SEEDS (of each kind but vertices), LIMIT (seconds that the pipe may take), JOBS (clouds at a time), PEERS (cgal, its advancing
# front; open3d, its Poisson with normals of its own; default both, as far as they are there).  Rows and results are kept in
# $BUILD/scans, and done again only by newer tools; the *.png there show all results, what is far off or passes through itself in
# red.
. "$TOP/tests/bench/common.sh"
export out=$BUILD/scans LIMIT="${LIMIT:-300}"
KINDS=${KINDS:-vertices uniform noise03 noise1 outliers holes density views cut terrain near}

# ---- one cloud: bench_scans.sh --one MODEL KIND SEED ----

judge() { # name, kind, seed, result: its row, by $code, $seconds and err
	warned=$(sed -n -e '/outliers.* left out/d' -e 's/^mr-\([a-z]*\): .*warning: .*/\1/p' err | uniq | paste -sd , -)
	{
		printf '%s\t%s\t%s\t%s\t%s\t%s\t' "$1" "$2" "$3" "$code" "${warned:--}" "$seconds"
		if [ "$code" = 0 ]; then
			scan_yardstick judge truth.mrs points.mrs "$4" "$out/results/$2/$1-$2-$3" 2>&1
		else
			[ "$code" = 124 ] && echo "more than $LIMIT s" || echo "$(grep -v 'warning: ' err | head -n 1 | cut -c 1-200)"
		fi
	} >"$out/rows/$1-$2-$3"
}
run_peer() { # peer
	case $1 in
	cgal) timed 'peer_reconstruct front points.xyz peer.off >/dev/null' ;;
	open3d) timed '"$OPEN3D" "$TOP/tests/bench/peer_open3d.py" points.xyz peer.off >/dev/null' ;;
	esac
}
one() { # name, kind, seed
	mkdir -p "$out/work/$1-$2-$3" && cd "$out/work/$1-$2-$3" || exit
	scan_yardstick cloud "$2" "$3" "$out/models/$1.mrs" points.mrs truth.mrs || exit
	if is_old "$out/rows/$1-$2-$3" "$BUILD/bin" "$BUILD/bench/scan_yardstick"; then
		timed 'mr-shrinkwrap points.mrs | mr-simplify | mr-fit | mr-sample | mr-decode -o result.mrs'
		judge "$1" "$2" "$3" result.mrs
	fi
	for peer in $PEERS; do
		is_old "$out/rows/$1-$2-$peer-$3" "$BUILD/bench/scan_yardstick" || continue
		[ -e points.xyz ] || mr-export -l points -i points.mrs points.xyz || exit
		run_peer "$peer"
		judge "$1" "$2-$peer" "$3" peer.off
	done
	rm -rf "$out/work/$1-$2-$3"
}
if [ "$1" = --one ]; then
	one "$2" "$3" "$4"
	exit
fi

# ---- all of them ----

OPEN3D=$(python_of_open3d) PEERS=${PEERS-cgal open3d}
[ -n "$OPEN3D" ] || PEERS=$(echo "$PEERS" | sed 's/open3d//')
[ -x "$BUILD/bench/peer_reconstruct" ] || PEERS=$(echo "$PEERS" | sed 's/cgal//')
export OPEN3D PEERS
rows= # what there is a row of
for kind in $KINDS; do
	for who in "" $PEERS; do
		rows="$rows $kind${who:+-$who}"
	done
done
mkdir -p "$out/rows" "$out/models"
for row in $rows; do
	mkdir -p "$out/results/$row"
done
every_model sphere torus cube knot bumpy boxes >files
while read -r file; do
	sound_model "$file" '"oriented":true' '"manifold":true' '"boundary_edges":0' '"intersecting_pairs":0'
done <files >names
[ -s names ] || { echo "no closed model in $DATA/meshes is called $MODELS" >&2; exit 1; }
for name in $(cat names); do
	for kind in $KINDS; do
		[ $kind = vertices ] && echo "$name" $kind 1 && continue
		for seed in ${SEEDS:-1}; do
			echo "$name" $kind "$seed"
		done
	done
done >cases
xargs -P "${JOBS:-2}" -n 3 sh "$0" --one <cases || exit
while read -r name kind seed; do
	for who in "" $PEERS; do
		cat "$out/rows/$name-$kind${who:+-$who}-$seed"
	done
done <cases >rows
awk -F '\t' -v kinds="$rows" '
	function figure(name) { # of the JSON, the last field
		return match($7, "\"" name "\":[^,}]*") ? substr($7, RSTART + length(name) + 3, RLENGTH - length(name) - 3) : "-"
	}
	function both(name) {
		return figure(name) + figure(name "_control")
	}
	function share(x) {
		return sprintf("%.3g", 100 * x)
	}
	BEGIN {
		print "Euler number, components, loops: truth, result; thin: 1 % of body and gaps, in spacings; distances in % of the diagonal:"
		print "points to result, truth to result, result to truth, mean and max; of result and control mesh: folds, pairs that"
		print "intersect; of the control mesh: faces, edges bent by over 90 degrees, angles below 20 (%)"
		printf "%-30s %-15s %s %4s %-12s %-24s %5s %-12s %-12s %-12s %6s %6s %6s %6s %6s %7s\n", "model", "cloud", "#", "exit", "warned",
		    "topology", "thin", "gap", "from truth", "to truth", "folds", "pairs", "faces", "bent", "acute", "seconds"
	}
	{ clouds[$2]++; seconds[$2] += $6 }
	$4 != 0 || $7 !~ /^{/ {
		refused[$2]++
		printf "%-30s %-15s %s %4s %-12s %s\n", $1, $2, $3, $4, $5, $7
		next
	}
	{
		right = figure("right") + 0
		thick = figure("thin") + 0 >= 2
		printf "%-30s %-15s %s %4s %-12s %-24s %5.1f %-12s %-12s %-12s %6d %6d %6d %6.2f %6.2f %7.2f%s\n", $1, $2, $3, $4, $5,
		    figure("euler_truth") " " figure("components_truth") " " figure("loops_truth") ", " figure("euler") " " \
		    figure("components") " " figure("loops"), figure("thin"),
		    share(figure("points_to_result_mean")) " " share(figure("points_to_result_max")),
		    share(figure("truth_to_result_mean")) " " share(figure("truth_to_result_max")),
		    share(figure("result_to_truth_mean")) " " share(figure("result_to_truth_max")),
		    both("folds"), both("pairs"), figure("faces_control"), 100 * figure("bent_control"), 100 * figure("acute_control"),
		    $6, right ? "" : $5 == "-" && $2 !~ /-/ ? " WRONG, SILENT" : " wrong"
		made[$2]++
		good[$2] += right
		silent[$2] += !right && $5 == "-"
		idle[$2] += right && $5 != "-"
		thicks[$2] += thick
		thick_good[$2] += thick && right
		from[$2] += figure("truth_to_result_mean")
		to[$2] += figure("result_to_truth_mean")
		pairs[$2] += both("pairs") > 0
		bent[$2] += figure("bent_control")
		acute[$2] += figure("acute_control")
	}
	END {
		n = split(kinds, kind, " ")
		for (i = 1; i <= n; i++) {
			k = kind[i]
			m = made[k] ? made[k] : 1
			printf "%s: %d clouds, %d refused; topology right %d, of the thick ones %d of %d; wrong in silence %d; warned of %d that are right; ",
			    k, clouds[k], refused[k], good[k], thick_good[k], thicks[k], silent[k], idle[k]
			printf "from truth %.3f %%, to truth %.3f %%; %d intersect; bent %.2f %%, acute %.1f %%; %.0f s\n",
			    100 * from[k] / m, 100 * to[k] / m, pairs[k], 100 * bent[k] / m, 100 * acute[k] / m, seconds[k]
			split(k "-mr", who, "-")
			printf "%s-wrong %s %d clouds\n", who[1], who[2], made[k] - good[k]
			if (who[2] == "mr")
				printf "%s-silent mr %d clouds\n", k, silent[k]
		}
	}' rows | tee table
for row in $rows; do
	awk -v row="$row" 'index(row "-", $2 "-") == 1 { print $1 "-" row "-" $3 }' cases | sheets "$row"
done
echo "all results: $out/*.png"
