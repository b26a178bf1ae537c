# Height fields one over the other stay apart; what faces outward on both sides, or has points on its walls, is a slab.
cloud() { # gap in spacings, corner and side of the upper sheet, z of the lower normals, walls: 60 places a side
	awk -v gap="$1" -v from="$2" -v to="$3" -v down="$4" -v walls="$5" '
	function noise() { return ((seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5) * 0.6 }
	function put(x, y, z, nx, ny, nz) { # turned, so that no sheet lies along an axis
		print 0.6 * x - 0.8 * z, y, 0.8 * x + 0.6 * z, 0.6 * nx - 0.8 * nz, ny, 0.8 * nx + 0.6 * nz
	}
	BEGIN {
		seed = 7
		print "# x y z nx ny nz"
		for (x = 0; x < 60; x++)
			for (y = 0; y < 60; y++) {
				put(x + noise(), y + noise(), 0, 0, 0, down)
				if (x >= from && x < to && y >= from && y < to)
					put(x + noise(), y + noise(), gap, 0, 0, 1)
			}
		for (z = 0.5; walls && z < gap; z++)
			for (x = 0; x < 60; x++) {
				put(x + noise(), 0, z, 0, -1, 0)
				put(x + noise(), 59, z, 0, 1, 0)
				put(0, x + noise(), z, -1, 0, 0)
				put(59, x + noise(), z, 1, 0, 0)
			}
	}'
}
wrapped() { # what, and a cloud's numbers
	what=$1
	shift
	cloud "$@" >c.xyz
	for ignore in "" --ignore-normals; do
		mr-import c.xyz | mr-shrinkwrap $ignore | mr-info -l control | sed -n "s/^ *topology */$what: /p"
	done
}

for gap in 3 5 10; do
	wrapped "two sheets, $gap apart" $gap 0 60 1
	wrapped "floor and table, $gap apart" $gap 20 40 1
	wrapped "slab, $gap thick" $gap 0 60 -1 walls
done
cloud 5 0 60 -1 >c.xyz
mr-import c.xyz | mr-shrinkwrap -q | mr-info -l control | sed -n 's/^ *topology */faces of a slab: /p'
cloud 5 0 60 1 >c.xyz
echo sides of the normals:
mr-import c.xyz | mr-shrinkwrap | mr-normals -l control | mr-export -q -l control -f xyz - | awk '!/#/ { n[$6 > 0 ? "up" : "down"]++ } END { for (i in n) print i }'
echo an open book, its normals inward:
awk 'BEGIN {
	print "# x y z nx ny nz"
	for (i = 0; i < 3600; i++) {
		x = int(i / 60) + 0.3 * sin(i * i)
		y = i % 60 + 0.3 * cos(i * i)
		print x, y, 0, 0, 0, 1
		print 0.77 * x, y, 0.64 * x, 0.64, 0, -0.77
	}
}' >book.xyz
mr-import book.xyz | mr-shrinkwrap -q -o book.mrs
mr-info -l control book.mrs | sed -n 's/^ *topology *//p'
mr-normals -l control book.mrs | mr-export -q -l control -f xyz - | awk '!/#/ && $3 < 1 && $1 > 20 && $1 < 57 { n[$6 > 0 ? "up" : "down"]++ } END { for (i in n) print i }'
