# A cloud with 1.5 % noise and a quarter of outliers: near to the truth, and of its genus.
dirty() { # three tenths as many points anywhere in the box
	awk 'function uniform() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
		BEGIN { seed = 4 }
		{
			print $1, $2, $3
			for (k = 1; k <= 3; k++) {
				if (NR == 1 || $k < low[k]) low[k] = $k
				if (NR == 1 || $k > high[k]) high[k] = $k
			}
		}
		END {
			for (i = 0; i < 0.3 * NR; i++) {
				for (k = 1; k <= 3; k++) p[k] = low[k] + (high[k] - low[k]) * uniform()
				print p[1], p[2], p[3]
			}
		}'
}
mr-make bumpy -n 4000 --points 3000 --noise 1.5% --seed 3 | mr-export -l points -f xyz - | dirty >dirty.xyz
mr-import --points dirty.xyz | mr-shrinkwrap -q -o out.mrs
mr-info -l control out.mrs | sed -n 's/^ *topology *//p; s/^ *flaws *//p'
mr-make bumpy -n 20000 | mr-compare --json -a mesh -b control out.mrs |
	sed 's/.*"both_relative":{\([^}]*\)}.*/\1/; s/.*"mean":\([^,}]*\).*/\1/' |
	awk '{ print $1 < 0.007 ? "near" : "off by " $1 }'
mr-import --points dirty.xyz | mr-shrinkwrap -q -j 1 | mr-export -f off -l control - >one.off
mr-export -f off -l control - <out.mrs | cmp - one.off && echo same for -j 1
