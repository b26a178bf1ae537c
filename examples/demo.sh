#!/bin/sh
# demo.sh -- the main job on real models: bend, twist, pull and scale them with their detail kept; usage: demo.sh [DIR]
#
# Leaves in DIR (default demo): NAME.png, a row of pictures for each edit, NAME.obj, its result, sheet.png, all of them,
# edits/NAME.mrs, the model as a stream whose handles can be dragged in a page, edits/NAME.posed.mrs, the result as one,
# frames/1.png to 61.png, an animation, textured.png and textured.glb, a creature that wears a picture, and figures.txt,
# the tables that are printed.
# The models are those of Debian's package libcgal-demo, which is fetched, and five of them unpacked into DIR/cache, not
# installed.  Where it cannot be had, a creature that mr-make makes is edited.  MR_SMALL=N does that with N vertices.
set -e
here=$(cd "$(dirname "$0")" && pwd)
dir=${1:-demo}
rm -rf "$dir/work" "$dir/edits"
mkdir -p "$dir/cache" "$dir/frames" "$dir/edits" "$dir/work/parts"
cd "$dir"
panel=${MR_SMALL:+120x100}
panel=${panel:-420x400}

. "$here/models.sh"

# The number that a JSON file has under a key; of several, that of the last.
figure() { # file, key
	sed -n 's/.*"'"$2"'":\([^,}]*\).*/\1/p' "$1" | head -n 1
}
info() { # stream, layer
	mr-info --json --no-intersections -l "$2" <"$1"
}

# What the remeshing did, once a model; what was lost, and how long each step took, for each edit.
figures() { # model
	info $w.smooth.mrs base >$w.before
	info $w.remeshed.mrs base >$w.after
	mr-compare -a base -b base --json $w.smooth.mrs <$w.remeshed.mrs >$w.distance
	mr-decode <$w.rest.mrs | mr-compare -a mesh -b mesh --json $w.original.mrs >$w.decoded
	mr-pose $handle <$w.rest.mrs | mr-solve | mr-decode |
		mr-compare -a mesh -b mesh --json $w.original.mrs >$w.identity

	grep -q "^$1 " work/remeshing || for state in before after; do
		echo "$1 $state $(figure $w.$state vertices) $(figure $w.$state euler) $(figure $w.$state boundary_loops)" \
		    "$(figure $w.$state voronoi_error) $(figure $w.$state angle_error) $(figure $w.$state valence6)" \
		    "$([ $state = before ] || figure $w.distance 'both_relative":{"hausdorff')"
	done >>work/remeshing
	echo "$name $(figure $w.5 heights) $(figure $w.5 offsets) $(figure $w.decoded vertex_max_relative)" \
	    "$(figure $w.identity vertex_max_relative)" >>work/lost
	echo "$name $(for n in 1 2 3 4 5 6 7 8 9; do figure $w.$n seconds; done | tr '\n' ' ')" \
	    "$(for n in 1 2 3 4 5 6 7 8 9; do figure $w.$n peak_bytes; done | sort -n | tail -n 1)" >>work/seconds
}

table() {
	echo
	echo "Remeshing: the base before and after (area error: mean relative deviation of interior Voronoi areas; angle error:"
	echo "mean |angle - 60|; distance: Hausdorff, to the base before, of its diagonal)"
	awk 'BEGIN { printf "%-12s %-7s %9s %7s %7s %7s %9s %9s %9s\n",
		"model", "", "vertices", "Euler", "loops", "area %",
		"angle deg", "val. 6 %", "dist. %" }
		{ printf "%-12s %-7s %9d %7d %7d %7.2f %9.2f %9.1f", $1, $2, $3, $4, $5, 100 * $6, $7, 100 * $8
		if (NF > 8) printf " %9.3f", 100 * $9
		print "" }' work/remeshing
	echo
	echo "Nothing lost: vertices with a height (not an offset); largest error of a vertex, of the diagonal, decoded on its own"
	echo "base, and after an identity pose through all steps"
	awk 'BEGIN { printf "%-16s %9s %12s %12s\n", "edit", "heights %", "decoded", "identity" }
		{ printf "%-16s %9.3f %12.1e %12.1e\n", $1, 100 * $2 / ($2 + $3), $4, $5 }' work/lost
	echo
	echo "Seconds of each step, and the most memory that one of them took"
	awk 'BEGIN { printf "%-16s %7s %7s %7s %7s %7s %7s %7s %7s %7s %7s %6s\n", "edit", "import", "smooth", "remesh",
		"select", "encode", "pose", "solve", "decode", "export", "all", "MB" }
		{ printf "%-16s", $1; all = 0
		for (i = 2; i <= 10; i++) { printf " %7.3f", $i; all += $i }
		printf " %7.3f %6.0f\n", all, $11 / 1e6 }' work/seconds
	echo
	echo "Animation, start and end of all tools included"
	cat work/rates
}

# A layer of a stream by itself, under another name, with nothing selected.
only() { # layer, name
	mr-export -l "$1" "work/parts/$name.ply" && mr-import -l "$2" "work/parts/$name.ply" | mr-select -l "$2" --reset
}

# Three pairs of pictures: the model and its base; the regions, and the remeshed base with those that it took from the
# model; the bent base and the result.
pictures() { # view
	only mesh original <$w.original.mrs >$w.one.mrs
	only base base <$w.smooth.mrs | mr-cat --merge $w.one.mrs - >$w.first.mrs
	only base base <$w.result.mrs >$w.one.mrs
	only mesh result <$w.result.mrs | mr-cat --merge $w.one.mrs - >$w.last.mrs
	mr-cat $w.first.mrs $w.rest.mrs $w.last.mrs >$w.sheet.mrs
	mr-render --sheet --columns 3 --size $panel --view "$1" -c region "$name.png" <$w.sheet.mrs
}

# One edit, one pipe.  tee keeps what the pictures and the figures are made of.
edit() { # name, model, view, smoothing, regions, pose, another pose
	name=$1 file=$(model "$2") w=work/$1
	handle=$(echo "$6" | sed 's/\(-H [0-9]*\).*/\1/')
	echo "$name"
	mr-import "$file" --stats $w.1 | tee $w.original.mrs |
	    mr-smooth $4 --stats $w.2 | tee $w.smooth.mrs |
	    mr-remesh --stats $w.3 | tee $w.remeshed.mrs |
	    mr-select $5 --stats $w.4 |
	    mr-encode --stats $w.5 | tee $w.rest.mrs |
	    mr-pose $6 --stats $w.6 | mr-pose ${7:-$handle} |
	    mr-solve --stats $w.7 |
	    mr-decode --stats $w.8 | tee $w.result.mrs |
	    mr-export "$name.obj" --stats $w.9
	pictures "$3"
	figures "$2"
	mr-solve --basis $w.rest.mrs | mr-encode | mr-cat -z -o "edits/$name.mrs"
	mr-select --reset $w.result.mrs | mr-cat -z -o "edits/$name.posed.mrs"
}

touch work/remeshing

if [ -n "$real" ]; then
	edit bunny-pull bunny00 front '' '--free above:y,0.7 --handle 1=above:y,0.86' \
	    '-H 1 --translate 0.12,0.3,0 --rotate 0,0,1,-10'
	edit bunny-bend bunny00 front '' \
		'--free above:y,0.2 --handle 1=above:y,0.72 --handle 1=above:y,0.48+below:x,0.36' \
	    '-H 1 --rotate 0,0,1,-30 --translate 0.02,0.12,0'
	edit armadillo-twist armadillo front '' '--free above:y,0.25 --handle 1=above:y,0.62' \
	    '-H 1 --rotate 0,1,0,80'
	edit armadillo-arms armadillo front '' \
	    '--free above:y,0.5+above:x,0.66 --free above:y,0.5+below:x,0.34
	    --handle 1=above:y,0.55+below:x,0.18 --handle 2=above:y,0.55+above:x,0.82' \
	    '-H 1 --translate -20,-35,0 --rotate 0,0,1,75' '-H 2 --translate 15,25,0 --rotate 0,0,1,30'
	edit elephant-bend elephant front '-t 1' '--free above:y,0.4 --handle 1=above:y,0.6' \
	    '-H 1 --rotate 0,0,1,45 --translate -0.15,0.05,0'
	edit lion-scale lion-head quarter '-t 4' '--free above:z,0.6 --handle 1=above:z,0.88' \
	    '-H 1 --scale 1.5 --translate 0,0,0.05'
else
	edit creature-tilt creature front '' '--free all --fixed below:y,0.5 --handle 1=above:y,0.85' \
	    '-H 1 --rotate 0,0,1,30'
	edit creature-twist creature front '' '--free above:y,0.2 --handle 1=above:y,0.4' \
	    '-H 1 --rotate 0,1,0,60'
	edit creature-arms creature front '' \
	    '--free above:y,0.4+below:y,0.8+below:x,0.3 --free above:y,0.4+below:y,0.8+above:x,0.7
	    --handle 1=above:y,0.4+below:x,0.12 --handle 2=above:y,0.4+above:x,0.88' \
	    '-H 1 --translate -0.2,0.3,0' '-H 2 --translate 0.2,-0.3,0'
fi

# All of them in one picture.
for name in $(cut -d' ' -f1 work/lost); do
	cat "work/$name.sheet.mrs"
done | mr-render --sheet --columns 3 --size $panel -c region --view front sheet.png

# An animation: the base, its responses and the details once, then sixty poses behind the one at rest.
frames=${MR_SMALL:+4}
frames=${frames:-60}
echo "animation of $frames frames"
mr-import "$(model armadillo)" | mr-smooth | mr-remesh |
    mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.62 |
    mr-solve --basis | mr-encode -o work/basis.mrs
mr-pose -H 1 --rotate 0,1,0,80 --frames $frames work/basis.mrs | mr-solve | mr-decode |
    mr-render --size $panel --view front -l mesh --no-labels frames/%d.png

# A creature that wears a picture, of rings in two colours, and bends with it; as a file for viewers and browsers, too.
echo "creature with a picture"
mr-make torus -n 1000 | mr-select --free all --handle 1=above:x,0.5 -o work/ring.mrs
for i in $(seq 50); do
	cat work/ring.mrs
done | mr-render --sheet --columns 10 --size 96x96 --view front -c region --no-labels work/rings.png
mr-make bumpy --texcoords ${MR_SMALL:+-n $MR_SMALL} -o work/dressed.mrs
mr-smooth work/dressed.mrs | mr-remesh | mr-select --free all --fixed below:y,0.5 --handle 1=above:y,0.85 |
	mr-solve | mr-encode |
    mr-pose -H 1 --rotate 0,0,1,40 | mr-solve | mr-decode -o work/bent.mrs
mr-cat work/dressed.mrs work/bent.mrs |
    mr-render --sheet --columns 2 --size $panel -l mesh --view front --texture work/rings.png --no-labels textured.png
printf 'newmtl rings\nmap_Kd rings.png\n' >work/rings.mtl
{ printf 'mtllib rings.mtl\nusemtl rings\n'; mr-export -f obj - <work/bent.mrs; } | mr-import |
	mr-export --materials work textured.glb

rate() { # what, command line: frames a second
	begin=$(date +%s.%N)
	mr-pose -H 1 --rotate 0,1,0,80 --frames $frames work/basis.mrs | eval "$2" >/dev/null
	echo "$1 $(date +%s.%N) $begin" |
		awk '{ printf "%-28s %7.1f frames/s\n", $1, '$frames' / ($2 - $3) }' >>work/rates
}
rate 'pose|solve|decode' 'mr-solve | mr-decode'
rate 'pose|solve-linear|decode' 'mr-solve --rotations linear | mr-decode'
rate 'solve-basis..pose|decode' 'mr-decode -q'

table | tee work/figures.txt
mv work/figures.txt figures.txt
rm -r work
