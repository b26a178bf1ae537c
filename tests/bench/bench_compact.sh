# Bytes at equal mean error, ours (examples/pack.sh) and Draco: for each model and error bytes of both, their ratio,
# and ours at our maximal error against Draco's smallest file that is as good; then geometric means.  Draco's bytes at our
# mean error are those between its steps of quantisation, by the straight line of logarithms.
# Knobs: ERRORS (default 0.02% 0.01% 0.005%), MODELS (a pattern of names).  Without $DATA/meshes shapes of mr-make.
command -v draco_encoder >/dev/null || { echo "no draco_encoder: the package draco"; exit 1; }
compare() { # model, other: mean and maximum of both ways, in per cent of the diagonal
	mr-compare -q --json "$2" "$1" | python3 -c 'import json, sys
j = json.load(sys.stdin)
a, b, d = j["a_to_b"], j["b_to_a"], j["diagonal"] / 100
print((a["mean"] + b["mean"]) / 2 / d, max(a["max"], b["max"]) / d)'
}
draco() { # name: lines of bytes, mean, maximum
	mr-export -q -i "$1.mrs" "$1.obj"
	for bits in 7 8 9 10 11 12 13; do
		draco_encoder -i "$1.obj" -o d.drc -cl 10 -qp $bits --skip NORMAL --skip TEX_COORD >/dev/null &&
		    draco_decoder -i d.drc -o d.obj >/dev/null && mr-import -q d.obj -o d.mrs
		echo "$(wc -c <d.drc) $(compare "$1.mrs" d.mrs)"
	done
}
one() { # name
	echo "$1" | grep -qE -e "${MODELS:-.}" || return 0
	draco "$1" >peer
	for e in ${ERRORS:-0.02% 0.01% 0.005%}; do
		sh "$TOP/examples/pack.sh" "$1.ply" "$1.mrz" $e >tries || exit
		mr-unpack "$1.mrz" | mr-decode -q -o u.mrs
		echo "$1 $e $(wc -c <"$1.mrz") $(compare "$1.mrs" u.mrs)"
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
}
model() { # name, file in $DATA/meshes, vertices of a shape instead
	if [ -e "$DATA/meshes/$2" ]; then
		mr-import -q --repair "$DATA/meshes/$2" -o "$1.mrs"
	else
		mr-make bumpy -n "$3" -o "$1.mrs"
	fi
	mr-export -q -i "$1.mrs" "$1.ply"
}

if [ -d "$DATA/meshes" ]; then
	for m in bunny00.off.gz stanford-bunny.obj.gz armadillo.off.gz igea.ply.gz horse.ply.gz nefertiti.obj.gz \
	    fertility.off lucy.ply.gz rocker-arm.obj.gz camel.off.gz; do
		model "${m%%.*}" $m
		one "${m%%.*}"
	done
else
	for n in 5000 30000; do
		model bumpy-$n none $n
		one bumpy-$n
	done
fi | tee rows
python3 -c 'import math, re
rows = {}
for r in re.findall(r"^\S+ (\S+): .*ratio ([0-9.]+), at equal maximum ([0-9.]+)", open("rows").read(), re.M):
    rows.setdefault(r[0], []).append((float(r[1]), float(r[2])))
for want, r in rows.items():
    for k, word in enumerate(("equal mean", "equal maximum")):
        mean = math.exp(sum(math.log(x[k]) for x in r) / len(r))
        worst = max(x[k] for x in r)
        print(f"{len(r)} models at {want}, {word}: geometric mean of ratios {mean:.3f}, worst {worst:.3f}")'
