# Undeformed solves and poses through the pipe: what must be exact is, and shortcuts change nothing.
mr-make bumpy -n 2000 | mr-smooth -q -t 20 | mr-select --free above:z,0.2 --handle 0=above:z,0.85 -o s.mrs
off() { mr-export -f off -l "$2" - <"$1"; }
far() { # the largest difference of two OFF files, against a tolerance
	paste "$1" "$2" | awk -v tol="$3" 'NR > 2 && NF == 6 { for (i = 1; i <= 3; i++) {
		d = $i - $(i + 3); if (d < 0) d = -d; if (d > most) most = d } n += NF == 6 }
		END { print (n > 100 && most <= tol ? "ok" : "bad " most) }'
}
for k in 1 2 3; do
	mr-solve -q -k $k --flatten --stats stats.json s.mrs -o p0.mrs
	sed 's/.*"residual":\([^,]*\).*/\1/' stats.json | awk -v k=$k '{ print "order", k, "residual", ($1 < 1e-9 ? "ok" : "bad") }'
	off p0.mrs base >p0.off

	# Handles at rest: no bit changes.
	mr-pose p0.mrs | mr-solve -k $k -o q.mrs
	off q.mrs base | cmp - p0.off && echo "rest is rest"

	# The system as the paper has it, and LU of ours.
	mr-pose --translate 0.2,0.1,0.3 --rotate 0,0,1,40 p0.mrs -o posed.mrs
	mr-solve -k $k posed.mrs -o q.mrs # by rotations
	off q.mrs base >q.off
	for other in --unsymmetric '-s lu'; do
		mr-solve -k $k $other posed.mrs -o r.mrs
		off r.mrs base >r.off
		far q.off r.off 5e-8 # the condition of order 3 makes 1.5e-8
	done

	# By iteration, which its tolerance limits.
	for other in cg multigrid; do
		[ $k -lt 3 ] || [ "$other" = multigrid ] || continue
		mr-solve -k $k -s $other --tol 1e-12 posed.mrs -o r.mrs
		off r.mrs base >r.off
		far q.off r.off 1e-6
	done

	# By the basis, which is linear.
	mr-solve -k $k --rotations linear posed.mrs -o q.mrs
	off q.mrs base >q.off
	mr-solve -q -k $k --flatten --basis s.mrs | mr-encode -q | mr-pose --translate 0.2,0.1,0.3 --rotate 0,0,1,40 | mr-decode -q -o r.mrs
	off r.mrs base >r.off
	far q.off r.off 1e-9
done
mr-info q.mrs | grep -c 'handles\|response' # used up

# A factor that does not fit.
mr-solve --memory 0.1 -s cholesky --flatten s.mrs -o r.mrs 2>&1 | sed 's/[0-9.]* MB/N MB/g; s/[0-9]* rows/N rows/'
mr-solve --memory 0.1 -v --flatten s.mrs -o r.mrs 2>&1 | grep -c 'multigrid takes its place'

# Rotations: a whole turn is there, about the axis, and two halves of it are the same; rounds hold at rest, and are the
# same whoever solves.
mr-make cylinder -n 2000 --open | mr-smooth -t 0 | mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 -o tube.mrs
off tube.mrs base >tube.off
middle() { # of the tube: least and largest radius, and the mean cosine of the angle by which it has turned
	off "$1" base | paste tube.off - | awk 'NR > 2 && NF == 6 && $3 < 0.3 && $3 > -0.3 {
			r = sqrt($4 ^ 2 + $5 ^ 2); cosine += ($1 * $4 + $2 * $5) / r
			if (!n++ || r < low) low = r; if (r > high) high = r }
		END { printf "radius %.3f to %.3f, cosine %.2f\n", low, high, cosine / n }'
}
for pose in '--rotate 0,0,1,180' '--rotate 0,0,1,360'; do
	mr-pose $pose tube.mrs | mr-solve -o q.mrs
	echo "$pose: $(middle q.mrs)"
	mr-pose $pose tube.mrs | mr-solve --rotations linear -o r.mrs
	echo "$pose, linearly: $(middle r.mrs)"
done
mr-pose --rotate 0,0,1,180 tube.mrs | mr-pose --rotate 0,0,1,180 | mr-solve -o r.mrs
off q.mrs base >q.off
off r.mrs base >r.off
far q.off r.off 1e-12
mr-pose --rotate 1,0,0,90 tube.mrs -o posed.mrs
mr-solve --arap 4 posed.mrs -o q.mrs
mr-solve posed.mrs -o r.mrs
off q.mrs base >q.off
off r.mrs base >r.off
far q.off r.off 1e-3 | sed 's/ .*//' # what rounds change
for other in lu cg multigrid; do
	mr-solve --arap 4 -s $other --tol 1e-12 posed.mrs -o r.mrs
	off r.mrs base >r.off
	far q.off r.off 1e-6
done
mr-solve --arap 5 posed.mrs -o q.mrs
off q.mrs base >q.off
for other in lu multigrid; do
	mr-solve --arap 5 -s $other --tol 1e-12 posed.mrs -o r.mrs
	off r.mrs base >r.off
	far q.off r.off 1e-6
done
mr-pose tube.mrs | mr-solve --arap 4 -o q.mrs
off q.mrs base >q.off
off tube.mrs base | cmp - q.off && echo "rest is rest"

# Nothing fixed, both handles moved alike: the whole moves along.
mr-select --handle 1=below:z,0.2 s.mrs | mr-solve -o p0.mrs
off p0.mrs base | awk 'NR < 3 || NF != 3 { print; next } { printf "%.17g %.17g %.17g\n", $1 + 1, $2 + 2, $3 + 3 }' >q.off
mr-pose -H 0 --translate 1,2,3 p0.mrs | mr-pose -H 1 --translate 1,2,3 | mr-solve -o r.mrs
off r.mrs base >r.off
far q.off r.off 1e-12

# A sequence of deltas, by one factorization, is the same poses one by one.
mr-solve --no-history s.mrs | mr-pose --translate 0,0,0.5 --rotate 1,0,0,30 --frames 3 | mr-solve --stats stats.json -o all.mrs
mr-export -f off -l base 'all-%d.off' <all.mrs
for i in 1 2 3; do
	turn=$((10 * i))
	mr-solve --no-history s.mrs | mr-pose --translate 0,0,$(awk "BEGIN { printf \"%.17g\", $i / 3 * 0.5 }") --rotate 1,0,0,$turn |
		mr-solve -j 1 | mr-export -f off -l base - | cmp - all-$((i + 1)).off && echo "frame $i is itself"
done

# What -v says.
mr-make sphere -n 200 -o sphere.mrs
mr-select -l mesh --free above:z,0.5 --handle 0=above:z,0.95 sphere.mrs | mr-smooth -t 1 |
	mr-solve -v --flatten 2>&1 >out.mrs

# The regions of base are there to see, once for a key frame and its deltas; those of mesh decide.
mr-solve s.mrs -o p0.mrs
mr-info -l base --check p0.mrs | grep -o 'region  *v u1'
grep -ao region all.mrs | wc -l # mesh's and base's
mr-select --reset --free above:z,0.5 --handle 0=above:z,0.9 p0.mrs | mr-solve -q --flatten --stats stats.json -o q.mrs
mr-select --reset --free above:z,0.5 --handle 0=above:z,0.9 s.mrs | mr-solve -q --flatten --stats other.json -o r.mrs
grep -o '"free":[0-9]*' stats.json >one
grep -o '"free":[0-9]*' other.json | cmp - one && [ -s one ] && echo "mesh decides"
mr-render -l base -c region --size 40x30 -i p0.mrs p0.png && [ -s p0.png ] && echo drawn

# A control mesh keeps its shape, with its basis too: at rest no bit changes, and its poses are those of a solve.
mr-make torus --points 3000 >points.mrs
mr-make torus -n 300 | mr-export -f off - | mr-import -l control - | mr-cat --merge - points.mrs | mr-sample -n 2 |
	mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 -o c.mrs
mr-solve --basis c.mrs -o basis.mrs
mr-pose --rotate 0,1,0,0 basis.mrs | mr-decode -o r.mrs
mr-decode c.mrs -o q.mrs
for layer in control mesh; do
	off q.mrs $layer >q.off
	off r.mrs $layer | cmp - q.off && echo "$layer at rest is at rest"
done
for k in 1 2 3; do
	mr-solve -k $k --basis c.mrs | mr-pose --rotate 0,1,0,40 --translate 0.3,0.2,0.1 --frames 3 | mr-decode -o r.mrs
	mr-pose --rotate 0,1,0,40 --translate 0.3,0.2,0.1 --frames 3 c.mrs | mr-solve -k $k --rotations linear |
		mr-decode -o q.mrs
	for layer in control mesh; do
		mr-export -f off -l $layer 'r-%d.off' <r.mrs
		mr-export -f off -l $layer 'q-%d.off' <q.mrs
		for i in 1 2 3 4; do
			far q-$i.off r-$i.off 4e-12
		done
	done
done
