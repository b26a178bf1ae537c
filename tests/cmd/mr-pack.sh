# Packed surfaces: the error that is asked for, measured from outside; creases, boundaries, colours, names.
mr-make torus --points 20000 -o points.mrs
mr-make torus -n 8000 -o torus.mrs
mr-simplify -q --to control -n 200 torus.mrs | mr-fit -q | mr-sample -q -n 3 -o surface.mrs

echo 'error: reached, and measured again'
for e in 0.04% 0.02%; do
	mr-pack -e $e surface.mrs a.mrz --stats stats.json
	mr-unpack a.mrz | mr-decode -q | mr-compare --json - torus.mrs >c.json
	python3 - $e stats.json c.json <<'PY'
import json, os, sys
want = float(sys.argv[1][:-1]) / 100
said, seen = json.load(open(sys.argv[2])), json.load(open(sys.argv[3]))
mean = (seen["a_to_b"]["mean"] + seen["b_to_a"]["mean"]) / 2 / seen["diagonal"]
print(sys.argv[1], 0.9 * want < mean <= 1.01 * want, abs(mean - said["error"]) < 0.02 * mean,
      said["bytes"] == os.path.getsize("a.mrz"), said["bytes"] < 3000)
PY
done

echo 'a number of bytes: about as good as the error that takes as many'
mr-make bumpy -n 20000 | mr-simplify -q --to control -n 1200 | mr-fit -q | mr-sample -q -n 3 -o bumpy.mrs
for e in 0.05% 0.02%; do
	mr-pack -e $e bumpy.mrs by-error.mrz --stats by-error
	mr-pack -n "$(wc -c <by-error.mrz)" bumpy.mrs by-bytes.mrz --stats by-bytes
	python3 -c 'import json
a, b = (json.load(open(f))["error"] for f in ("by-error", "by-bytes")); print(b < 1.3 * a)'
done

echo 'threads, and once more: the same bytes'
mr-pack -j 1 -e 0.02% surface.mrs one.mrz
mr-pack -j 3 -e 0.02% surface.mrs three.mrz
cmp one.mrz three.mrz && echo same
mr-unpack one.mrz | mr-pack -n 100000 - - >again.mrz && mr-unpack again.mrz | mr-decode -q -o again.mrs
mr-unpack one.mrz | mr-decode -q | mr-compare --json - again.mrs | python3 -c 'import json, sys
j = json.load(sys.stdin); print(max(j["a_to_b"]["max"], j["b_to_a"]["max"]) < 2e-5 * j["diagonal"])'

echo 'creases of a cube, the boundary of a plane, parts'
mr-make cube -n 3000 | mr-simplify -q --to control -n 60 | mr-fit -q | mr-sample -q -n 3 | mr-pack - cube.mrz
mr-unpack cube.mrz | mr-info | grep -E 'crease|topology'
mr-unpack cube.mrz | mr-decode -q | mr-info | grep -oE 'area [0-9.]+, volume [0-9.]+' | head -n 1
mr-make plane -n 900 -o plane.mrs
mr-make sphere -n 900 | mr-transform --translate 0,0,3 | mr-cat --append plane.mrs - -o two.mrs
mr-simplify -q --to control -n 80 two.mrs | mr-fit -q | mr-sample -q -n 2 | mr-pack -e 0.05% - two.mrz
mr-unpack two.mrz | mr-info | grep topology

echo 'colours, and what stays behind'
cat >colors.py <<'PY'
import sys
from records import read, record
for layer, name, shape, rows, data in read(sys.stdin.buffer.read()):
    sys.stdout.buffer.write(record(layer, name, shape, rows, data))
    if name == b"height":
        sys.stdout.buffer.write(record(layer, b"color", b"vb\4", rows, bytes([200, 100, 30, 255]) * rows))
        sys.stdout.buffer.write(record(layer, b"heat", b"vd\1", rows, bytes(8 * rows)))
PY
PYTHONPATH="$TOP/tests" python3 colors.py <surface.mrs | mr-pack -e 0.1% - colors.mrz
mr-unpack colors.mrz -o colors.mrs
PYTHONPATH="$TOP/tests" python3 -c 'import records
print(set(records.first_frame("colors.mrs")["displacement", "color"]))'

echo 'points; several frames'
mr-shrinkwrap -q points.mrs | mr-simplify -q -n 300 | mr-fit -q | mr-sample -q | mr-pack -e 0.05% - p.mrz --stats stats.json
python3 -c 'import json; print(json.load(open("stats.json"))["error"] < 5.1e-4)'
mr-cat surface.mrs surface.mrs | mr-pack -n 1500 - 'f-%d.mrz' && ls f-*.mrz
mr-unpack f-1.mrz f-2.mrz | mr-info | grep -E '^[a-z]+: frame'
