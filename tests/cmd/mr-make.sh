# Every shape: its counts, its topology, and its measures beside their closed forms.
check() { # shape, options, area, volume
	mr-make $1 $2 | mr-info --json | tr ',{}[]' '\n\n\n\n\n' | awk -F: -v shape="$1" -v area="$3" -v volume="$4" '
		{ gsub(/"/, ""); value[$1] = $2 }
		function near(a, b) { return (a - b) ^ 2 <= (0.002 * b) ^ 2 ? "good" : a " is not " b }
		END { print shape, value["vertices"], "vertices", value["faces"], "faces, genus", value["genus"] \
			", area", near(value["area"], area) ", volume", near(value["volume"], volume) }'
}
pi=3.14159265358979
check sphere "-n 20000" "$(awk "BEGIN { print 4 * $pi }")" "$(awk "BEGIN { print 4 * $pi / 3 }")"
check torus "-n 20000" "$(awk "BEGIN { print 1.6 * $pi ^ 2 }")" "$(awk "BEGIN { print 0.32 * $pi ^ 2 }")"
check cube "-n 500" 24 8
check cylinder "-n 20000" "$(awk "BEGIN { print 10 * $pi }")" "$(awk "BEGIN { print 4 * $pi }")"
check boxes "--genus 5 -n 1000" 104 28
length=$(awk "BEGIN { # of the curve within the tube
	for (i = 0; i < 10000; i++)
		s += sqrt(4 * (1 + 0.45 * cos(6 * $pi * i / 10000)) ^ 2 + 9 * 0.45 ^ 2) * 2 * $pi / 10000
	printf \"%.9f\", s
}")
check knot "-n 60000" "$(awk "BEGIN { print 0.4 * $pi * $length }")" "$(awk "BEGIN { print 0.04 * $pi * $length }")"
for shape in plane bumpy; do
	mr-make $shape -n 5000 | mr-info | grep -E 'topology|flaws'
done
mr-make cylinder --open -n 300 | mr-info | grep topology

# The same seed gives the same bytes, another seed others, and -j changes none.
mr-make bumpy -n 6000 --noise 0.1% --seed 3 -j 1 >a
mr-make bumpy -n 6000 --noise 0.1% --seed 3 -j 2 >b
mr-make bumpy -n 6000 --noise 0.1% --seed 4 --no-history >c
cmp a b && echo same
mr-make bumpy -n 6000 --noise 0.1% --seed 3 --no-history | cmp -s - c || echo differs

# A cloud lies on the surface, and noise leaves it by as much as it was told to.
mr-make sphere --points 5000 | mr-info | grep -E 'points:|position|normal'
mr-make plane --points 20000 --noise 0.01 --seed 9 | mr-export -f xyz - |
	awk '{ s += $3 * $3 } END { s = sqrt(s / NR); print NR, (s > 0.0098 && s < 0.0102 ? "ok" : "bad " s) }'
