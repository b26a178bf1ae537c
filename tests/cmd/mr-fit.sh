# The limit surface comes close to the points, by either method; folds nothing; the same bytes for any -j.
figure() { # name, file: a number of a line of JSON
	sed "s/.*\"$1\":\([^,}]*\).*/\1/" "$2"
}
for shape in sphere torus knot bumpy plane; do
	mr-make $shape -n 600 | mr-export -f off - | mr-import -l control -o control.mrs
	mr-make $shape --points 8000 -o points.mrs
	mr-cat --merge control.mrs points.mrs -o both.mrs
	for m in local least-squares; do
		mr-fit -q -m $m --stats stats.json both.mrs -o out.mrs || exit
		for f in mean rms; do
			b=$(figure distance_${f}_before stats.json) a=$(figure distance_${f}_after stats.json)
			awk -v a="$a" -v b="$b" -v s="$shape $m $f" \
			    'BEGIN { print s ":", (a < 0.8 * b || a < 1e-3 ? "ok" : "bad: " b " became " a) }'
		done
		mr-fit -q -j 1 -m $m --stats j1.json both.mrs | cmp - out.mrs && echo same for -j 1
	done
	echo "folded: $(figure folded_edges_after stats.json)"
done
mr-info --check out.mrs >/dev/null && echo lawful

echo 'units do not matter'
scaled() { # factor: what mr-fit makes of the torus, scaled before and back after
	mr-make torus -n 300 | mr-export -f off - | awk -v s="$1" 'NR > 2 && NF == 3 { printf "%.17g %.17g %.17g\n", $1 * s, $2 * s, $3 * s; next } { print }' |
		mr-import -l control -o control.mrs
	mr-make torus --points 5000 | mr-export -f xyz - | awk -v s="$1" '{ printf "%.17g %.17g %.17g\n", $1 * s, $2 * s, $3 * s }' | mr-import -o points.mrs
	mr-cat --merge control.mrs points.mrs | mr-fit | mr-export -f off -l control - |
		awk -v s="$1" 'NR > 2 && NF == 3 { printf "%.17g %.17g %.17g\n", $1 / s, $2 / s, $3 / s }'
}
scaled 1 >one.txt
scaled 1024 | cmp - one.txt && echo ok

echo 'a vertex of too many neighbours is refused'
awk 'BEGIN { n = 1000; print "OFF"; print n + 1, n, 0; print 0, 0, 1; for (i = 0; i < n; i++) print cos(i * 6.2831853 / n), sin(i * 6.2831853 / n), 0
	for (i = 0; i < n; i++) print 3, 0, 1 + i, 1 + (i + 1) % n }' | mr-import -l control -o fan.mrs
mr-make sphere --points 100 -o few.mrs
mr-cat --merge fan.mrs few.mrs | mr-fit 2>&1 >out.mrs
echo "exit $?"
