#!/bin/sh
# table1.sh -- the paper's Table 1 (Botsch, Kobbelt 2004): set-up and three solutions of a thin plate by every solver;
# usage: table1.sh DIR.  Leaves table1.txt, which is printed, and table1.png in DIR.
# Knobs: SIZES, free vertices in thousands; TOL, the relative residual of iterative solvers; SLOW, the thousands up to which
# plain CG runs.
set -e
dir=$1
sizes=${SIZES:-15 31 150 500 1000}
tol=${TOL:-1e-8}
slow=${SLOW:-31}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
mkdir -p "$dir"
dir=$(cd "$dir" && pwd)
cd "$work"

figure() { # name: a number of the last line of stats.json; 0 where there is none
	sed -n '$s/.*"'"$1"'":\([^,}]*\).*/\1/p' stats.json | grep . || echo 0
}

# Free thousands, solver, free, set-up, three solutions, iterations, residual, error of the diagonal, megabytes.
row() { # thousands, solver, its options
	label=$2 size=$1
	shift 2
	if mr-solve "$@" --stats stats.json posed.mrs -o out.mrs 2>error; then
		error=-
		[ ! -f direct.mrs ] || error=$(mr-compare --json -a base -b base direct.mrs <out.mrs |
		    sed 's/.*"vertex_max_relative":\([^,}]*\).*/\1/')
		echo "$size $label $(figure free) $(awk "BEGIN { print $(figure seconds_assemble) + $(figure seconds_analyse) + $(figure seconds_factor) }")" \
		    "$(figure seconds_solve) $(figure iterations) $(figure residual) $error $(awk "BEGIN { print $(figure peak_bytes) / 1e6 }")"
	else
		echo "$size $label: $(cat error)" >&2
	fi
}

for size in $sizes; do
	rm -f direct.mrs
	mr-make torus -n $((size * 1065)) | mr-smooth -t 0 |
	    mr-select --free all --fixed below:x,0.05 --handle 0=above:x,0.95 |
	    mr-pose --translate 0,0,0.2 -o posed.mrs
	row $size cholesky -s cholesky --memory "${MEMORY:-0}"
	[ ! -f out.mrs ] || mv out.mrs direct.mrs
	row $size multigrid -s multigrid --tol "$tol"
	row $size vcycle -s vcycle --tol "$tol"
	[ $size -gt $slow ] || row $size cg -s cg --tol "$tol"
done >rows

# What remeshing does to the system: before, on the smoothed model as it came, and after.
worth() { # model; selected.mrs
	for k in 1 2 3; do
		mr-solve -k $k --flatten --stats stats.json selected.mrs -o out.mrs || return
		echo "$1 $2 $k $(figure negative_weights) $(figure rcond | awk '{ print $1 > 0 ? 1 / $1 : 0 }')"
	done
}
models() {
	mr-make bumpy -n 20000 --noise 0.002 -o bumpy.mrs
	echo bumpy.mrs
	for file in bunny00.off.gz armadillo.off.gz lion-head.off.gz; do
		[ ! -f "$DATA/meshes/$file" ] || echo "$DATA/meshes/$file"
	done
}
for file in $(models); do
	name=$(basename "$file" | sed 's/\..*//')
	case $file in
	*.mrs) cat "$file" ;;
	*) mr-import "$file" ;;
	esac | mr-smooth | mr-select --free all --fixed below:y,0.2 --handle 0=above:y,0.8 -o selected.mrs
	worth "$name" before
	mr-remesh selected.mrs -o remeshed.mrs && mv remeshed.mrs selected.mrs
	worth "$name" after
done >worths

{
	echo "A thin plate: seconds to set up and for three right-hand sides, to a relative residual of $tol; the largest"
	echo "difference from the direct solution, of the diagonal; the most memory of the process."
	awk 'BEGIN { printf "%8s %-18s %9s %11s %11s %10s %10s %8s\n", "free", "solver", "set-up", "solutions", "iterations", "residual", "error", "MB" }
		{ printf "%8d %-18s %9.3f %11.4f %11s %10.1e %10s %8.0f\n", $3, $2, $4, $5, $6 ? $6 : "", $7,
			$8 == "-" ? "-" : sprintf("%.1e", $8), $9 }' rows
	echo
	echo "Three solutions, of the time of the direct solver's (the paper: iterative 106 and 160, multigrid 11 and 12, at 15k and 31k)"
	awk '$2 == "cholesky" { direct[$1] = $5; next }
		$1 in direct { printf "%8d %-18s %9.1f\n", $3, $2, $5 / direct[$1] }' rows
	echo
	echo "Time of three solutions against size: exponent of the least squares line"
	awk '{ n[$2]++; x = log($3); y = log($5); sx[$2] += x; sy[$2] += y; sxx[$2] += x * x; sxy[$2] += x * y }
		END { for (s in n) if (n[s] > 1) printf "%-18s %6.2f\n", s,
			(n[s] * sxy[s] - sx[s] * sy[s]) / (n[s] * sxx[s] - sx[s] * sx[s]) }' rows | sort
	echo
	echo "Remeshing: edges with a negative cotangent weight, and the condition number (of the factor, by CHOLMOD), before and after"
	awk 'BEGIN { printf "%-10s %2s %10s %10s %10s %10s\n", "model", "k", "negative %", "after %", "condition", "after" }
		$2 == "before" { negative[$1, $3] = $4; condition[$1, $3] = $5; next }
		{ printf "%-10s %2d %10.3f %10.3f %10.1e %10.1e\n", $1, $3, 100 * negative[$1, $3], 100 * $4, condition[$1, $3], $5 }' worths
} >"$dir/table1.txt"
cat "$dir/table1.txt"
awk '{ print $2, $3, $5 }' rows | plot "$dir/table1.png" 'Thin plate: three solutions' 'free vertices' 'seconds'
