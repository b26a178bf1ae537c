# Detail over a base: all of it is there, and nothing is lost.
figure() { # name, file: a figure of --stats
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" "$2"
}
check() { # model: the share of true heights, what comes back
	mr-encode --stats stats.json "$1.mrs" -o "$1-detail.mrs" && mr-decode "$1-detail.mrs" -o "$1-back.mrs" || return
	awk -v h="$(figure heights stats.json)" -v o="$(figure offsets stats.json)" \
	    -v r="$(figure residual_max stats.json)" -v least="$2" -v name="$1" 'BEGIN {
		print name ": " (h >= least * (h + o) ? "ok" : "bad: " h " heights, " o " offsets"),
		    (r < 1e-14 ? "ok" : "bad: residual " r)
	}'
}
# What mr-decode wrote lies where the mesh lay, to 1e-12 of the diagonal.
back() { # model
	python3 - "$1.mrs" "$1-back.mrs" <<'END'
import records, sys
a, b = (records.column(path, b'mesh', b'position') for path in sys.argv[1:])
diagonal = sum((max(a[k::3]) - min(a[k::3])) ** 2 for k in range(3)) ** .5
print('back:', 'ok' if len(a) == len(b) and max(map(lambda x, y: abs(x - y), a, b)) < 1e-12 * diagonal else 'bad')
END
}
for shape in bumpy knot torus sphere; do
	mr-make $shape -n 2000 | mr-smooth | mr-remesh -o $shape.mrs || exit
	check $shape 0.999 && back $shape
done
echo 'without remeshing; with a much coarser base'
mr-make bumpy -n 2000 | mr-smooth -o bumpy.mrs
check bumpy 0.999 && back bumpy
mr-make bumpy -n 2000 | mr-smooth | mr-remesh -r 3 -o bumpy.mrs
check bumpy 0.9 && back bumpy
echo 'an open surface has offsets at its rim'
mr-make cylinder -n 3000 --open --noise 0.5% | mr-smooth | mr-remesh -o open.mrs
check open 0.9 && back open
mr-info open-detail.mrs | grep -o 'detail_[a-z]* *v .[0-9]'

echo 'the same bytes for any number of threads'
mr-encode -j 1 bumpy.mrs >one.mrs
mr-encode -j 3 bumpy.mrs | cmp - one.mrs && echo same

echo 'remarks'
mr-make sphere -n 162 | mr-smooth | mr-encode -v 2>&1 >out.mrs

echo 'refusals'
mr-make sphere -n 42 | mr-encode >out
echo "exit $?, $(wc -c <out) bytes"
mr-encode --gain 2 bumpy.mrs >out
echo "exit $?, $(wc -c <out) bytes"
printf 'OFF\n4 4 0\n0 0 0\n1e300 0 0\n0 1e300 0\n0 0 1e300\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' >huge.off
mr-import huge.off | mr-smooth -t 0 | mr-encode >out
echo "exit $?, $(wc -c <out) bytes"
mr-make sphere -n 42 | mr-smooth | mr-remesh | mr-cat -u -o placed.mrs
python3 - <<'END' # the first vertex of the base far from the face that it is said to lie on
import records, struct
def far(layer, name, shape, rows, data):
    return layer, name, shape, rows, struct.pack("<3d", 1e200, -1e200, 1) + data[24:] if name == b"source_bary" else data
stream = open("placed.mrs", "rb").read()
open("placed.mrs", "wb").write(records.changed(stream, far))
END
mr-encode placed.mrs >out
echo "exit $?, $(wc -c <out) bytes"
mr-info --check placed.mrs >out; echo "exit $?"
[ -z "$LONG" ] || others='armadillo.off horse.ply igea.ply'
for name in ${DATA:+bunny00.off $others}; do
	mr-import "$DATA/meshes/$name.gz" | mr-smooth | mr-remesh -o data.mrs &&
	    check data 0.99 >verdict && back data >>verdict && ! grep bad verdict || echo "$name: bad: $(cat verdict)"
done
