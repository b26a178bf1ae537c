# Openings of the points: left open or closed as asked for, and as many loops through the whole pipe.
topology() {
	mr-info -l "$1" "$2" | sed -n 's/^ *topology *//p; s/^ *flaws *//p' | paste -sd ' ' -
}
stats() {
	python3 -c '
import json
s = json.loads(open("stats.json").readline())
print("method", s["method"], "openings", s["openings"], "holes", s["holes"])'
}
rim() { # the boundary of mesh is within a sampling distance of the points on the mean, and everywhere within three
	mr-export -l points -f xyz - <"$1" >points.xyz
	mr-export -l mesh -f off - <"$1" | awk -v step="$2" '
		FNR == NR { px[NR] = $1; py[NR] = $2; pz[NR] = $3; n = NR; next }
		FNR == 2 { nv = $1 }
		FNR > 2 && FNR <= nv + 2 { x[FNR - 3] = $1; y[FNR - 3] = $2; z[FNR - 3] = $3 }
		FNR > nv + 2 && NF == 4 { edge[$2, $3]; edge[$3, $4]; edge[$4, $2] }
		END {
			for (e in edge) {
				split(e, v, SUBSEP)
				if ((v[2], v[1]) in edge) continue
				rim++
				least = 1e9
				for (i = 1; i <= n; i++) {
					d = (x[v[1]] - px[i])^2 + (y[v[1]] - py[i])^2 + (z[v[1]] - pz[i])^2
					if (d < least) least = d
				}
				sum += sqrt(least)
				if (least > worst) worst = least
			}
			near = rim && sum < rim * step && worst < 9 * step * step
			print (near ? "rim near the points" : "rim off by " sum / rim / step ", " sqrt(worst) / step)
		}' points.xyz -
}
pipe() { # cloud, sampling distance
	mr-import --points "$1" | mr-shrinkwrap --stats stats.json -o wrap.mrs && stats
	mr-simplify wrap.mrs | mr-fit | mr-sample | mr-decode -o out.mrs
	topology control out.mrs
	topology mesh out.mrs
	rim out.mrs "$2"
}

echo 'two thirds of a sphere'
mr-make sphere --points 6000 --seed 5 | mr-export -l points -f xyz - | awk '$3 > -0.3' >cup.xyz
pipe cup.xyz 0.046

echo 'a tube'
mr-make cylinder --points 9000 | mr-export -l points -f xyz - | awk '$3 > -0.9 && $3 < 0.9' >tube.xyz
pipe tube.xyz 0.037

echo 'a terrain with a lake and small gaps'
awk 'BEGIN {
	for (i = 0; i < 8000; i++) {
		seed = (seed * 16807 + 12345) % 2147483647; x = 2 * seed / 2147483647 - 1
		seed = (seed * 16807 + 12345) % 2147483647; y = 2 * seed / 2147483647 - 1
		if ((x - 0.3)^2 + (y - 0.2)^2 > 0.1 && (x + 0.5)^2 + (y + 0.5)^2 > 0.005)
			print x, y, 0.15 * sin(3 * x) * cos(4 * y)
	}
}' >terrain.xyz
pipe terrain.xyz 0.023

echo 'closed, all but wide ones, all but gaps'
awk '!($1 > 0 && $2^2 + $3^2 < 0.03)' cup.xyz >holed.xyz
for lids in all auto none; do
	mr-import --points holed.xyz | mr-shrinkwrap -q --lids $lids --stats stats.json -o wrap.mrs && stats
	topology control wrap.mrs
done

echo 'what may be an opening or a hole is said'
awk '!($1 > 0 && $2^2 + $3^2 < 0.045)' cup.xyz >doubt.xyz
mr-import --points doubt.xyz | mr-shrinkwrap 2>&1 >/dev/null

echo 'flat faces without points are none'
mr-make cube -n 3000 | mr-export -q -f xyz -l mesh - | awk '{ line[NR] = $0; for (k = 1; k <= 3; k++) if ($k > high) high = $k } END {
	for (i = 1; i <= NR; i++) {
		split(line[i], p, " ")
		n = 0
		for (k = 1; k <= 3; k++) n += p[k] > 0.999 * high || p[k] < -0.999 * high
		if (n > 1) print line[i]
	}
}' >frame.xyz
mr-import --points frame.xyz | mr-shrinkwrap -o frame.mrs 2>&1 | grep -c '\['
topology control frame.mrs

echo 'an open scan bent, and made even'
mr-make bumpy --points 6000 | mr-crop --keep below:z,0.5 | mr-shrinkwrap -q | mr-simplify | mr-fit | mr-sample -o scan.mrs
mr-select --reset --free all --fixed below:y,0.3 --handle 0=above:y,0.7 scan.mrs | mr-pose --rotate 1,0,0,30 |
    mr-solve | mr-decode -o bent.mrs
topology mesh bent.mrs
mr-equalize scan.mrs | mr-decode -o even.mrs
topology mesh even.mrs

echo 'nine tenths of a cylinder wrapped from both sides, and open'
mr-make cylinder --points 12000 | mr-export -l points -f xyz - |
	awk '$3 > -0.9 && $3 < 0.9 && sqrt(atan2($2, $1)^2) < 2.83 { print $1, $2, 0.44 * $3 }' >bent.xyz
mr-import --points bent.xyz | mr-shrinkwrap 2>&1 >/dev/null | grep -c uncertain
mr-import --points bent.xyz | mr-shrinkwrap -q --lids none -o bent.mrs
topology control bent.mrs
