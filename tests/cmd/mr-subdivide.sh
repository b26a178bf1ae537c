# Counts, prefixes, known surfaces, what goes along, frames, threads.
mr-make sphere -n 42 -o sphere.mrs
for n in 0 1 3; do
	mr-subdivide -n $n sphere.mrs -o out.mrs
	mr-info out.mrs | grep -o '[0-9]* vertices, [0-9]* faces'
	mr-info --check out.mrs >/dev/null || echo "level $n: unlawful"
done

echo 'the vertices of a level in the limit come first in that of a finer one'
numbers() { # layer's vertices as OFF has them
	mr-export -f off -l mesh - <"$1" | awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2'
}
near() { # the first file's lines begin the second's, to rounding
	awk 'NR == FNR { for (k = 1; k <= 3; k++) a[FNR, k] = $k; n = FNR; next }
		FNR <= n { for (k = 1; k <= 3; k++) { d = a[FNR, k] - $k; if (d * d > 1e-28) bad++ } }
		END { print (n && FNR >= n && !bad ? "equal" : "differ") }' "$1" "$2"
}
mr-make torus -n 60 -o torus.mrs
for n in 1 3; do
	mr-subdivide -n $n --limit torus.mrs -o level$n.mrs
	numbers level$n.mrs >level$n
done
near level1 level3
mr-info level3.mrs | grep -c 'normal  *v d3'

echo 'threads change nothing'
for options in '-n 4' '-n 4 --limit' '-n 3 --crease 30'; do
	mr-subdivide $options -j 2 torus.mrs -o two.mrs
	mr-subdivide $options -j 1 torus.mrs | cmp - two.mrs && echo same
done

echo 'a plane stays one, its corners round; a cube with creases keeps its edges'
mr-make plane -n 9 | mr-subdivide -n 3 --limit | mr-info | grep 'area\|box'
mr-make cube -n 8 | mr-subdivide -n 3 --crease 45 --limit | mr-info | grep 'area\|volume\|box'

echo 'what goes along'
cat >colored.ply <<'END'
ply
format ascii 1.0
element vertex 4
property double x
property double y
property double z
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
end_header
0 0 0 0 0 255
1 0 0 100 0 255
1 1 0 100 200 255
0 1 0 0 200 255
3 0 1 2
3 0 2 3
END
mr-import colored.ply | mr-select --free box:0.5,-1,-1,2,2,2 | mr-subdivide -n 1 |
	mr-export -f ply-ascii - | sed -n '/^end_header/,$p'
cat >labels.ply <<'END'
ply
format ascii 1.0
element vertex 4
property double x
property double y
property double z
property int label
property float weight
element face 2
property list uchar int vertex_indices
end_header
0 0 0 10 1
1 0 0 -20 2.5
1 1 0 30 3
0 1 0 10 4
3 0 1 2
3 0 2 3
END
for how in '-n 1' '--longest 1.2'; do
	mr-import labels.ply | mr-subdivide $how | mr-export -f ply-ascii - | sed -n '/label/,$p'
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\ng left\nf 1 2 3\ng right\nf 4 3 2\n' >grouped.obj
mr-import grouped.obj | mr-subdivide -n 1 | mr-export -f obj - | grep '^[gf]'

echo 'deltas are their frames one by one'
mr-make cube -n 60 | mr-smooth -t 0 | mr-select --free all --fixed below:z,0.3 --handle 0=above:z,0.7 | mr-solve -o solved.mrs
mr-pose --translate 0,0,1 --frames 3 solved.mrs | mr-solve | mr-subdivide -l base -n 2 -o film.mrs
mr-pose --translate 0,0,1 solved.mrs | mr-solve | mr-subdivide -l base -n 2 -o last.mrs
mr-export -f off - <last.mrs >last.off
mr-export frame%d.off <film.mrs && ls frame*.off && cmp frame4.off last.off && echo equal

echo 'a coarse body is rounded, which is said'
mr-make cube -n 12 | mr-subdivide 2>&1 >out
mr-make cube -n 12 | mr-subdivide --crease 30 2>&1 >out
mr-make sphere -n 300 | mr-subdivide 2>&1 >out

echo 'detail stays where nothing is divided, and the length that is advised is taken'
mr-make torus -n 300 | mr-smooth | mr-encode -o enc.mrs
mr-subdivide -n 0 enc.mrs 2>&1 | mr-info | grep -c detail_
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >t.obj
mr-subdivide --longest 1e-9 t.obj 2>&1 >out | sed 's/.*a length of \([^ ]*\).*/\1/'
