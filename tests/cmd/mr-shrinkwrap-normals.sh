# Normals of points, and the places they were seen from, tell sides that no flood from outside reaches, where they fit the points.
topology() {
	mr-info -l control | sed -n 's/^ *topology *//p'
}
normals() { # stats: of how many points sides were taken
	sed 's/.*"sided":\([^,}]*\).*/sides of \1/; /sides of/!s/.*/none given/' "$1"
}
mr-make sphere --points 6000 | mr-export ball.xyz
awk '{ print; print 0.7 * $1, 0.7 * $2, 0.7 * $3, -$4, -$5, -$6 }' ball.xyz >shell.xyz

echo 'a hollow ball, with its normals and without'
mr-import shell.xyz -o shell.mrs
mr-shrinkwrap shell.mrs --stats stats.json | topology
normals stats.json
mr-shrinkwrap -q --ignore-normals shell.mrs --stats stats.json | topology
normals stats.json

echo 'normals of any length, a third without one, one of fifty wrong'
awk '{ l = NR % 3 ? NR % 50 ? NR : -1 : 0; print $1, $2, $3, l * $4, l * $5, l * $6 }' shell.xyz |
	mr-import -f xyz - | mr-shrinkwrap --stats stats.json | topology
normals stats.json

echo 'all inward'
awk '{ print $1, $2, $3, -$4, -$5, -$6 }' shell.xyz | mr-import -f xyz - | mr-shrinkwrap | topology

echo 'those that fit nothing: all alike, and of any sign'
awk '{ print $1, $2, $3, 0, 0, 1 }' ball.xyz | mr-import -f xyz - | mr-shrinkwrap --stats stats.json | topology
normals stats.json
awk '{ s = 2 * (int(NR / 3) % 2) - 1; print $1, $2, $3, s * $4, s * $5, s * $6 }' ball.xyz | mr-import -f xyz - | mr-shrinkwrap | topology
awk '{ print $1, $2, $3, 0, 0, 0 }' ball.xyz | mr-import -f xyz - | mr-shrinkwrap | topology

echo 'seen from six sides, and from the middle; from places that cannot be'
for places in true false; do
	for scan in 0,-5,0,0 0,5,0,0 1,0,-5,0 1,0,5,0 2,0,0,-5 2,0,0,5 3,0,0,0; do
		awk -v scan=$scan -v places=$places '
		BEGIN { split(scan, s, ",") }
		{ # by the largest coordinate; what is inside is seen from the middle
			outer = $1 * $1 + $2 * $2 + $3 * $3 > 0.7
			k = 1
			for (i = 2; i <= 3; i++)
				if ($i * $i > $k * $k)
					k = i
			if (outer ? s[1] != k - 1 || $k * s[k + 1] < 0 : s[1] != 3)
				next
			line[n++] = $0
		}
		END {
			if (places == "false") # each ray has a scanner of its own, anywhere
				for (i = 0; i < n; i++)
					write(i, i + 1, sin(12.9898 * i) * 9, sin(78.233 * i) * 9, sin(37.719 * i) * 9)
			else
				write(0, n, s[2], s[3], s[4])
		}
		function write(from, to, x, y, z) {
			print to - from "\n1\n" x, y, z "\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" x, y, z, 1
			for (; from < to; from++) {
				split(line[from], p, " ")
				print p[1] - x, p[2] - y, p[3] - z, 0.5
			}
		}' shell.xyz
	done >$places.ptx
	mr-import $places.ptx | mr-shrinkwrap --stats stats.json | topology
	normals stats.json
done
echo 'normals that are turned over in one half'
mr-make torus --points 12000 | mr-normals -q | mr-export -q -f xyz - | awk '{ s = $1 > 0 ? -1 : 1; $4 *= s; $5 *= s; $6 *= s; print }' >half.xyz
mr-import half.xyz | mr-shrinkwrap | mr-info -l control | grep -o 'genus 1'
