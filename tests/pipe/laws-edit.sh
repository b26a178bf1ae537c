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

mr-make bumpy -n 6000 >model.mrs
positions model <model.mrs
regions='--reset --free all --fixed below:z,0.2 --handle 1=above:z,0.8'

for k in 1 2 3; do
	mr-smooth <model.mrs | mr-remesh | mr-select $regions | mr-solve -k $k --basis | mr-encode >rest.mrs ||
	    bad "k = $k: fails"

	# Decoding on the base as it is; the identity pose.
	mr-decode <rest.mrs | positions same
	near "k = $k: decoded on its own base" model.1 same.1 1e-12
	mr-pose -H 1 <rest.mrs | mr-solve -k $k | mr-decode | positions same
	near "k = $k: identity pose" model.1 same.1 1e-12

	# By responses and by solving.
	pose='-H 1 --rotate 1,2,3,50 --scale 1.2,0.9,1 --translate 0.1,0,0.2'
	mr-pose $pose <rest.mrs | mr-solve -k $k | mr-decode | positions solved
	mr-pose $pose <rest.mrs | mr-decode | positions responded
	near "k = $k: response against solve" solved.1 responded.1 1e-9
	cmp -s model.1 solved.1 && bad "k = $k: the pose does nothing"

	# All constraints by one rigid motion: the model by that motion.
	mr-smooth <model.mrs | mr-remesh | mr-select --reset --free all --handle 0=below:z,0.2 --handle 1=above:z,0.8 |
	    mr-solve -k $k | mr-encode |
	    mr-pose -H 0 --center 0,0,0 --rotate 0,0,1,90 --translate 1,2,3 |
	    mr-pose -H 1 --center 0,0,0 --rotate 0,0,1,90 --translate 1,2,3 | mr-solve -k $k | mr-decode | positions rigid
	awk '{ printf "%.17g %.17g %.17g\n", 1 - $2, 2 + $1, 3 + $3 }' model.1 >moved.1
	near "k = $k: a rigid motion of all constraints" moved.1 rigid.1 1e-9
done

# An animation equals its poses run one by one, byte for byte: by solving and by responses.
mr-smooth <model.mrs | mr-remesh | mr-select $regions | mr-solve | mr-encode >rest.mrs
mr-pose -H 1 --rotate 0,0,1,60 --translate 0,0,0.2 --frames 3 <rest.mrs | mr-solve | mr-decode >animation.mrs
positions frame <animation.mrs
near "frame at rest" model.1 frame.1 1e-12
near "first frame is a third of the way" model.1 frame.2 1
mr-pose -H 1 --rotate 0,0,1,60 --translate 0,0,0.2 <rest.mrs | mr-solve | mr-decode | positions last
cmp last.1 frame.4 || bad "the last frame is not the pose"
mr-pose -H 1 --rotate 0,0,1,20 --translate 0,0,0.06666666666666667 <rest.mrs | mr-solve | mr-decode | positions third
near "a frame between" third.1 frame.2 1e-13

# Two models in one stream, one after the other, are what they are alone.
mr-make torus -n 2000 >torus.mrs
cat model.mrs torus.mrs | mr-smooth | mr-remesh | mr-select $regions | mr-solve | mr-encode | mr-decode >both.mrs
for model in model torus; do
	mr-smooth <$model.mrs | mr-remesh | mr-select $regions | mr-solve | mr-encode | mr-decode >$model.alone.mrs
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

# Turned input gives turned output: by a right angle, which is exact, and without the remesher, whose decisions may flip.
awk 'NR > 2 && NF == 3 { printf "%.17g %s %s\n", -$2, $1, $3; next } { print }' model.1.off >turned.off
for k in 1 2; do
	for model in turned.off model.1.off; do
		mr-import $model | mr-smooth | mr-select $regions | mr-solve -k $k | mr-encode |
		    mr-pose -H 1 --rotate 0,0,1,40 --scale 1.5 | mr-solve -k $k | mr-decode | positions "${model%%.*}d"
	done
	awk '{ printf "%.17g %.17g %.17g\n", -$2, $1, $3 }' modeld.1 >modelt.1
	near "k = $k: a turned model" modelt.1 turnedd.1 $([ $k = 1 ] && echo 1e-12 || echo 1e-9)
done
exit $fail
