# Clouds that do not tell their surface all over.
wrapped() { # cloud, option
	mr-import "$1" | mr-shrinkwrap -q ${2:+--lids "$2"} --stats stats.json | mr-info -l control | sed -n 's/^ *topology *//p; s/^ *flaws *//p'
}

echo lands of a globe and few points between:
mr-make sphere --points 60000 --seed 3 | mr-export -l points -f xyz - |
	awk '{
		f = sin(3 * $1 + 1) * cos(4 * $2) + sin(5 * $3 + 2 * $1) + 0.7 * cos(7 * $2 - 3 * $3)
		if (f > 0.7 || NR % 300 == 0) print
	}' >lands.xyz
wrapped lands.xyz all
mr-import lands.xyz | mr-shrinkwrap -q --lids all -m volume | mr-info -l control | sed -n 's/.*\(genus [0-9]*\).*/by the volume \1/p'

echo slices of a solid, of which one settles into the next:
awk 'BEGIN {
	for (z = 0; z < 60; z++)
		for (i = 0; i < 6; i++)
			for (k = 0; k < 30; k++)
				print i + 0.525 * k, 1.5 * k - 0.1 * i, 8 * z
}' >slices.xyz
wrapped slices.xyz

echo a point far away, and a thin part that is left out:
mr-make knot --points 4000 | mr-export -l points -f xyz - | cut -d ' ' -f 1-3 >knot.xyz
{ cat knot.xyz; echo 100 0 0; } >stray.xyz
mr-import stray.xyz | mr-shrinkwrap -o stray.mrs
mr-info -l control stray.mrs | sed -n 's/^ *topology *//p'
mr-make sphere --points 30 --seed 2 | mr-export -l points -f xyz - | awk '{ print $1 + 5, $2, $3 }' | cat knot.xyz - >two.xyz
mr-import two.xyz | mr-shrinkwrap 2>&1 >/dev/null

echo parts further apart than a grid can hold:
{ cat knot.xyz; awk '{ print $1 + 1e5, $2, $3 }' knot.xyz; } >apart.xyz
mr-import apart.xyz | mr-shrinkwrap
echo "exit $?"

echo points in a plane, and what they make down the pipe, a stray one apart:
mr-make plane --points 3000 | mr-export -l points -f xyz - | cut -d ' ' -f 1-3 >flat.xyz
{ cat flat.xyz; echo 100 0 0; } >flat-stray.xyz
for f in flat flat-stray; do
	mr-import $f.xyz | mr-shrinkwrap -q | mr-simplify | mr-fit -q | mr-sample -q | mr-decode | mr-info -l mesh - | sed -n 's/^ *topology *//p'
done
mr-import flat.xyz | mr-shrinkwrap --lids all
echo "exit $?"
{ cat knot.xyz; echo 1e7 0 0; } >farther.xyz
mr-import farther.xyz | mr-shrinkwrap -q | mr-simplify | mr-fit -q | mr-sample -q | mr-decode | mr-info -l mesh - | sed -n 's/^ *topology *//p'

echo 'a height field faces the side of the normals, of the scanner, or of most' >&2
awk 'BEGIN { print "# x y z nx ny nz"; for (i = 0; i < 1600; i++) { x = i % 40 / 20; y = int(i / 40) / 20; print x + sin(i) / 90, y + cos(i) / 90, 0.1 * x * x, 0.2 * x, 0, -1 } }' >down.xyz
awk '!/#/ { $6 = NR % 3 ? -1 : 1; $4 = 0 } 1' down.xyz >mixed.xyz
for cloud in down mixed; do
	mr-shrinkwrap $cloud.xyz | mr-normals -l control | mr-export -q -l control -f xyz - | awk '!/#/ { n[$6 > 0 ? "up" : "down"]++ } END { for (i in n) print i }'
done
