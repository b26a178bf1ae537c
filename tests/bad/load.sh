# Much at once: with LONG=1 100,000 frames, 500 pipes, 40,000 operands, a stream of 4.5 GB, columns of more than 2^31 bytes and rows;
# else a hundredth.
many=$([ -n "$LONG" ] && echo 1 || echo 100)
[ -z "$SAN" ] || { echo "a sanitizer takes memory of its own"; exit 77; }
load() {
	python3 "$TOP/tests/faults/load.py" "$@" || exit
}
load frames $((100000 / many))
load pipelines $((500 / many))
load operands $((40000 / many))
[ -z "$LONG" ] || load long 5
load wide $((2200000000 / many))
