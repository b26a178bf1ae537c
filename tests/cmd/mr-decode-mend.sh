# A knot that is wrung until its detail meets itself: less of it does when it is mended, whatever the number of threads;
# frames of a sequence are mended where that is asked for, and then as if they stood alone.
mr-make knot -n 3000 | mr-smooth | mr-remesh -q |
    mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 | mr-encode -q -o knot.mrs || exit
pose() { # frames, option of mr-decode, result
	mr-pose --rotate 0,0,1,120 --frames "$1" knot.mrs | mr-solve -q | mr-decode --mend $2 -o "$3"
}
same() { # file, file: mesh.position of their last frames
	python3 - "$1" "$2" <<'END'
import records, sys
a, b = (records.column(path, b'mesh', b'position') for path in sys.argv[1:])
print('the same' if a == b else '%d coordinates differ' % sum(x != y for x, y in zip(a, b)))
END
}
mr-pose --rotate 0,0,1,120 knot.mrs | mr-solve -q -o posed.mrs
for mend in none keys all; do
	mr-decode --mend $mend posed.mrs -o $mend.mrs 2>$mend.err
	sed -n 's/.*mesh: \([0-9]*\) more intersecting.*/\1/p' $mend.err >$mend.pairs
done
test "$(cat keys.pairs)" -lt "$(cat none.pairs)" && echo fewer pairs
same keys.mrs all.mrs
same none.mrs keys.mrs | grep -c differ
mr-decode -q -j 1 posed.mrs -o one.mrs
same keys.mrs one.mrs

echo 'sequences'
for mend in none keys all; do
	pose 3 $mend film-$mend.mrs 2>film.err
done
same film-none.mrs none.mrs
same film-keys.mrs none.mrs
same film-all.mrs keys.mrs

echo 'exaggerated detail is meant'
for mend in none all; do
	mr-decode -q --gain 2 --mend $mend posed.mrs -o gain-$mend.mrs
done
same gain-none.mrs gain-all.mrs
