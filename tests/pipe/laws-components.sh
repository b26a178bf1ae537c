# Two tori in one mesh, side by side or linked, are edited, remeshed and reconstructed as two, each with its handle.
fail=0
bad() {
	echo "$*"
	fail=1
}
figure() { # file of a --stats line, name
	grep -o "\"$2\":[^,}]*" "$1" | head -n 1 | cut -d : -f 2
}

# A torus twice: once as it is, once turned to stand upright and moved by x.
twice() {
	awk -v x="$1" 'NR == 2 { n = $1; m = $2 } NR <= 2 { next }
		NR <= n + 2 { p[NR - 2] = $0; q[NR - 2] = sprintf("%.17g %.17g %s", $1 + x, -$3, $2); next }
		{ f[NR - n - 2] = $0; g[NR - n - 2] = $1 " " $2 + n " " $3 + n " " $4 + n }
		END {
			print "OFF"; print 2 * n, 2 * m, 0
			for (i = 1; i <= n; i++) print p[i]
			for (i = 1; i <= n; i++) print q[i]
			for (i = 1; i <= m; i++) print f[i]
			for (i = 1; i <= m; i++) print g[i]
		}'
}
positions() { # stream: of mesh, one a line
	mr-export -l "${2:-mesh}" -f off - <"$1" | awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2'
}
near() { # what, a, b, bound: of coordinates about 1
	paste -d ' ' "$2" "$3" | awk -v what="$1" -v bound="$4" '
		NF != 6 { print what ": vertex counts differ"; exit bad = 1 }
		{ for (i = 1; i <= 3; i++) { d = $i - $(i + 3); d = d < 0 ? -d : d; if (!(d <= most)) most = d } }
		END { if (bad || !(most <= bound)) { print what ": off by " most ", allowed " bound; exit 1 } }' || fail=1
}

mr-make torus -n 3000 | mr-export -f off - >one.off
n=$(awk 'NR == 2 { print $1 }' one.off)
twice 4 <one.off >aside.off
twice 1 <one.off >linked.off

# With a handle on each, posing one: its torus does as it does alone, the other does nothing.
first='--handle 1=halfspace:1,0,0,1+not:halfspace:1,0,0,2 --fixed not:halfspace:1,0,0,-1'
second='--handle 2=halfspace:1,0,0,5 --fixed halfspace:1,0,0,2+not:halfspace:1,0,0,3'
pose='-H 1 --rotate 0,0,1,40 --translate 0,0.3,0.2'
mr-import one.off | mr-smooth | mr-select --reset --free all $first | mr-encode | mr-pose $pose | mr-solve |
    mr-decode -o alone.mrs || bad 'one torus: fails'
mr-import aside.off | mr-smooth | mr-select --reset --free all $first $second | mr-solve --basis | mr-encode -o rest.mrs ||
    bad 'two tori: fails'
mr-decode rest.mrs -o same.mrs
positions rest.mrs >model
positions same.mrs >same
near 'decoded on its own base' model same 1e-14
mr-pose $pose rest.mrs | mr-solve | mr-decode -o posed.mrs
positions alone.mrs >want
positions posed.mrs | head -n "$n" >got
near 'a torus beside another' want got 1e-9 # 3e-13 by the condition of a thin plate
positions posed.mrs | tail -n "$n" >got
tail -n "$n" same | cmp - got || bad 'a pose of one torus moves the other'
mr-pose $pose rest.mrs | mr-decode -o responded.mrs
mr-pose $pose rest.mrs | mr-solve --rotations linear | mr-decode -o linear.mrs
positions linear.mrs >want
positions responded.mrs >got
near 'by responses' want got 1e-12
positions posed.mrs >want
for solver in cg multigrid; do
	mr-pose $pose rest.mrs | mr-solve -s $solver | mr-decode -o got.mrs || bad "$solver: fails"
	positions got.mrs >got
	near "by $solver" want got 1e-7 # 1e-9 of relative residuals of 1e-10
done
# Both at once is one and then the other.
mr-pose $pose rest.mrs | mr-pose -H 2 --scale 1.3 | mr-solve | mr-decode -o got.mrs
positions got.mrs | head -n "$n" >got
head -n "$n" want | cmp - got || bad 'a pose of the other torus moves the first'

# Handles on one alone: the other has no constraint, keeps still, and is told of.
mr-import aside.off | mr-smooth | mr-select --reset --free all $first | mr-encode |
    mr-pose $pose | mr-solve --apart --stats stats | mr-decode -o got.mrs || bad 'handles on one torus alone: fails'
[ "$(figure stats isolated_components)" = 1 ] || bad "isolated components: $(cat stats)"
positions got.mrs | head -n "$n" >got
positions alone.mrs >want
near 'beside a loose torus' want got 1e-9
positions got.mrs | tail -n "$n" >got
tail -n "$n" model >want
near 'a loose torus' want got 1e-14

# One handle on both moves both.
mr-import aside.off | mr-smooth | mr-select --reset --free all --fixed not:halfspace:1,0,0,-1 --handle 1=halfspace:1,0,0,4 \
    --handle 1=halfspace:1,0,0,1+not:halfspace:1,0,0,2 | mr-encode | mr-pose -H 1 --translate 0,0,1 | mr-solve |
    mr-decode -o got.mrs
positions got.mrs | tail -n "$n" >got
tail -n "$n" model | awk '{ printf "%s %s %.17g\n", $1, $2, $3 + 1 }' >want
near 'a torus whose only constraint is a handle' want got 1e-10 # 5e-12

# A grid of boxes of eight vertices: its base shrinks them to specks, and they hold to each other all the same.
awk 'BEGIN {
	n = 5; split("1 3 2 2 3 4 5 6 7 6 8 7 1 2 5 2 6 5 3 7 4 4 7 8 1 5 3 3 5 7 2 4 6 4 8 6", t, " ")
	for (b = 0; b < n * n * n; b++)
		for (i = 0; i < 8; i++)
			print "v", b % n + i % 2, int(b / n) % n + int(i / 2) % 2, int(b / (n * n)) + int(i / 4)
	for (b = 0; b < n * n * n; b++)
		for (i = 0; i < 12; i++)
			print "f", 8 * b + t[3 * i + 1], 8 * b + t[3 * i + 2], 8 * b + t[3 * i + 3]
}' >grid.obj
mr-import grid.obj | mr-smooth | mr-remesh | mr-select --reset --free all --fixed below:x,0.2 --handle 0=above:x,0.8 |
    mr-encode -q | mr-pose -H 0 --rotate 0,1,0,60 --center 2.5,2.5,2.5 | mr-solve --stats stats | mr-decode -q -o got.mrs
[ "$(figure stats isolated_components)" = 0 ] || bad "a grid of boxes: $(figure stats isolated_components) hold to no other"

# Remeshed and reconstructed they stay two of genus 1 each, linked or not.
topology() { # layer, file
	mr-info --json --no-intersections -l "$1" "$2" | grep -o '"components":[0-9]*,"euler":[-0-9]*\|"genus":[0-9]*' | tr '\n' ' '
}
apart() { # layer, stream, bound: from the model
	mr-compare --json -a "$1" -b truth -i "$2" | sed -E 's/.*"both":\{"hausdorff":([^,]*).*/\1/' |
	    awk -v what="$model: $1" -v bound="$3" '!($1 <= bound) { print what " is off by " $1 ", allowed " bound; exit 1 }' || fail=1
}
two='"components":2,"euler":0 "genus":2 '
for model in aside linked; do
	mr-import -l truth $model.off -o truth.mrs
	mr-import $model.off | mr-cat --merge - truth.mrs | mr-smooth -t 1 | mr-remesh -o got.mrs
	[ "$(topology base got.mrs)" = "$two" ] || bad "$model, remeshed: $(topology base got.mrs)"
	apart base got.mrs 0.05 # what the low-pass takes and edges cut off
	mr-import $model.off | mr-simplify -n 300 -o got.mrs
	[ "$(topology mesh got.mrs)" = "$two" ] || bad "$model, simplified: $(topology mesh got.mrs)"

	mr-import -l points --points $model.off | mr-shrinkwrap -q | mr-simplify -q -n 400 | mr-fit -q | mr-sample -q | mr-decode |
	    mr-cat --merge - truth.mrs >got.mrs
	for layer in control mesh; do
		[ "$(topology $layer got.mrs)" = "$two" ] || bad "$model, reconstructed, $layer: $(topology $layer got.mrs)"
	done
	apart mesh got.mrs 0.015
	mr-info -l control got.mrs | grep -q 'flaws *none' || bad "$model, reconstructed: $(mr-info -l control got.mrs | grep flaws)"
done
exit $fail
