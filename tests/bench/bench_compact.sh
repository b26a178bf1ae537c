# Bytes at equal mean error, ours (examples/pack.sh) and Draco: for each model and error bytes of both, their ratio,
# and ours at our maximal error against Draco's smallest file that is as good; then geometric means.  Draco's bytes at our
# mean error are those between its steps of quantisation, by the straight line of logarithms.  Then of each model bytes
# and error of a GLB with EXT_meshopt_compression behind zstd, and of mr-cat -z, which loses nothing.  `noise-`, `open-`
# and `colored-` models stay out of the means.
# Knobs: ERRORS (default 0.02% 0.01% 0.005% 0.0025%), MODELS (a pattern of names), PICTURE (a PNG: bytes over errors).
# Without $DATA/meshes shapes of mr-make.
command -v draco_encoder >/dev/null || { echo "no draco_encoder: the package draco"; exit 1; }
compare() { # model, other: mean and maximum of both ways, in per cent of the diagonal
	mr-compare -q --json "$2" "$1" | python3 -c 'import json, sys
j = json.load(sys.stdin)
a, b, d = j["a_to_b"], j["b_to_a"], j["diagonal"] / 100
print((a["mean"] + b["mean"]) / 2 / d, max(a["max"], b["max"]) / d)'
}
draco() { # name: lines of bytes, mean, maximum
	for bits in 7 8 9 10 11 12 13; do
		draco_encoder -i "$1.ply" -o d.drc -cl 10 -qp $bits --skip NORMAL --skip TEX_COORD >/dev/null &&
		    draco_decoder -i d.drc -o d.ply >/dev/null && mr-import -q d.ply -o d.mrs
		echo "$(wc -c <d.drc) $(compare "$1.mrs" d.mrs)"
	done
}
others() { # name
	mr-export -q --quantize --compress --no-normals -i "$1.mrs" g.glb && zstd -q -19 -f g.glb
	mr-import -q --weld 0 g.glb -o g.mrs
	set -- "$1" "$(wc -c <g.glb.zst)" $(compare "$1.mrs" g.mrs) "$(mr-cat -z "$1.mrs" | wc -c)"
	printf '%s: GLB with meshopt and zstd %d bytes, mean %.4f %%; mr-cat -z %d bytes\n' "$1" "$2" "$3" "$5"
}
one() { # name
	echo "$1" | grep -qE -e "${MODELS:-.}" || return 0
	draco "$1" >peer
	awk -v name="$1" '{ print name "-draco", $2, $1 }' peer >>points
	for e in ${ERRORS:-0.02% 0.01% 0.005% 0.0025%}; do
		sh "$TOP/examples/pack.sh" "$1.ply" "$1.mrz" $e >tries || exit
		mr-unpack "$1.mrz" | mr-decode -q -o u.mrs
		set -- "$1" $(wc -c <"$1.mrz") $(compare "$1.mrs" u.mrs)
		echo "$1 $e $2 $3 $4"
		echo "$1-mr $3 $2" >>points
	done | python3 -c 'import math, sys
peer = [tuple(map(float, l.split())) for l in open("peer")]
for line in sys.stdin:
    name, want, size, mean, most = line.split()
    x = math.log(float(mean))
    a, b = next(((a, b) for a, b in zip(peer, peer[1:]) if x >= math.log(b[1])), peer[-2:])
    share = min(1, (math.log(a[1]) - x) / (math.log(a[1]) - math.log(b[1])))
    at_mean = a[0] * (b[0] / a[0]) ** share
    at_most = min((p[0] for p in peer if p[2] <= float(most)), default=peer[-1][0])
    print(f"{name}-{want} mr {size} bytes\n{name}-{want} draco {at_mean:.0f} bytes")
    print(f"{name} {want}: mean {float(mean):.4f} %, largest {float(most):.3f} %, ratio {float(size) / at_mean:.3f},",
          f"at equal maximum {float(size) / at_most:.3f}", flush=True)'
	others "$1"
}
model() { # name, file in $DATA/meshes, vertices of a shape instead
	if [ -e "$DATA/meshes/$2" ]; then
		mr-import -q --repair "$DATA/meshes/$2" -o "$1.mrs"
	else
		mr-make bumpy -n "$3" -o "$1.mrs"
	fi
	mr-export -q --float -i "$1.mrs" "$1.ply"
}
varied() { # name, what: noise of 0.05 % of the diagonal, or color by place; makes WHAT-NAME
	PYTHONPATH=$TOP/tests python3 - "$1" "$2" <<'PY'
import random, struct, sys
from records import numbers, read, record
name, what = sys.argv[1:]
random.seed(1)
with open(name + ".mrs", "rb") as source, open(what + "-" + name + ".mrs", "wb") as out:
    for layer, column, shape, rows, data in read(source.read()):
        more = b""
        if column == b"position":
            p = numbers(shape, data)
            low, high = ([f(p[k::3]) for k in range(3)] for f in (min, max))
            diagonal = sum((b - a) ** 2 for a, b in zip(low, high)) ** 0.5
            if what == "noise":
                data = struct.pack("<%dd" % len(p), *(x + random.gauss(0, 5e-4 * diagonal) for x in p))
            else:
                rgb = [int(40 + 200 * (x - low[i % 3]) / (high[i % 3] - low[i % 3])) for i, x in enumerate(p)]
                more = record(layer, b"color", b"vb\4", rows,
                    bytes(x for i in range(rows) for x in (*rgb[3 * i:3 * i + 3], 255)))
        out.write(record(layer, column, shape, rows, data) + more)
PY
	mr-export -q --float -i "$2-$1.mrs" "$2-$1.ply"
}

if [ -d "$DATA/meshes" ]; then
	for m in bunny00.off.gz stanford-bunny.obj.gz armadillo.off.gz igea.ply.gz horse.ply.gz nefertiti.obj.gz \
	    fertility.off lucy.ply.gz rocker-arm.obj.gz camel.off.gz; do
		model "${m%%.*}" $m
		one "${m%%.*}"
	done
	model noise-max max-noisy.obj.gz && one noise-max
	for m in bunny00 nefertiti; do
		[ ! -e $m.mrs ] || { varied $m noise && one noise-$m; }
	done
	model open-face face.obj.gz && one open-face
	varied bunny00 colored && one colored-bunny00
else
	for n in 5000 30000; do
		model bumpy-$n none $n
		one bumpy-$n
	done
fi | tee rows
python3 -c 'import math, re
rows = {}
for r in re.findall(r"^(?!noise-|open-|colored-)\S+ (\S+): .*ratio ([0-9.]+), at equal maximum ([0-9.]+)", open("rows").read(), re.M):
    rows.setdefault(r[0], []).append((float(r[1]), float(r[2])))
for want, r in rows.items():
    for k, word in enumerate(("equal mean", "equal maximum")):
        mean = math.exp(sum(math.log(x[k]) for x in r) / len(r))
        worst = max(x[k] for x in r)
        print(f"{len(r)} models at {want}, {word}: geometric mean of ratios {mean:.3f}, worst {worst:.3f}")'
[ -z "${PICTURE:-}" ] || grep -E '^(bunny00|stanford-bunny|armadillo|igea)-' points |
    plot "$PICTURE" 'Bytes of a surface: packed, and by Draco' 'mean error, per cent of the diagonal' bytes
