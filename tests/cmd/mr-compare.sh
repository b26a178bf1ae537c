# Distances that are known, between meshes and clouds, in one stream and two.
top() { # FILE NAME
	sed "s/.*\"$2\":\([^,}]*\).*/\1/" "$1"
}
near() { # WHAT VALUE EXPECTED TOLERANCE
	awk -v w="$1" -v x="$2" -v y="$3" -v t="$4" 'BEGIN {
		d = x - y; print w, (x != "" && d <= t && -d <= t) ? "ok" : "bad: " x " is not " y }'
}
first() { # FILE PART NAME: of the part alone
	sed "s/.*\"$2\":{\([^}]*\)}.*/\1/; s/.*\"$3\":\([^,}]*\).*/\1/" "$1"
}

# a sphere in its cube: 0 at the sides, sqrt 3 - 1 at the corners
mr-make sphere -n 40000 >sphere.mrs
mr-make cube -n 2000 >cube.mrs
mr-compare --json -i sphere.mrs cube.mrs >c
near "corner" "$(first c b_to_a max)" 0.7320508 1e-4
near "bound" "$(first c b_to_a max_bound)" 0.7320508 1e-3
near "both" "$(first c both max)" 0.7320508 1e-4
near "relative" "$(first c both_relative max)" 0.2113249 1e-4
near "sides" "$(first c a_to_b min)" 0 1e-4
# the mean distance 1 - max(|x|, |y|, |z|) over the sphere, by the same integral in angles
near "mean" "$(first c a_to_b mean)" "$(awk 'BEGIN {
	n = 300; pi = atan2(0, -1)
	for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
		z = (i + 0.5) / n; p = (j + 0.5) / n * pi / 2; r = sqrt(1 - z * z); x = r * cos(p); y = r * sin(p)
		s += 1 - (x > y ? (x > z ? x : z) : (y > z ? y : z)) }
	printf "%.9f", s / n / n }')" 1e-4
echo "corresponds $(top c corresponds)"

# a surface and itself, and itself with noise: vertex by vertex
mr-make torus >torus.mrs
mr-compare --json -i torus.mrs torus.mrs >c
echo "itself $(top c corresponds) $(top c vertex_max) $(top c stretch_min) $(top c stretch_max)"
near "at itself" "$(first c both max)" 0 1e-12
mr-make torus --noise 0.01 | mr-compare --json torus.mrs >c
near "noise" "$(top c vertex_rms)" 0.01 0.0005
awk -v max="$(top c vertex_max)" -v both="$(first c both max)" 'BEGIN { print both <= max ? "nearer ok" : "bad" }'

# a cloud on its surface: nearer than the sagitta; vertices alone are the points
mr-make sphere -n 40000 --points 2000 >cloud.mrs
mr-cat --merge sphere.mrs cloud.mrs | mr-compare --json -a points -b mesh >c
near "cloud" "$(first c a_to_b max)" 0 1e-12
echo "samples $(first c a_to_b samples)"
mr-compare --vertices --json -i sphere.mrs cube.mrs >c
near "vertices" "$(first c a_to_b samples)" "$(mr-info --json sphere.mrs | sed 's/.*"vertices":\([0-9]*\).*/\1/')" 0

# the same bytes for any number of threads
mr-compare -j1 --json -i torus.mrs cube.mrs >one
mr-compare -j2 --json -i torus.mrs cube.mrs >two
cmp one two && echo "threads ok"

# for people: what is rounding here is not printed
mr-make plane -n 9 >plane.mrs
mr-compare -i plane.mrs plane.mrs | sed 's/[0-9.]*e-[0-9]*/0/g; s/  *0/ 0/g'

# a surface without area has its faces' vertices alone
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 5\nf 1 2 3\n' >line.obj
mr-compare --json line.obj line.obj >json || exit
near "isolated of no area" "$(first json both hausdorff)" 0 1e-12
echo '-- the layer of one name, where the second was worked on in another'
mr-make bumpy -n 500 -o bumpy.mrs
mr-remesh -q bumpy.mrs -o remeshed.mrs
mr-compare bumpy.mrs remeshed.mrs 2>&1 >out | grep -o 'mesh of the second.*'
mr-compare -b base bumpy.mrs remeshed.mrs 2>&1 >out
mr-compare remeshed.mrs bumpy.mrs 2>&1 >out

echo '-- surfaces that are only elsewhere'
mr-transform --rotate 1,2,3,20 bumpy.mrs | mr-compare bumpy.mrs 2>&1 >out | grep -o 'mesh: .*'
mr-transform --scale 1.2 bumpy.mrs | mr-compare bumpy.mrs 2>&1 >out
mr-make knot -n 500 | mr-compare bumpy.mrs 2>&1 >out
