#!/bin/sh
# packed.sh -- the picture of a packed scan for README.md; usage: packed.sh MODEL OUT.png
#
# Above, 2, 4, 8 and 16 kB of one file, each its beginning; below, Draco's file of the same size, of the model simplified
# until it fits.
set -e
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mr-import -q --repair "$1" -o "$work/model.mrs"
mr-simplify -q --to control -n 900 "$work/model.mrs" | mr-fit -q | mr-sample -q -n 4 | mr-pack -q -n 16000 - "$work/all.mrz"

# The most faces whose file is no larger, by halving.
draco() { # bytes
	few=100 many=40000
	while [ $((many - few)) -gt $((few / 50)) ]; do
		n=$(((few + many) / 2))
		mr-simplify -q -n $n "$work/model.mrs" | mr-export -q "$work/d.obj"
		draco_encoder -i "$work/d.obj" -o "$work/d.drc" -cl 10 -qp 10 --skip NORMAL >/dev/null
		if [ "$(wc -c <"$work/d.drc")" -le "$1" ]; then few=$n; else many=$n; fi
	done
	mr-simplify -q -n "$few" "$work/model.mrs" | mr-export -q "$work/d.obj"
	draco_encoder -i "$work/d.obj" -o "$work/d.drc" -cl 10 -qp 10 --skip NORMAL >/dev/null
	draco_decoder -i "$work/d.drc" -o "$work/draco-$(($1 / 1000))-kB.obj" >/dev/null
}
for n in 2000 4000 8000 16000; do
	mr-unpack -q -n $n "$work/all.mrz" | mr-decode -q | mr-export -q "$work/mr-$((n / 1000))-kB.ply"
	draco $n
done
cd "$work"
mr-import -q mr-2-kB.ply mr-4-kB.ply mr-8-kB.ply mr-16-kB.ply draco-2-kB.obj draco-4-kB.obj draco-8-kB.obj draco-16-kB.obj |
    mr-render -q --sheet --columns 4 --size 240x260 --view front sheet.png
cd "$here" && mv "$work/sheet.png" "$2"
