# The thin plate, set-up and three right-hand sides, posed linearly as they are, beside Eigen's solvers on the same system, medians of five; and
# how far surfaces by mean areas are from those by true ones, before and after decoding.
figure() { # name, file: a number of the last line of JSON
	sed -n '$s/.*"'"$1"'":\([^,}]*\).*/\1/p' "$2"
}
median() {
	sort -g | sed -n 3p
}
thin_plate() { # name; selected.mrs has the regions, fixed below 0.05 and handle above 0.95 of the box along x
	mr-pose --translate 0,0,0.2 selected.mrs -o posed.mrs
	for i in 1 2 3 4 5; do
		mr-solve --rotations linear --stats stats.json posed.mrs -o /dev/null || exit
		for part in assemble analyse factor solve; do
			figure seconds_$part stats.json >>$part.txt
		done
	done
	for part in assemble analyse factor solve; do
		median <$part.txt >$part
		rm $part.txt
	done
	echo "$1: $(figure free stats.json) free vertices, $(figure nnz_factor stats.json) entries in the factor"
	echo "$1-setup mr $(cat assemble analyse factor | awk '{ s += $1 } END { print s }') s"
	echo "$1-factor mr $(cat analyse factor | awk '{ s += $1 } END { print s }') s"
	echo "$1-solve mr $(cat solve) s"
	[ -x "$BUILD/bench/peer_solve" ] || return 0
	mr-export -l base -i selected.mrs base.off || exit
	for i in 1 2 3 4 5; do
		peer_solve base.off 0.05 0.95 || exit
	done >peer
	for who in eigen eigen+cholmod; do
		awk -v who=$who '$1 == who { print $2 + $3 }' peer | median | sed "s/.*/$1-setup $who & s/"
		awk -v who=$who '$1 == who { print $3 }' peer | median | sed "s/.*/$1-factor $who & s/"
		awk -v who=$who '$1 == who { print $4 }' peer | median | sed "s/.*/$1-solve $who & s/"
	done
}
select_ends() {
	mr-select --free all --fixed below:x,0.05 --handle 0=above:x,0.95 -o selected.mrs
}
for n in 33000 158000; do
	mr-make torus -n $n | mr-smooth -t 0 | select_ends
	thin_plate torus-$((n / 1000))k
done
if [ -f "$DATA/meshes/igea.ply.gz" ]; then
	mr-import "$DATA/meshes/igea.ply.gz" | mr-smooth | mr-remesh | select_ends
	thin_plate igea
fi

# Mean areas against true ones.
areas() { # name; selected.mrs
	for k in 2 3; do
		for a in voronoi mean; do
			mr-solve -k $k --areas $a --flatten selected.mrs | mr-encode | mr-pose --translate 0,0,0.2 --rotate 0,1,0,30 |
				mr-solve -k $k --areas $a | mr-decode -o $a.mrs || exit
		done
		for layer in base mesh; do
			mr-compare --json -a $layer -b $layer mean.mrs <voronoi.mrs >compare.json || exit
			echo "$1-k$k-mean-areas-$layer mr $(sed 's/.*"both_relative":{"hausdorff":\([^,}]*\).*/\1/' compare.json) diagonals"
		done
	done
}
mr-make bumpy -n 20000 | mr-smooth -t 30 | mr-remesh | select_ends
areas bumpy
if [ -f "$DATA/meshes/bunny00.off.gz" ]; then
	mr-import "$DATA/meshes/bunny00.off.gz" | mr-smooth -t 30 | mr-remesh | select_ends
	areas bunny
fi
