# What turning handles do to the volume that a surface encloses: measured, and warned of from a tenth on.
ends() { # axis: fixed below, a handle above
	mr-select --reset --free all --fixed "below:$1,0.2" --handle "0=above:$1,0.8"
}
bent() { # shape, axis, pose, how to solve: what is said of the volume
	mr-make "$1" | mr-smooth | mr-remesh -q | ends "$2" | mr-encode -o rest.mrs
	mr-pose $3 rest.mrs | mr-solve $4 | mr-decode -o posed.mrs 2>said
	grep -o 'the volume .*' said || echo none
}
volume() { # of a stream's mesh, by an OFF of it
	mr-export -f off - <"$1" | awk '
		NR == 2 { nv = $1; next }
		NR > 2 && NR <= nv + 2 { x[NR - 3] = $1; y[NR - 3] = $2; z[NR - 3] = $3; next }
		NR > 2 {
			a = $2; b = $3; c = $4
			v += (x[a] * (y[b] * z[c] - z[b] * y[c]) + y[a] * (z[b] * x[c] - x[b] * z[c]) + z[a] * (x[b] * y[c] - y[b] * x[c])) / 6
		}
		END { print v }'
}
echo 'a twist by a right angle, linearly, thins a limb, and an interpolated one keeps it'
bent cylinder z '--rotate 0,0,1,90' '--rotations linear'
echo "$(volume rest.mrs) $(volume posed.mrs) $(sed -n 's/.*volume has changed by \([-0-9]*\) .*/\1/p' said)" |
    awk '{ d = 100 * ($2 / $1 - 1) - $3; print "as the volumes of the two surfaces are:", d * d < 0.3 ? "ok" : d }'
bent cylinder z '--rotate 0,0,1,90' ''

echo 'what is asked for is not warned of: translations, scales'
bent cylinder z '--translate 0,0,1' ''
bent cylinder z '--translate 0,0,-1' ''
bent cylinder z '--rotate 0,0,1,20 --scale 1.5' ''

echo 'handles that turn all the way around are where they were'
bent sphere z '--rotate 0,1,0,720' ''
echo 'a translation may turn it inside out'
bent cylinder z '--translate 0,0,-9' ''

echo 'a pose that goes on is judged as a whole, and at any gain'
bent cylinder z '--rotate 0,0,1,90' '--rotations linear'
mr-pose --rotate 0,0,1,90 rest.mrs | mr-solve --rotations linear | mr-pose --translate 0,0,0.01 | mr-solve |
    mr-decode 2>&1 >/dev/null | grep volume
mr-pose --rotate 0,0,1,90 rest.mrs | mr-solve --rotations linear | mr-decode --gain 1.5 2>&1 >/dev/null | grep volume
mr-pose --rotate 0,0,1,90 rest.mrs | mr-solve --rotations linear | mr-decode -q | mr-pose --translate 0,0,0.01 | mr-solve |
    mr-decode 2>&1 >/dev/null | grep volume || echo 'decoded between: none'

echo "parts count that are closed, whichever way they turn, as do all others"
mr-make cylinder -o tube.mrs
mr-make plane -n 9 | mr-transform --translate 5,0,0 -o sheet.mrs
mr-export -q -f off - <tube.mrs | awk 'NF == 4 { print $1, $2, $4, $3; next } { print }' | mr-import - | mr-transform --translate 9,0,0 -o inward.mrs
for other in sheet inward; do
	mr-cat --append tube.mrs $other.mrs | mr-smooth | mr-remesh | ends z | mr-encode | mr-pose --rotate 0,0,1,90 |
	    mr-solve --rotations linear | mr-decode 2>&1 >/dev/null | grep volume
done
echo "a surface with a boundary encloses none"
bent plane x '--rotate 0,0,1,90' '--rotations linear'

echo 'a sequence tells of it once, and again where the loss has doubled; of frames behind a key again'
mr-make cylinder | mr-smooth | mr-remesh | ends z | mr-encode | mr-pose --rotate 0,0,1,170 --frames 10 >poses.mrs
mr-cat poses.mrs poses.mrs | mr-solve --rotations linear | mr-decode 2>&1 >/dev/null | grep volume

echo 'a control mesh that is posed does it to its displaced surface'
mr-make cylinder --points 3000 -o points.mrs
mr-make cylinder -n 500 | mr-export -f off - | mr-import -q -l control - | mr-cat --merge - points.mrs | mr-sample -q |
    ends z | mr-pose --rotate 0,0,1,90 | mr-solve --rotations linear | mr-decode 2>&1 >/dev/null | grep volume
