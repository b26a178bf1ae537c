#!/bin/sh
# reconstruct.sh -- scans become displaced subdivision surfaces, and are edited as such; usage: reconstruct.sh [DIR]
#
# Leaves in DIR (default demo): NAME-scan.png for each scan, the cloud, its wrap, the control mesh, the domain
# surface, the result, the result edited, and five levels of detail; NAME.ply, the result; scans/NAME.mrs, the same as
# a stream, with the cloud and the control mesh; and clouds.txt, the table that is printed.
# Of the models of demo.sh; where these cannot be had, of points of a creature.
set -e
here=$(cd "$(dirname "$0")" && pwd)
dir=${1:-demo}
rm -rf "$dir/work" "$dir/scans"
mkdir -p "$dir/scans" "$dir/work"
cd "$dir"
panel=${MR_SMALL:+120x100}
panel=${panel:-420x400}

. "$here/models.sh"

# The number that a JSON file has under a key; of several, that of the first.
figure() { # file, key
	sed -n 's/.*"'"$2"'":\([^,}]*\).*/\1/p' "$1" | head -n 1
}
gap() { # stream: largest and mean distance from the points to the mesh, of the diagonal
	mr-compare --json -a points -b mesh <"$1" | sed 's/.*"a_to_b_relative":{\([^}]*\)}.*/\1/' >work/gap
	echo "$(figure work/gap max) $(figure work/gap mean)"
}

row() { # scan: one line of the table
	mr-info --json -l mesh <$w.result.mrs >$w.info
	echo "$1 $(figure $w.2 places) $(figure $w.3 faces) $(figure $w.info vertices) $(figure $w.info genus)" \
	    "$(gap $w.domain.mrs) $(gap $w.result.mrs) $(figure $w.5 tries_1)" \
	    "$(figure $w.5 tries_4) $(figure $w.5 tries_10)" \
	    "$(for n in 2 3 4 5 6; do figure $w.$n seconds; done | awk '{ s += $1 } END { print s }')" >>work/scans
}

pictures() { # scan, view
	mkdir -p $w
	mr-export -l points $w/cloud.ply <$w.wrapped.mrs
	mr-export -l control $w/wrap.ply <$w.wrapped.mrs
	mr-export -l control $w/control.ply <$w.displaced.mrs
	mr-export -l mesh $w/domain.ply <$w.domain.mrs
	mr-export -l mesh $w/result.ply <$w.result.mrs
	mr-export -l mesh $w/edited.ply <$w.edited.mrs
	mr-sample -n 4 <$w.displaced.mrs >$w.levels.mrs
	for level in 0 1 2 3 4; do
		mr-decode --level $level <$w.levels.mrs | mr-export -l mesh $w/level-$level.ply
	done
	mr-import $w/cloud.ply $w/wrap.ply $w/control.ply $w/domain.ply $w/result.ply $w/edited.ply $w/level-?.ply |
	    mr-render --sheet --columns 6 --size $panel --view "$2" "$1-scan.png"
}

# One scan, one pipe; then an edit of what came out: the control mesh moves, the scanned detail stays on it.
scan() { # name, view, regions, pose
	echo "$1"
	w=work/$1-scan
	mr-import --points "$(cloud "$1")" --stats $w.1 |
	    mr-shrinkwrap --stats $w.2 | tee $w.wrapped.mrs |
	    mr-simplify --stats $w.3 |
	    mr-fit --stats $w.4 |
	    mr-sample --stats $w.5 | tee $w.displaced.mrs |
	    mr-decode --stats $w.6 | tee $w.result.mrs |
	    mr-export "$1.ply"
	mr-decode --gain 0 <$w.displaced.mrs >$w.domain.mrs
	mr-select $3 <$w.displaced.mrs | mr-pose $4 | mr-solve | mr-decode >$w.edited.mrs
	pictures "$1" "$2"
	row "$1"
	mr-cat -z -o "scans/$1.mrs" $w.result.mrs
}

if [ -n "$real" ]; then
	scan kitten front '--free above:y,0.3 --handle 0=above:y,0.75' '--rotate 0,0,1,25'
	scan bunny00 front '--free above:y,0.45 --handle 0=above:y,0.7' '--rotate 0,0,1,-25'
	scan armadillo front '--free above:y,0.3 --handle 0=above:y,0.65' '--rotate 0,1,0,50'
else
	scan creature front '--free above:y,0.3 --handle 0=above:y,0.8' '--rotate 0,0,1,30'
fi

{
	echo
	echo "Displaced subdivision surfaces from points alone: distance from the points to the surface, of the diagonal, without"
	echo "and with displacement; vertices that find their triangle at the first try, by the fourth, and within ten"
	awk 'BEGIN { printf "%-10s %7s %7s %8s %5s %10s %9s %10s %9s %6s %6s %6s %8s\n",
		"scan", "points", "control", "vertices", "genus",
		"domain max", "mean %", "result max", "mean %", "1", "4", "10", "seconds" }
		{ printf "%-10s %7d %7d %8d %5d %10.3f %9.4f %10.3f %9.4f %6.1f %6.1f %6.1f %8.3f\n",
			$1, $2, $3, $4, $5, 100 * $6,
		100 * $7, 100 * $8, 100 * $9, 100 * $10, 100 * $11, 100 * $12, $13 }' work/scans
} | tee work/clouds.txt
mv work/clouds.txt clouds.txt
rm -r work
