# The report of surfaces whose figures are known, for people and as JSON.
figure() { # FILE NAME: a figure of the layer mesh
	mr-info --json "$1" | sed "s/.*\"mesh\":{//; s/.*\"$2\":\([^,}]*\).*/\1/"
}
near() { # WHAT VALUE EXPECTED TOLERANCE
	awk -v w="$1" -v x="$2" -v y="$3" -v t="$4" 'BEGIN {
		d = x - y; print w, (x != "" && d <= t && -d <= t) ? "ok" : "bad: " x " is not " y }'
}

mr-make sphere -n 10000 >sphere.mrs
near "sphere area" "$(figure sphere.mrs area)" 12.566370614 0.01
near "sphere volume" "$(figure sphere.mrs volume)" 4.188790205 0.005
near "sphere diagonal" "$(figure sphere.mrs diagonal)" 3.4641016 0.001
echo "sphere $(figure sphere.mrs genus) $(figure sphere.mrs euler) $(figure sphere.mrs intersecting_pairs)"
mr-make torus >torus.mrs
near "torus area" "$(figure torus.mrs area)" 15.791367042 0.02
near "torus volume" "$(figure torus.mrs volume)" 3.158273408 0.01
echo "torus $(figure torus.mrs genus) $(figure torus.mrs euler) $(figure torus.mrs valence6)"
mr-make boxes --genus 5 >boxes.mrs
echo "boxes $(figure boxes.mrs genus) $(figure boxes.mrs boundary_loops) $(figure boxes.mrs components)"
mr-make cylinder --open >tube.mrs
echo "tube $(figure tube.mrs euler) $(figure tube.mrs boundary_loops) $(figure tube.mrs volume)"
mr-make plane -n 100 >plane.mrs
mr-info plane.mrs
echo "without a search: $(mr-info --no-intersections --json torus.mrs | grep -c '"intersecting_pairs":null')"
echo "in words: $(mr-info --no-intersections torus.mrs | grep flaws)"

# a frame a line; a delta reports what it holds
mr-cat sphere.mrs torus.mrs | mr-info --json | grep -c '^{"frame":[12],"name":"[a-z]*","key":true,.*}$'
mr-make sphere -n 12 --points 3 | mr-info | sed 's/[0-9.e-]*[0-9]\.[0-9e.-]*/#/g'

# the same bytes for any number of threads
mr-info -j1 --json sphere.mrs >one
mr-info -j2 --json sphere.mrs >two
cmp one two && echo "threads ok"

# what would overflow is not computed, and said
printf 'OFF\n4 4 0\n0 0 0\n1e300 0 0\n0 1e300 0\n0 0 1e300\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' >huge.off
mr-import huge.off >huge.mrs
mr-info huge.mrs | grep invalid
mr-info --json huge.mrs | grep -o '"invalid.*'
mr-compare -a mesh -b mesh -i huge.mrs 2>&1 || echo "exit $?"
# The history has what changes a result: the layer, and not the threads.
mr-make sphere -n 50 -j 2 | mr-select -l mesh --free all -j1 | mr-select -qlmesh --layer=mesh --fixed all | mr-info | grep -A 3 history
echo 'what a terminal would obey is not shown'
mr-make cube -n 8 >plain.mrs
python3 - <<'X'
import records
def odd(layer, name, shape, rows, data):
    return layer, name, shape, rows, data.replace(b"mr-make", b"\x1b\x9b\0\xc2\x9b\xc3\xa9") if name == b"history" else data
open("odd.mrs", "wb").write(records.changed(open("plain.mrs", "rb").read(), odd))
X
mr-info odd.mrs | grep history

echo 'a face 300 times, and a flat vertex with 6000 faces'
awk 'BEGIN { print "OFF\n3 300 0\n0 0 0\n1 0 0\n0 1 0"; for (i = 0; i < 300; i++) print 3, 0, 1, 2 }' >many.off
awk 'BEGIN { n = 6000; print "OFF\n" n + 1, n, "0\n0 0 0"; for (i = 0; i < n; i++) print cos(6.28 * i / n), sin(6.28 * i / n), 0
	for (i = 1; i <= n; i++) print 3, 0, i, i % n + 1 }' >disc.off
for model in many disc; do
	timeout 60 mr-info $model.off | grep flaws
done
