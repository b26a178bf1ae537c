# Texture coordinates: a pair for each corner, within the picture but for the seam; none a half turn from the others but where the
# axis meets the skin of bumpy.
for shape in sphere torus plane cylinder bumpy; do
	mr-make $shape -n 500 --texcoords -o $shape.mrs
	mr-info --no-intersections $shape.mrs | grep -o 'corner_texcoord f d6'
	mr-export -q -i $shape.mrs -f obj - | awk -v s=$shape '/^vt / { u[++n] = $2; v[n] = $3 }
		/^f / { for (i = 2; i <= 4; i++) { split($i, k, "/"); a[i] = u[k[2]]; b[i] = v[k[2]]
				if (a[i] < -1 || a[i] > 2 || b[i] < -1 || b[i] > 2) far++ }
			for (i = 2; i <= 4; i++) { j = i % 3 + 2; d = a[i] - a[j]; e = b[i] - b[j]
				if (d * d > 0.27 || e * e > 0.27) wide++ } }
		END { print s ": " (n > 0 ? "has some" : "has none") ", " far + 0 " far, " wide + 0 " wide" }'
done
mr-make torus -n 500 -o plain.mrs
mr-export -q -i torus.mrs a.off && mr-export -q -i plain.mrs b.off && cmp a.off b.off && echo 'the same surface'
for wrong in 'sphere --points 10'; do
	mr-make $wrong --texcoords
	echo "exit $?"
done
