# What a model gives does not depend on its units, its place, its direction, the order of its points.
fail=0
bad() {
	echo "$*"
	fail=1
}

some() { # words: some of them, or all with LONG=1
	"$TOP/tests/sampled" 3 "$@"
}

# What is done to a model: mesh.off; points.off and control.off, a control mesh for them.
smooth() { mr-import mesh.off | mr-smooth | mr-export -l base -f off -; }
taubin() { mr-import mesh.off | mr-smooth -m taubin | mr-export -l base -f off -; }
remesh() { mr-import mesh.off | mr-remesh | mr-export -l base -f off -; }
simplify() { mr-import mesh.off | mr-simplify -n 600 | mr-export -f off -; }
edited() { # the base as it is, or through ...
	mr-import mesh.off | mr-smooth | ${1:-mr-cat} |
	    mr-select --reset --free all --fixed below:z,0.2 --handle 1=above:z,0.8 | mr-solve --basis | mr-encode |
	    mr-pose -H 1 --rotate 1,2,3,40 --scale 1.5 | mr-solve | mr-decode | mr-export -f off -
}
edit() { edited mr-remesh; }
bend() { edited; }
wrap() { mr-import -l points points.off | mr-shrinkwrap -q "$@" | mr-export -l control -f off -; }
cube() { wrap -m cube; }
volume() { wrap -m volume; }
both() { mr-import -l control control.off >control.mrs && mr-import -l points points.off | mr-cat --merge control.mrs -; }
fit() { both | mr-fit -q "$@" | mr-export -l control -f off -; }
paper() { fit -m local; }
heights() { both | mr-sample -q -n 2 "$@" | mr-decode | mr-export -f off -; }
unfitted() { heights --refine 0; }
robust() { heights -m robust; }
whole() {
	mr-import -l points points.off | mr-shrinkwrap -q | mr-simplify -q -n 200 | mr-fit -q | mr-sample -q | mr-decode |
	    mr-export -f off -
}

# An OFF file by a matrix, nine numbers, and a vector.
move() {
	awk -v by="$*" 'BEGIN { split(by, m) } NR == 2 { n = $1 } NR <= 2 || NR > n + 2 { print; next }
		{ for (i = 1; i <= 3; i++)
			printf "%.17g%s", m[3 * i - 2] * $1 + m[3 * i - 1] * $2 + m[3 * i] * $3 + m[9 + i], i < 3 ? " " : "\n" }'
}
# To 20 binary places: adding whole numbers rounds nothing.
rounded() {
	awk 'NR == 2 { n = $1 } NR <= 2 || NR > n + 2 { print; next }
		{ printf "%.17g %.17g %.17g\n", int($1 * 2 ^ 20) / 2 ^ 20, int($2 * 2 ^ 20) / 2 ^ 20, int($3 * 2 ^ 20) / 2 ^ 20 }'
}
# Points in another order: that of multiples of 7919, modulo a prime beyond their number.
shuffled() {
	sed 2q "$1"
	awk 'NR > 2 { print (NR * 7919) % 20011 "\t" $0 }' "$1" | sort -n | cut -f 2
}
model() { # shape, points: the model at rest
	shape=$1
	rm -rf rest
	mkdir rest
	mr-make "$1" -n 3000 | mr-export -f off - | rounded >rest/mesh.off || exit
	mr-make "$1" --points "$2" | mr-export -l points -f xyz - |
	    awk '{ p[NR] = $1 " " $2 " " $3 } END { print "OFF"; print NR, 0, 0; for (i = 1; i <= NR; i++) print p[i] }' |
	    rounded >rest/points.off || exit
	mr-import -l points rest/points.off | mr-shrinkwrap -q | mr-simplify -q -n 200 | mr-fit -q |
	    mr-export -l control -f off - | rounded >rest/control.off || exit
	mr-make "$1" | mr-export -f off - >rest/truth.off || exit
}
# Puts what the model gives at rest to a, what it gives otherwise to b.
compare() { # name of the other, what to do, and back
	what="$shape, $1: $2"
	[ -s "rest/$2" ] || (cd rest && $2 >"$2")
	(cd moved && $2) | move $3 >b
	cp "rest/$2" a
	[ -s a ]
}
carry() { # name of the motion, there, back, what to do
	rm -rf moved
	mkdir moved
	for file in mesh points control; do
		move $2 <rest/$file.off >moved/$file.off
	done
	compare "$1" "$4" "$3"
}
reorder() { # what to do
	rm -rf moved
	cp -r rest moved
	shuffled rest/points.off >moved/points.off
	compare shuffled "$1" "$still"
}
# Largest distance between the vertices of a and b, over the diagonal of a; the triangles are the same.
near() { # bound; 0: equal numbers
	paste -d ' ' a b | awk -v what="$what" -v bound="$1" '
		NR == 2 { n = $1 }
		NR > n + 2 || NR <= 2 { for (i = 1; i <= NF / 2; i++) if ($i != $(i + NF / 2)) { other = 1; exit } next }
		{
			d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2
			if (!(d <= most)) most = d
			for (i = 1; i <= 3; i++) {
				if (NR == 3 || $i < low[i]) low[i] = $i
				if (NR == 3 || $i > high[i]) high[i] = $i
			}
		}
		END {
			if (other || NR < 100) { print what ": other faces"; exit 1 }
			most = sqrt(most / ((high[1] - low[1]) ^ 2 + (high[2] - low[2]) ^ 2 + (high[3] - low[3]) ^ 2))
			if (!(most <= bound)) { printf "%s: off by %g of the diagonal, allowed %g\n", what, most, bound; exit 1 }
		}' || fail=1
}
apart() { # a, b: the greatest distance and the mean one
	mr-import "$1" >1.mrs && mr-import "$2" | mr-compare --json --samples 20000 -i 1.mrs /dev/stdin |
	    sed -E 's/.*"both":\{"hausdorff":([^,]*).*"mean":([^,]*),.*"a_to_b_relative.*/\1 \2/'
}
topology() {
	mr-import "$1" | mr-info --json --no-intersections | grep -o '"components":[0-9]*,"euler":[-0-9]*' ||
	    echo "no topology of $1"
}
# Where decisions depend on the axes (an order along a curve through a grid, cells of a volume) the result is another one: of
# the same topology, about as many faces, and, as both are as near to the truth, within twice that of one another.
alike() { # truth
	[ "$(topology a)" = "$(topology b)" ] || bad "$what: $(topology a), but $(topology b)"
	echo $(apart a "rest/$1.off") $(apart a b) $(sed -n 2p a) $(sed -n 2p b) | awk -v what="$what" '
		NF != 10 || !($3 <= 2 * $1 && $4 <= 2 * $2) {
			print what ": apart by " $3 ", mean " $4 "; from the truth by " $1 ", mean " $2
			exit 1
		}
		!(($6 - $9) ^ 2 <= (0.05 * $6) ^ 2) { print what ": " $6 " faces, but " $9; exit 1 }' || fail=1
}

up='1099511627776 0 0  0 1099511627776 0  0 0 1099511627776  0 0 0' # 2^40
down='9.094947017729282379150390625e-13 0 0  0 9.094947017729282379150390625e-13 0  0 0 9.094947017729282379150390625e-13  0 0 0'
still='1 0 0  0 1 0  0 0 1  0 0 0'
away='1 0 0  0 1 0  0 0 1  5 -3 9'
back='1 0 0  0 1 0  0 0 1  -5 3 -9'
far='1 0 0  0 1 0  0 0 1  2097152 -1048576 4194304' # a million diagonals
near_again='1 0 0  0 1 0  0 0 1  -2097152 1048576 -4194304'
very_far='1 0 0  0 1 0  0 0 1  268435456 -134217728 67108864'
near_once_more='1 0 0  0 1 0  0 0 1  -268435456 134217728 -67108864'
half='-1 0 0  0 1 0  0 0 -1  0 0 0'
third='0 0 1  1 0 0  0 1 0  0 0 0' # x to y, y to z, z to x
third_back='0 1 0  0 0 1  1 0 0  0 0 0'
t=0.66666666666666663 o=0.33333333333333331
turn="$t -$o $t  $t $t -$o  -$o $t $t  0 0 0" # mixes all axes
turn_back="$t $t -$o  -$o $t $t  $t -$o $t  0 0 0"

# A power of two scales all numbers and rounds none: decision by decision the same.
all='smooth taubin remesh simplify edit wrap cube volume fit paper heights unfitted robust whole'
model bumpy 3000
for do in $(some $all); do
	carry smaller "$down" "$up" $do && near 0 || bad "$what: fails"
done
[ -z "$SAN" ] || exit $fail # a sanitizer has seen what there is to see
model knot 3000
for do in $(some $all); do
	carry larger "$up" "$down" $do && near 0 || bad "$what: fails"
done

# Moved, all is as it was but for rounding: 5e-15 of the diagonal.  (Through mr-smooth and mr-remesh together that may turn
# a decision over, and does.)
for do in $(some smooth taubin remesh simplify wrap fit paper heights unfitted robust); do
	carry moved "$away" "$back" $do && near 1e-13 || bad "$what: fails"
done
carry moved "$away" "$back" bend && near 1e-9 || bad "$what: fails" # 1e-11, by the condition of a thin plate

# A million diagonals away a number has 31 bits of the 52 left: 5e-10 of the diagonal, and no decision is another one.  (Measured
# were 1.4e-8, and 2e-7 of wraps, which go many small ways.)
for do in $(some smooth taubin remesh simplify paper heights robust bend); do
	carry 'far away' "$far" "$near_again" $do && near 3e-8 || bad "$what: fails"
done
for do in $(some cube volume fit); do
	carry 'far away' "$far" "$near_again" $do && near 1e-6 || bad "$what: fails"
done

# At fifty million diagonals, as of a hand in a country's coordinates, 2e-8 of the diagonal is left, and still no decision is
# another one.  (Measured were 7e-7, and 2e-5 of heights.)
for do in $(some smooth taubin remesh simplify edit paper bend); do
	carry 'very far away' "$very_far" "$near_once_more" $do && near 1e-5 || bad "$what: fails"
done
for do in $(some fit heights robust); do
	carry 'very far away' "$very_far" "$near_once_more" $do && near 1e-4 || bad "$what: fails"
done

# A half turn changes signs and rounds nothing.
for do in $(some smooth taubin paper unfitted); do
	carry 'half a turn' "$half" "$half" $do && near 0 || bad "$what: fails"
done

# What does not look at the axes turns with them but for rounding: 1e-15 of the diagonal.  (A point at the edge of two
# triangles of a displaced surface may stand on either of them: heights are fitted to it a little otherwise.)
for do in $(some smooth taubin fit paper heights unfitted robust); do
	case $do in heights | robust) bound=1e-5 ;; *) bound=1e-13 ;; esac
	carry 'a third of a turn' "$third" "$third_back" $do && near 1e-13 || bad "$what: fails"
	carry turned "$turn" "$turn_back" $do && near $bound || bad "$what: fails"
done
for do in $(some remesh simplify wrap whole); do
	case $do in remesh | simplify) truth=mesh ;; *) truth=truth ;; esac
	carry 'a third of a turn' "$third" "$third_back" $do && alike $truth || bad "$what: fails"
	carry turned "$turn" "$turn_back" $do && alike $truth || bad "$what: fails"
done

# The order of points is that of sums; those over the cells of a volume are of single precision.
for do in $(some cube paper unfitted); do
	reorder $do && near 0 || bad "$what: fails"
done
for do in $(some fit heights robust); do
	reorder $do && near 1e-13 || bad "$what: fails"
done
reorder volume && near 1e-7 || bad "$what: fails"
# Of more than 4096 points some, at equal strides, tell the sampling distance of a wrap; of more than twice the vertices of the
# wrap, what a control mesh is dense by: in another order others do.
reorder whole && alike truth || bad "$what: fails"
model boxes 8000
for do in $(some fit heights robust); do
	reorder $do && near 1e-12 || bad "$what: fails"
done
reorder wrap && alike truth || bad "$what: fails"
exit $fail
