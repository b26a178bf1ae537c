# Small parts that lie on a large one, too small for the base to have a shape of them, go along with it as they are.
fail=0
box='function box(x, y, z, w, d, h,  i) {
	for (i = 0; i < 8; i++)
		print "v", x + w * (i % 2), y + d * (int(i / 2) % 2), z + h * int(i / 4)
	face[++n] = "1 3 4 2"; face[++n] = "5 6 8 7"; face[++n] = "1 2 6 5"
	face[++n] = "3 7 8 4"; face[++n] = "1 5 7 3"; face[++n] = "2 4 8 6"
}
END {
	for (i = 1; i <= n; i++) {
		split(face[i], v, " ")
		b = 8 * int((i - 1) / 6)
		print "f", v[1] + b, v[2] + b, v[3] + b, v[4] + b
	}
}'
# windows on both sides of a house; slats that two rails hold
awk "$box"' BEGIN { box(0, 0, 0, 12, 4, 8)
	for (i = 0; i < 10; i++) for (j = 0; j < 6; j++) { box(.4 + i * 1.15, -.02, .5 + j * 1.2, .7, .07, .8)
	box(.4 + i * 1.15, 3.95, .5 + j * 1.2, .7, .07, .8) } }' /dev/null >house.obj
awk "$box"' BEGIN { box(0, .05, .4, 20, .05, .15); box(0, .05, 1.5, 20, .05, .15)
	for (i = 0; i < 100; i++) box(i * .2, 0, 0, .12, .05, 2) }' /dev/null >fence.obj

# The most that a diagonal of one of the boxes from the second (third) on grows or shrinks, as a factor.
worst() { # before, after, boxes to leave out
	paste -d ' ' "$1" "$2" | awk -v skip="$3" '
		$1 == "v" {
			i = n++ % 8
			for (k = 0; k < 3; k++) { a[i, k] = $(2 + k); b[i, k] = $(6 + k) }
			if (i < 7 || n <= 8 * skip) next
			for (i = 0; i < 4; i++) {
				s = t = 0
				for (k = 0; k < 3; k++) { s += (a[i, k] - a[7 - i, k]) ^ 2; t += (b[i, k] - b[7 - i, k]) ^ 2 }
				f = sqrt(t > s ? t / s : s / t)
				if (!(f <= most)) most = f
			}
		}
		END { print most }'
}
for edit in 'house --rotate 0,0,1,60 --center 6,2,4' 'fence --translate 6,0,0' 'fence --rotate 0,0,1,60 --center 10,0,1'; do
	# shellcheck disable=SC2086 # options
	set -- $edit
	name=$1
	shift
	mr-import "$name.obj" | mr-smooth | mr-remesh | mr-select --reset --free all --fixed below:x,0.2 --handle 0=above:x,0.8 |
	    mr-encode 2>encode.err | mr-pose -H 0 "$@" | mr-solve | mr-decode 2>err | mr-export after.obj
	boxes=1
	[ "$name" = house ] || boxes=2
	most=$(worst "$name.obj" after.obj $boxes)
	echo "$edit: $most"
	awk -v f="$most" 'BEGIN { exit !(f < 1.3) }' || fail=1
	! grep '\[folded\]' err || fail=1
	! grep warning encode.err || fail=1 # offsets are no harm
done
# What has no edges to bend by is left by what goes along with the bend, which is said; hardly where it is split.
bend() {
	mr-import house.obj | "$@" | mr-smooth | mr-remesh | mr-select --reset --free all --fixed below:x,0.2 --handle 0=above:x,0.8 |
	    mr-encode | mr-pose -H 0 --rotate 0,0,1,60 --center 6,2,4 | mr-solve | mr-decode -o after.mrs
}
bend mr-cat 2>err
share() { # of the vertices that touch, those that do no more, in per cent
	sed -n 's/.* mesh: \([0-9]*\) of \([0-9]*\) vert.*\[apart\].*/\1 \2/p' err | awk '{ n = $1; all = $2 } END { print all ? 100 * n / all : 0 }'
}
[ "$(share)" = 100 ] || { echo "windows leave their walls in silence"; fail=1; }
bend mr-subdivide --longest 0.5 2>err
share | awk '{ print "split: " $0 " %"; exit !($1 < 20) }' || fail=1
exit $fail
