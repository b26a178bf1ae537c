# Bend, twist and pull every model, as somebody would who is new to the tools, and judge what comes out by edit_yardstick.c: a
# row each, then how many are wrecked.  Warnings are those of all tools from mr-smooth to mr-decode.
# Knobs: MODELS (patterns of names in $DATA/meshes, default all; without that directory, shapes of mr-make), LIMIT (seconds that
# the pipe may take to the posing, and from there), JOBS (models at a time).  Rows and results are kept in $BUILD/edits, and done
# again only by newer tools; the *.png there show all results, what is folded or passes through itself in red.
. "$TOP/tests/bench/common.sh"
out=$BUILD/edits edits='bend twist pull'

# ---- one model: bench_edits.sh --one FILE ----

timed() { # name, command line: leaves NAME.err, NAME.code, NAME.seconds
	begin=$(date +%s.%N)
	timeout -k 5 "$LIMIT" sh -c "$2" 2>"$1.err"
	echo $? >"$1.code"
	echo "$(date +%s.%N) $begin" | awk '{ print $1 - $2 }' >"$1.seconds"
}
row() { # edit, file with the code, files of messages: what of the pipe the row begins with
	edit=$1 code=$(cat "$2")
	shift 2
	warned=$(cat "$@" | sed -n 's/^mr-\([a-z]*\): .*warning: .*/\1/p' | uniq | paste -sd , -)
	printf '%s\t%s\t%s\t%s\t%s\t' "$name" "$edit" "$code" "${warned:--}" "$(cat ./*.seconds | awk '{ s += $1 } END { print s }')"
}
sentence() { # file with the code, file of messages: what was first said
	[ "$(cat "$1")" != 124 ] && grep -v 'warning: ' "$2" | head -n 1 | cut -c 1-200 || echo "more than $LIMIT s"
}
refused() { # name of the part that failed
	for edit in $edits; do
		{ row "$edit" "$1.code" ./*.err; sentence "$1.code" "$1.err"; } >"$out/rows/$name-$edit"
	done
}
judge() { # edit
	timed 3-pose "mr-pose $(sed -n 2p options) rest.mrs | mr-solve | mr-decode -o after.mrs"
	row "$1" 3-pose.code 2-rest.err 3-pose.err >row
	[ "$(cat 3-pose.code)" = 0 ] && edit_yardstick "$1" before.mrs after.mrs "$out/results/$1/$name" >json 2>>3-pose.err ||
	    sentence 3-pose.code 3-pose.err >json
	cat row json >"$out/rows/$name-$1"
}
one() { # file
	name=$(basename "$1" .gz)
	if [ -e "$out/rows/$name-pull" ] && [ -z "$(find "$BUILD/bin" "$BUILD/bench/edit_yardstick" -newer "$out/rows/$name-pull")" ]; then
		return
	fi
	rm -f "$out"/results/*/"$name"
	mkdir -p "$out/work/$name" && cd "$out/work/$name" || exit
	timed 1-import "mr-import -q --repair '$1' -o before.mrs && edit_yardstick --options bend before.mrs >options"
	[ "$(cat 1-import.code)" = 0 ] || { refused 1-import; return; }
	timed 2-rest "mr-smooth before.mrs | mr-remesh | mr-select --reset $(sed -n 1p options) | mr-encode -o rest.mrs"
	[ "$(cat 2-rest.code)" = 0 ] || { refused 2-rest; return; }
	for edit in $edits; do
		edit_yardstick --options $edit before.mrs >options && judge $edit
	done
}
export LIMIT="${LIMIT:-300}"
if [ "$1" = --one ]; then
	one "$2"
	rm -rf "$out/work/$(basename "$2" .gz)"
	exit
fi

# ---- all of them ----

for edit in $edits; do
	mkdir -p "$out/rows" "$out/results/$edit"
done
every_model sphere torus cube plane cylinder knot bumpy boxes >models
[ -s models ] || { echo "no model in $DATA/meshes is called $MODELS" >&2; exit 1; }
xargs -P "${JOBS:-2}" -n 1 sh "$0" --one <models || exit
sed 's/.*\///; s/\.gz$//' models >names
for model in $(cat names); do
	for edit in $edits; do
		cat "$out/rows/$model-$edit"
	done
done >rows
awk -F '\t' '
	function figure(name) { # of the JSON, the last field
		return match($6, "\"" name "\":[^,}]*") ? substr($6, RSTART + length(name) + 3, RLENGTH - length(name) - 3) : "-"
	}
	function two(name, scale) {
		return sprintf("%.3g %.3g", scale * figure(name "_warp"), scale * figure(name))
	}
	BEGIN {
		print "folds, near pairs: before, warp, result; edges off by over 2x (%), mean |log2| of edges, volume: warp, result;"
		print "astray: vertices of the fixed and the moved fifth that are not where they belong (%);"
		print "left: parts in between that stay behind; apart: vertices that touched other parts and do not any more"
		printf "%-32s %-5s %4s %-12s %-13s %-17s %-12s %-12s %-12s %6s %4s %5s %8s\n", "model", "edit", "exit", "warned",
		    "folds", "near pairs", "off %", "edges", "volume", "astray", "left", "apart", "seconds"
	}
	$3 != 0 || $6 !~ /^{/ {
		refused[$2]++
		printf "%-32s %-5s %4s %-12s %s\n", $1, $2, $3, $4, $6
		next
	}
	{
		wrecked = figure("wrecked") + 0
		printf "%-32s %-5s %4s %-12s %-13s %-17s %-12s %-12s %-12s %6.1f %4d %5d %8.2f%s\n", $1, $2, $3, $4,
		    figure("folds_before") " " figure("folds_warp") " " figure("folds"),
		    figure("near_pairs_before") " " figure("near_pairs_warp") " " figure("near_pairs"),
		    two("off", 100), two("edge_log2", 1), figure("volume") == "null" ? "open" : two("volume", 1),
		    100 * figure("astray"), figure("parts_left"), figure("apart"), $5,
		    wrecked ? " wrecked" : ""
		edited[$2]++
		count[$2] += wrecked
		silent[$2] += wrecked && $4 == "-"
		idle[$2] += !wrecked && $4 != "-"
		astray[$2] += figure("astray") + 0 > 0.05
		left[$2] += figure("parts_left") + 0 > 0
		touching[$2] += figure("touching")
		apart[$2] += figure("apart")
		folds[$2] += figure("folds_more")
		pairs[$2] += figure("pairs_more")
	}
	END {
		n = split("bend twist pull", edit, " ")
		for (i = 1; i <= n; i++) {
			e = edit[i]
			printf "%s: %d edited, %d refused; wrecked %d, %d of them in silence; warned of %d that are not; ", e,
			    edited[e], refused[e], count[e], silent[e], idle[e]
			printf "more than the warp: %d folds, %d near pairs; %d astray by over 5 %%, %d leave parts behind; ",
			    folds[e], pairs[e], astray[e], left[e]
			printf "%d of %d vertices that touched came apart\n", apart[e], touching[e]
			printf "%s-wrecked mr %d models\n%s-silent mr %d models\n", e, count[e], e, silent[e]
		}
	}' rows | tee table
for edit in $edits; do
	sheets $edit <names
done
echo "all results: $out/*.png"
