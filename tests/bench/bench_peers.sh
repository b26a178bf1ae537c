# From raw input to one file with levels of detail, beside Open3D: peers.py says how; a page with pictures is
# $BUILD/peers/index.html.  Knob: MODELS (parts of names).
. "$TOP/tests/bench/common.sh"
python=$(python_of_open3d)
[ -n "$python" ] || echo "bench_peers: without Open3D: tests/bench/README.md says how to get it" >&2
"${python:-python3}" -B "$TOP/tests/bench/peers.py" "$BUILD/peers"
echo "pictures: $BUILD/peers/index.html"
