# Displaced subdivision surfaces: coarse levels are prefixes of fine ones, without heights there is the limit surface, gains
# of levels act on the vertices of these levels and on finer ones; the same bytes for any -j.
fail=0
bad() {
	echo "$*"
	fail=1
}
vertices() { # stream: positions of mesh, one a line
	mr-export -l mesh -f off - <"$1" | awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2 { print $1, $2, $3 }'
}
begins() { # lines of the first file begin the second, to rounding
	awk 'NR == FNR { for (k = 1; k <= 3; k++) a[FNR, k] = $k; n = FNR; next }
		FNR <= n { for (k = 1; k <= 3; k++) { d = a[FNR, k] - $k; if (!(d * d < 1e-26)) bad++ } }
		END { exit !(n && FNR >= n && !bad) }' "$1" "$2"
}

for shape in sphere torus plane boxes; do
	mr-make $shape --points 3000 --noise 0.01 >points.mrs || exit
	mr-make $shape -n 60 | mr-export -f off - | mr-import -l control - | mr-cat --merge - points.mrs |
		mr-sample -n 3 -o all.mrs || exit
	mr-decode all.mrs -o full.mrs || exit
	vertices full.mrs >full
	for level in 0 1 2 3; do
		mr-decode --level $level all.mrs -o part.mrs || exit
		vertices part.mrs >part
		begins part full || bad "$shape: level $level is not the beginning of level 3"
		mr-decode --gain 0 --level $level all.mrs -o flat.mrs || exit
		mr-subdivide -n $level --limit all.mrs -o limit.mrs || exit
		vertices flat.mrs >flat
		vertices limit.mrs | cmp -s - flat || bad "$shape: level $level without heights is not the limit surface"
	done
	mr-equalize --gain 1,1,3 all.mrs | mr-decode -o loud.mrs || exit
	vertices loud.mrs >loud
	mr-decode --level 1 all.mrs -o part.mrs
	vertices part.mrs >part
	begins part loud || bad "$shape: a gain of level 2 shows on level 1"
	cmp -s full loud && bad "$shape: a gain of level 2 does nothing"
	mr-equalize all.mrs | mr-decode -o again.mrs || exit
	vertices again.mrs >again
	begins full again || bad "$shape: gains of 1 change the surface"
	for tool in 'mr-decode' 'mr-equalize -g 2,1,0' 'mr-subdivide -n 3' 'mr-subdivide -n 3 --limit' \
		'mr-subdivide -n 2 --crease 20 --limit'; do
		$tool -j 1 all.mrs >one.mrs && $tool -j 2 all.mrs | cmp -s - one.mrs || bad "$shape: $tool depends on -j"
	done
done

# What a fit moves is there to be edited: no folds, nothing passes through itself.
mr-make knot -n 6000 --points 3000 | mr-shrinkwrap | mr-simplify -o coarse.mrs || exit
for faces in 300 100; do
	mr-simplify -n $faces coarse.mrs | mr-fit -q -o fitted.mrs || exit
	mr-info -l control fitted.mrs | grep -q 'flaws *none' || bad "knot, $faces faces: the control mesh has flaws"
done
exit $fail
