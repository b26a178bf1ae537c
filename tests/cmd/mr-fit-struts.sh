# A frame of struts as thick as 5 spacings, whose control mesh has few faces by the number of the points: junctions are not
# webbed, and the volume is what it is in closed form, 12 struts of 0.2 by 0.2 by 1.8 and 8 corners of 0.2 to the third.
figure() { # file, name: a figure of --stats
	sed "s/.*\"$2\":\([^,}]*\).*/\1/" "$1"
}
awk 'function within(t) { return t > 1e-9 - 1.1 && t < 1.1 - 1e-9 }
	function beside(t) { t = t < 0 ? -t : t; return t > 0.9 + 1e-9 && t < 1.1 - 1e-9 }
	function is_inside(x, y, z) { return beside(x) + beside(y) + beside(z) >= 2 && within(x) && within(y) && within(z) }
	BEGIN {
		s = 1
		while (count < 10000) {
			for (i = 0; i < 4; i++) { s = (s * 16807) % 2147483647; r[i] = s / 2147483647 }
			strut = int(12 * r[0]); axis = strut % 3; side = int(4 * r[1]); t = 0.2 * r[2] - 0.1
			c[axis] = 2.2 * r[3] - 1.1
			c[(axis + 1) % 3] = (strut % 2 ? 1 : -1) + (side < 2 ? t : side == 2 ? 0.1 : -0.1)
			c[(axis + 2) % 3] = (strut < 6 ? 1 : -1) + (side > 1 ? t : side ? 0.1 : -0.1)
			if (!is_inside(c[0], c[1], c[2]) && ++count) print c[0], c[1], c[2]
		}
	}' >frame.xyz
mr-import --points frame.xyz | mr-shrinkwrap | mr-simplify --stats control.json | mr-fit | mr-sample --stats result.json | mr-decode -o result.mrs
mr-info --json -l mesh result.mrs >mesh.json
awk -v faces="$(figure control.json faces)" -v far="$(figure result.json surface_to_points_max)" -v volume="$(figure mesh.json volume)" \
    -v euler="$(figure mesh.json euler)" 'BEGIN {
	print "genus", 1 - euler / 2
	print (faces > 312 && faces <= 2000 ? "more faces than by the points" : faces " faces")
	print (far < 0.1 ? "no webs" : "webs " far " wide")
	volume /= 12 * 0.2 * 0.2 * 1.8 + 8 * 0.2 ^ 3
	print (volume > 0.97 && volume < 1.01 ? "its volume" : volume " of its volume") }'
