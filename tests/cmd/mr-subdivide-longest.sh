# Long edges divided: what goes along, the same surface, lengths, refusals, threads, frames.
mr-make cube -n 26 -o cube.mrs
for length in 0.3 1% 100; do
	mr-subdivide --longest $length cube.mrs -o fine.mrs
	mr-info fine.mrs | grep 'vertices,\|area\|topology\|edge lengths'
	mr-info --check fine.mrs >/dev/null || echo unlawful
done
mr-subdivide --longest 0 -n 0 cube.mrs | mr-export -f off - >a
mr-export -i cube.mrs -f off - | cmp - a && echo 'with 0 it is Loop'
mr-subdivide --longest 0.2 cube.mrs | mr-compare --json cube.mrs | tr ',{' '\n\n' | awk -F: '/"max"/ { print ($2 < 1e-15 ? "the same surface" : $0) }'

echo 'a sliver, its corners, its material'
cat >sliver.obj <<'X'
v 0 0 0
v 4 0 0
v 4 0.1 0
v 0 3 0
vt 0 0
vt 4 0
vt 4 0.1
vt 9 9
usemtl thin
f 1/1 2/2 3/3
usemtl wide
f 1/1 3/4 4
X
mr-import sliver.obj | mr-subdivide --longest 2.1 | mr-export -f obj -

echo refusals
for options in '--longest 1e-9' '--longest 5e-324' '--longest -1' '--longest x' '--longest 1 -n 2' '--longest 1 --limit' '--longest 1 --crease 30'; do
	mr-subdivide $options cube.mrs >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done

echo 'threads change nothing, and a delta is as its frame alone'
mr-subdivide --longest 0.1 -j 1 --no-history cube.mrs >one.mrs
mr-subdivide --longest 0.1 -j 2 --no-history cube.mrs | cmp - one.mrs && echo same
