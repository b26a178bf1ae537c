# How the reconstruction of a cloud looks whose surface is known, of every model that is a surface, beside Open3D's
# Poisson of depth 9: look_yardstick.c says what the figures are, scan_yardstick.c what the kinds of clouds.  A row each,
# then geometric means and the worst models; of each kind, where normals are off by over 30 degrees most: truth, ours and
# peer from close by.  Of `vertices` are models whose edges are about equally long, so that they sample the surface.
# Knobs: MODELS (patterns of names in $DATA/meshes, default all; without that directory, shapes of mr-make), KINDS (of
# clouds), LIMIT (seconds that a pipe or a peer may take), JOBS (clouds at a time), PEERS (true, own: whose normals
# Poisson gets; default both).  Rows and close-ups are kept in $BUILD/look; newer tools do ours again, newer yardsticks all.
# The peer has one thread, as its threads wait busily: five to ten times the work where the machine does something else.
. "$TOP/tests/bench/common.sh"
export out=$BUILD/look LIMIT="${LIMIT:-300}"
KINDS=${KINDS:-vertices uniform noise02 noise05}

# ---- one cloud: bench_look.sh --one MODEL KIND ----

judge() { # model, kind, who, surface: its row, by $code and $seconds, and its close-up where ours is worst
	{
		printf '%s\t%s\t%s\t%s\t' "$1" "$2" "$3" "$seconds"
		[ "$code" = 0 ] && look_yardstick judge truth.mrs "$4" 2>&1 ||
		    echo "failed: $code $(grep -v 'warning: ' err | head -n 1)"
	} >"$out/rows/$1-$2-$3"
	close "$1" "$2" "$3" "$4"
}
close() { # model, kind, who, surface
	place=$(sed -n 's/.*"place":"\([^"]*\)".*/\1/p' "$out/rows/$1-$2-mr")
	[ -z "$place" ] || [ ! -e "$4" ] || look_yardstick close "$4" "$place" "$out/close/$1-$2-$3"
}
one() { # model, kind
	mkdir -p "$out/work/$1-$2" && cd "$out/work/$1-$2" || exit
	scan_yardstick cloud "$2" 1 "$out/models/$1.mrs" points.mrs truth.mrs || exit
	yardsticks="$TOP/tests/bench/look_yardstick.c $TOP/tests/bench/scan_yardstick.c"
	if is_old "$out/rows/$1-$2-mr" "$BUILD/bin" $yardsticks; then
		timed 'mr-shrinkwrap -q points.mrs | mr-simplify -q | mr-fit -q | mr-sample -q | mr-decode -q -o result.mrs'
		judge "$1" "$2" mr result.mrs
		close "$1" "$2" truth truth.mrs
	fi
	for peer in $PEERS; do
		is_old "$out/rows/$1-$2-$peer" $yardsticks || continue
		[ -e points.xyz ] || look_yardstick normals truth.mrs points.mrs points.xyz || exit
		normals=
		[ "$peer" = own ] || normals=--normals
		timed 'OMP_NUM_THREADS=1 "$OPEN3D" "$TOP/tests/bench/peer_open3d.py" --depth 9 --clean '"$normals"' points.xyz peer.ply >out'
		judge "$1" "$2" "$peer" peer.ply
	done
	rm -rf "$out/work/$1-$2"
}
if [ "$1" = --one ]; then
	one "$2" "$3"
	exit
fi

# ---- all of them ----

# Its share of edges at a boundary is below a tenth, so it is no heap of leaves; its vertices sample it.
is_surface() { # JSON, kind
	sed 's/[,{]/\n/g' "$1" | awk -F : -v kind="$2" '
		{ gsub(/"/, "", $1); is[$1] = $2 }
		END {
			exit !(is["faces"] > 0 && is["vertices"] <= 300000 && is["boundary_edges"] < 0.1 * is["edges"] &&
			    (kind != "vertices" || is["vertices"] >= 2000 && is["edge_deviation"] < 0.9 * is["edge_mean"]))
		}'
}
started=$(date +%s)
OPEN3D=$(python_of_open3d) PEERS=${PEERS-true own}
[ -n "$OPEN3D" ] || { PEERS= && echo "bench_look: without Open3D: tests/bench/README.md says how to get it" >&2; }
export OPEN3D PEERS
mkdir -p "$out/rows" "$out/models" "$out/close"
every_model sphere torus cube knot bumpy boxes >files
while read -r file; do
	sound_model "$file" '"oriented":true' '"manifold":true'
done <files >names
for kind in $KINDS; do
	for name in $(cat names); do
		! is_surface "$out/models/$name.json" "$kind" || echo "$name $kind"
	done
done >cases
[ -s cases ] || { echo "no surface in $DATA/meshes is called $MODELS" >&2; exit 1; }
xargs -P "${JOBS:-2}" -n 2 sh "$0" --one <cases || exit
while read -r name kind; do
	for who in mr $PEERS; do
		cat "$out/rows/$name-$kind-$who"
	done
done <cases >rows
awk -F '\t' -v kinds="$KINDS" -v peers="$PEERS" '
	function figure(name) { # of the JSON, the last field
		return match($5, "\"" name "\":[^,}]*") ? substr($5, RSTART + length(name) + 3, RLENGTH - length(name) - 3) : ""
	}
	function add(kind, name, ratio) { # of ours to something
		for (i = 1; i <= 2; i++) {
			of = i == 1 ? kind : "all"
			sum[of, name] += log(ratio)
			count[of, name]++
		}
		ratios[kind, name, $1] = ratio
	}
	function print_worst(kind, name, n,  k, m, best, line) {
		for (k = 0; k < n; k++) {
			best = ""
			for (m in models)
				if ((kind, name, m) in ratios && (best == "" || ratios[kind, name, m] > ratios[kind, name, best]))
					best = m
			if (best == "")
				break
			line = line sprintf("%s%s %.2f", k ? ", " : "", best, ratios[kind, name, best])
			delete ratios[kind, name, best]
		}
		print "  worst: " line
	}
	function floor_of(x, least) {
		return x + 0 > least ? x + 0 : least
	}
	BEGIN {
		print "normals off the truth, degrees: mean, 95 %, share over 30 (%); edges bent by over 60 degrees, per thousand:"
		print "result, truth; mean distances to the truth and from it, % of the diagonal; heights: deviation, bits a vertex"
		printf "%-34s %-9s %-5s %6s %6s %6s %7s %7s %7s %7s %7s %5s %7s\n", "model", "cloud", "who", "mean", "95 %",
		    "over", "bent", "truth", "to", "from", "height", "bits", "seconds"
	}
	$5 !~ /^{/ {
		printf "%-34s %-9s %-5s %s\n", $1, $2, $3, $5
		failed[$2, $3]++
		next
	}
	{
		printf "%-34s %-9s %-5s %6.2f %6.2f %6.2f %7.2f %7.2f %7.4f %7.4f %7s %5s %7.2f\n", $1, $2, $3, figure("mean"),
		    figure("high"), 100 * figure("over"), 1000 * figure("bent"), 1000 * figure("bent_truth"), 100 * figure("to"),
		    100 * figure("from"),
		    figure("heights") == "" ? "-" : sprintf("%.4f", 100 * figure("heights")),
		    figure("entropy") == "" ? "-" : sprintf("%.2f", figure("entropy")), $4
		models[$1]
		seconds[$2, $3] += $4
		mean = floor_of(figure("mean"), 0.01)
		over = floor_of(figure("over"), 1e-4)
		made[$2, $3]++
		means[$2, $3] += log(mean)
		overs[$2, $3] += log(over)
		bents[$2, $3] += log(floor_of(figure("bent"), 1e-4))
		tos[$2, $3] += log(floor_of(figure("to"), 1e-6))
		froms[$2, $3] += log(floor_of(figure("from"), 1e-6))
		bits[$2, $3] += figure("entropy")
		heights[$2, $3] += log(floor_of(figure("heights"), 1e-7))
	}
	$3 == "mr" {
		our_mean[$1, $2] = mean
		our_over[$1, $2] = over
		add($2, "bent", floor_of(figure("bent"), 1e-4) / floor_of(figure("bent_truth"), 1e-4))
	}
	$3 != "mr" && ($1, $2) in our_mean {
		add($2, "mean-" $3, our_mean[$1, $2] / mean)
		add($2, "over-" $3, our_over[$1, $2] / over)
	}
	END {
		ns = split("mean-true over-true mean-own over-own bent", names, " ")
		what["mean"] = "mean error of normals to Poisson'"'"'s"
		what["over"] = "share over 30 degrees to Poisson'"'"'s"
		what["bent"] = "bent edges to the truth'"'"'s"
		nk = split(kinds, kind, " ")
		nw = split("mr " peers, who, " ")
		print "geometric means (a share over 30 is at least 0.01 %, bent edges 0.1 per thousand):"
		for (k = 1; k <= nk; k++)
			for (w = 1; w <= nw; w++) {
				c = kind[k]
				m = made[c, who[w]]
				if (!m)
					continue
				printf "%-9s %-5s %d models, %d failed: mean %.2f, over 30 %.3f %%, bent %.2f, to %.4f %%, from %.4f %%",
				    c, who[w], m, failed[c, who[w]], exp(means[c, who[w]] / m), 100 * exp(overs[c, who[w]] / m),
				    1000 * exp(bents[c, who[w]] / m), 100 * exp(tos[c, who[w]] / m), 100 * exp(froms[c, who[w]] / m)
				if (w == 1)
					printf ", heights %.4f %%, %.2f bits", 100 * exp(heights[c, "mr"] / m),
					    bits[c, "mr"] / m
				printf "; %.0f s\n", seconds[c, who[w]]
			}
		for (k = 1; k <= nk + 1; k++)
			for (j = 1; j <= ns; j++) {
				c = k > nk ? "all" : kind[k]
				if (!count[c, names[j]])
					continue
				split(names[j], part, "-")
				printf "%-9s ours, %s%s: %.2f\n", c, what[part[1]], part[2] ? " with " part[2] " normals" : "",
				    exp(sum[c, names[j]] / count[c, names[j]])
				if (k <= nk)
					print_worst(c, names[j], 5)
			}
	}' rows | tee "$out/table"

# Close-ups.  A peer that is looked at has to look where ours is worst now.
worst() { # kind
	awk -F '\t' -v kind="$1" '
		$2 == kind && $3 == "mr" && match($5, /"over":[^,]*/) { print substr($5, RSTART + 7, RLENGTH - 7), $1 }' rows |
	    sort -rg | head -n 16 | cut -d ' ' -f 2
}
peer=$(echo "$PEERS" | awk '{ print $1 }')
export PEERS="$peer"
columns=4 # two models side by side
[ -z "$peer" ] || columns=6
for kind in $KINDS; do
	for name in $(worst "$kind"); do
		[ -z "$peer" ] || ! is_old "$out/close/$name-$kind-$peer" "$out/close/$name-$kind-mr" ||
		    rm -f "$out/rows/$name-$kind-$peer"
		sh "$0" --one "$name" "$kind"
		for who in truth mr $peer; do
			echo "$out/close/$name-$kind-$who"
		done
	done >sheet
	[ -s sheet ] || continue
	mr-cat $(cat sheet) | mr-render -q --sheet --same --columns $columns --size 420x420 --view front "$out/$kind.png"
done
echo "close-ups of truth, ours and peer: $out/*.png; all in $(($(date +%s) - started)) s"
