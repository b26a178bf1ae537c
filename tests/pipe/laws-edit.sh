# The algebra of editing: nothing is lost, the identity is exact, rigid motions are rigid, a delta is a frame.
fail=0
bad() {
	echo "$*"
	fail=1
}

# Positions of each frame of a stream, as text, to PREFIX.1, PREFIX.2, ...
positions() {
	rm -f "$1".*.off "$1".[0-9]*
	mr-export -l "${2:-mesh}" "$1.%d.off" || bad "$1: cannot be exported"
	for off in "$1".*.off; do
		awk 'NR == 1 { next } !nv { nv = $1; next } n < nv { print; n++ }' "$off" >"${off%.off}"
	done
}
# Largest distance between the vertices of two position files, over the diagonal of the first, is at most the bound.
near() { # what, a, b, bound
	paste -d ' ' "$2" "$3" | awk -v what="$1" -v bound="$4" '
		NF != 6 { print what ": vertex counts differ"; exit bad = 1 }
		{
			d = sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2)
			if (!(d <= most)) most = d
			for (i = 1; i <= 3; i++) {
				if (NR == 1 || $i < low[i]) low[i] = $i
				if (NR == 1 || $i > high[i]) high[i] = $i
			}
		}
		END {
			if (bad || !NR) exit 1
			most /= sqrt((high[1] - low[1]) ^ 2 + (high[2] - low[2]) ^ 2 + (high[3] - low[3]) ^ 2)
			if (!(most <= bound)) { printf "%s: off by %g of the diagonal, allowed %g\n", what, most, bound; exit 1 }
		}' || fail=1
}

# A quarter turn about z, which is exact, and a move.
quarter() {
	awk '{ printf "%.17g %.17g %.17g\n", 1 - $2, 2 + $1, 3 + $3 }'
}

mr-make bumpy -n 3000 >model.mrs
positions model <model.mrs
regions='--reset --free all --fixed below:z,0.2 --handle 1=above:z,0.8'

for k in 1 2 3; do
	mr-smooth <model.mrs | mr-remesh | mr-select $regions | mr-solve -k $k --basis | mr-encode >rest.mrs ||
	    bad "k = $k: fails"

	# Decoding on the base as it is gives every vertex back to rounding (1.4e-16 here); the identity pose moves none at all.
	mr-decode <rest.mrs | positions same
	near "k = $k: decoded on its own base" model.1 same.1 2e-15
	mr-pose -H 1 <rest.mrs | mr-solve -k $k | mr-decode | positions posed
	cmp same.1 posed.1 || bad "k = $k: the identity pose moves something"

	# By responses and by solving, with one factor: 4e-14.
	pose='-H 1 --rotate 1,2,3,50 --scale 1.2,0.9,1 --translate 0.1,0,0.2'
	mr-pose $pose <rest.mrs | mr-solve -k $k --rotations linear | mr-decode | positions solved
	mr-pose $pose <rest.mrs | mr-decode | positions responded
	near "k = $k: response against solve" solved.1 responded.1 1e-12
	cmp -s model.1 solved.1 && bad "k = $k: the pose does nothing"

	# All constraints by one rigid motion: there is nothing to solve, so the base goes along to rounding (1e-16); over its thin
	# triangles normals, and what stands on them, to 2e-13.
	mr-smooth <model.mrs | mr-remesh | mr-select --reset --free all --handle 0=below:z,0.2 --handle 1=above:z,0.8 |
	    mr-encode |
	    mr-pose -H 0 --center 0,0,0 --rotate 0,0,1,90 --translate 1,2,3 |
	    mr-pose -H 1 --center 0,0,0 --rotate 0,0,1,90 --translate 1,2,3 | mr-solve -k $k | mr-decode -o rigid.mrs
	positions rigid <rigid.mrs
	quarter <model.1 >moved.1
	near "k = $k: a rigid motion of all constraints" moved.1 rigid.1 1e-11
	positions base base <rest.mrs
	positions rigid base <rigid.mrs
	quarter <base.1 >moved.1
	near "k = $k: a rigid motion of all constraints, the base" moved.1 rigid.1 1e-14
done

# An animation equals its poses run one by one, byte for byte: by solving and by responses.
mr-smooth <model.mrs | mr-remesh | mr-select $regions | mr-encode >rest.mrs
to='--center 0,0,0 --rotate 0,0,1,60 --translate 0,0,0.2'
mr-pose -H 1 $to --frames 3 <rest.mrs | mr-solve | mr-decode >animation.mrs
positions frame <animation.mrs
mr-decode <rest.mrs | positions same
cmp same.1 frame.1 || bad 'the frame at rest is not the model at rest'
mr-pose -H 1 $to <rest.mrs | mr-solve | mr-decode | positions last
cmp last.1 frame.4 || bad "the last frame is not the pose"
to='--center 0,0,0 --rotate 0,0,1,20 --translate 0,0,0.06666666666666667'
mr-pose -H 1 $to <rest.mrs | mr-solve | mr-decode | positions third
near "a frame between" third.1 frame.2 1e-14

# Well inside its handle the model has gone a third of the way with it in the first frame, and well inside what is fixed nowhere.
inside() { # file, share along z from which: the lines of the file at vertices of the model beyond it, or below it if negative
	paste -d ' ' model.1 "$1" | awk -v share="$2" '
		{ z[NR] = $3; line[NR] = $4 " " $5 " " $6; if (NR == 1 || $3 < low) low = $3; if (NR == 1 || $3 > high) high = $3 }
		END { for (i = 1; i <= NR; i++) {
			at = (z[i] - low) / (high - low)
			if (share < 0 ? at <= -share : at >= share) { print line[i]; n++ }
		} exit n < 50 }' || bad "few vertices beyond $2"
}
awk 'BEGIN { c = cos(atan2(0, -1) / 9); s = sin(atan2(0, -1) / 9) }
	{ printf "%.17g %.17g %.17g\n", c * $1 - s * $2, s * $1 + c * $2, $3 + 0.2 / 3 }' same.1 >third.1
inside third.1 0.9 >handle.1
inside frame.2 0.9 >handle.2
near "the handle is a third of the way" handle.1 handle.2 1e-14
inside same.1 -0.1 >fixed.1
inside frame.2 -0.1 >fixed.2
cmp fixed.1 fixed.2 || bad 'a fixed vertex moves'

# Two models in one stream, one after the other, are what they are alone.
mr-make torus -n 2000 >torus.mrs
cat model.mrs torus.mrs | mr-smooth | mr-remesh | mr-select $regions | mr-encode | mr-decode >both.mrs
for model in model torus; do
	mr-smooth <$model.mrs | mr-remesh | mr-select $regions | mr-encode | mr-decode >$model.alone.mrs
done
cat model.alone.mrs torus.alone.mrs | mr-cat >alone.mrs
positions both <both.mrs
positions alone <alone.mrs
for i in 1 2; do
	cmp both.$i alone.$i || bad "frame $i depends on its neighbour"
done

# Packed columns hold the same.
mr-cat -z rest.mrs | mr-cat -u | mr-decode | positions unpacked
mr-decode <rest.mrs | positions plain
cmp unpacked.1 plain.1 || bad "packing changes positions"

# Turned input gives turned output: by a right angle, which is exact, and without the remesher, whose decisions may flip.  The
# condition of the system makes 2e-14 of rounding, and 3e-13 of a thin plate.
awk 'NR > 2 && NF == 3 { printf "%.17g %s %s\n", -$2, $1, $3; next } { print }' model.1.off >turned.off
for k in 1 2; do
	for model in turned.off model.1.off; do
		mr-import $model | mr-smooth | mr-select $regions | mr-encode |
		    mr-pose -H 1 --rotate 0,0,1,40 --scale 1.5 | mr-solve -k $k | mr-decode | positions "${model%%.*}d"
	done
	awk '{ printf "%.17g %.17g %.17g\n", -$2, $1, $3 }' modeld.1 >modelt.1
	near "k = $k: a turned model" modelt.1 turnedd.1 $([ $k = 1 ] && echo 1e-12 || echo 1e-11)
done
exit $fail
