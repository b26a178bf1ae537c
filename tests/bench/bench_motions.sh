# Large motions beside CGAL's as-rigid-as-possible deformation (spokes and rims, 10 iterations a pose), by the figures of
# edit_yardstick.c; and the seconds of a pose after all that is prepared once.  Ours goes there in 10 frames; CGAL's does so
# too (cgal-steps), and at once (cgal), where the turn is less than a whole one.
# Knob: SOLVE, options of mr-solve.
figure() { # name, file: a number of a line of JSON
	grep -o "\"$1\":[^,}]*" "$2" | head -n 1 | cut -d : -f 2
}
median() { # of the frames behind the first
	sed -n '2,$s/.*"seconds":\([^,}]*\).*/\1/p' "$1" | sort -g | awk '{ x[NR] = $1 } END { print x[int((NR + 1) / 2)] }'
}
show() { # who, seconds of a pose, file of the result
	edit_yardstick $motion before.mrs "$3" >json || exit
	echo "$case-edges $1 $(figure edge_log2 json) log2"
	echo "$case-aspect $1 $(figure aspect_log2 json) log2"
	echo "$case-volume $1 $(figure volume json) times"
	echo "$case-from-warp $1 $(figure from_warp json) diagonals"
	echo "$case-pose $1 $2 s"
	echo "$case: $1 has $(figure folds_more json) folds and $(figure pairs_more json) near pairs more than the warp"
}
ours() {
	mr-smooth before.mrs | mr-remesh | mr-select --reset $(sed -n 1p options) | mr-encode |
	    mr-pose $(sed -n 2p options) --frames 10 -o posed.mrs && mr-solve $SOLVE --stats solve.json posed.mrs -o solved.mrs &&
	    mr-decode --stats decode.json solved.mrs -o after.mrs || exit
	show mr "$(echo "$(median solve.json) $(median decode.json)" | awk '{ print $1 + $2 }')" after.mrs
	echo "$case: the warp has $(figure edge_log2_warp json), $(figure aspect_log2_warp json), $(figure volume_warp json)"
}
theirs() { # who, steps
	place=$(sed 's/.*below:\(.\),.*/\1/; s/.*rotate//; s/--center//; s/,/ /g' options)
	seconds=$(peer_motions before.off peer.off $2 $place) || exit
	show $1 "$seconds" peer.off
}
compare() { # $model, $motion
	case=$model-$(echo $motion | tr -d :)
	edit_yardstick --options $motion before.mrs >options || exit
	ours
	[ -x "$BUILD/bench/peer_motions" ] || return 0
	[ $motion = twist:360 ] || theirs cgal 1
	theirs cgal-steps 10
}
motions() { # name, motions; the model is before.mrs
	model=$1
	shift
	mr-export before.off -i before.mrs || exit
	for motion; do
		compare
	done
}
mr-make cylinder -o before.mrs && motions cylinder bend:120 twist:180 twist:360
for file in hand.off armadillo.off.gz cactus.off dino.off.gz bunny00.off.gz arm.obj.gz knot1.off; do
	[ ! -f "$DATA/meshes/$file" ] ||
	    { mr-import -q --repair "$DATA/meshes/$file" -o before.mrs && motions "${file%%.*}" bend:120 twist:180; }
done
