# No tool knows of units: at other powers of two all numbers are the same ones but for that, from 2^-96 to 2^96, about 1e-29 to
# 1e29.  Far beyond 1e30 products of lengths are no numbers: every tool says so, and what brings the model back.
fail=0
bad() {
	echo "$*"
	fail=1
}
scale() { # exponent of 2, file, result
	by=$(awk -v e="$1" 'BEGIN { printf "%.17g", 2 ^ e }')
	mr-transform --no-history -s "$by" "$2" >"$3" || bad "cannot scale $2 by $by"
}

mr-make bumpy -n 1000 >mesh.mrs
mr-make bumpy --points 2000 | mr-shrinkwrap -q | mr-simplify -q -n 200 >wrap.mrs
mr-fit -q wrap.mrs >fit.mrs && mr-sample -q fit.mrs >heights.mrs
mr-smooth mesh.mrs | mr-select --reset --free all --fixed below:z,0.2 --handle 1=above:z,0.8 >base.mrs
pose() { # what is scaled is posed after that
	mr-solve -q --basis <"$1" | mr-encode -q | mr-pose -H 1 --rotate 1,2,3,40 >"$2"
}
pose base.mrs posed.mrs

powers=$([ -z "$LONG" ] && echo -96 96 || echo -96 -20 20 96)
# A frame, and what is done to it.
cat >jobs <<'END'
mesh mr-cat
mesh mr-crop --keep above:z,0.5
mesh mr-normals
mesh mr-remesh
mesh mr-remesh --adaptive 1% --feature 40
mesh mr-select --free above:z,0.2
mesh mr-simplify -n 300
mesh mr-smooth
mesh mr-smooth -m taubin
mesh mr-split
mesh mr-subdivide -n 1 --limit
mesh mr-subdivide --longest 2%
wrap mr-fit
wrap mr-fit -m local
wrap mr-normals -l points
wrap mr-shrinkwrap
wrap mr-shrinkwrap -m cube
wrap mr-shrinkwrap -m volume
fit mr-sample
fit mr-sample -m robust
heights mr-decode
heights mr-equalize --gain 1,0.5
heights mr-subdivide -n 1
base mr-encode
base mr-solve -k 1 --basis
base mr-solve -k 3 --basis -s multigrid
base mr-solve --flatten
posed mr-decode
posed mr-solve
posed mr-solve --arap 2
END

# All of them with LONG=1.
IFS='
'
"$TOP/tests/sampled" 2 $(cat jobs) >some
unset IFS

result() { # frame, what to do, result
	eval "$2" -q '<"$1" >"$3" 2>err' || bad "$2 of $1: exit $?, $(cat err)"
}
for frame in mesh wrap fit heights base; do
	for e in $powers -332 332; do
		scale $e $frame.mrs $frame$e.mrs
	done
done
for e in $powers; do
	pose base$e.mrs posed$e.mrs
done
while read -r frame job; do
	result $frame.mrs "$job" one.mrs
	scale 0 one.mrs at-one.mrs
	for e in $powers; do
		result $frame$e.mrs "$job" other.mrs
		scale $((-e)) other.mrs back.mrs
		cmp -s at-one.mrs back.mrs || bad "$job at 2^$e: another result"
	done
	[ "$job" = mr-cat ] || [ $frame = posed ] && continue
	for e in -332 332; do
		eval "$job" '<$frame$e.mrs >other.mrs 2>err' && bad "$job at 2^$e: exit 0"
		grep -q 'only 1e-30 to 1e+30 can be computed with: mr-transform --unit' err || bad "$job at 2^$e: $(cat err)"
	done
done <some

# The sinks: pictures are the same, distances are scaled; files hold any number, and what is too large can be made smaller.
mr-render one.png <posed.mrs
for e in -96 96; do
	mr-render other.png <posed$e.mrs && cmp one.png other.png || bad "mr-render at 2^$e: another picture"
	mr-compare --json -a mesh -b base <posed$e.mrs | sed 's/.*relative/relative/' >other
	mr-compare --json -a mesh -b base <posed.mrs | sed 's/.*relative/relative/' | cmp - other || bad "mr-compare at 2^$e: another distance"
done
for e in -332 332; do
	for job in 'mr-render other.png' 'mr-compare -a mesh -b base'; do
		eval "$job" '<base$e.mrs >out 2>err' && bad "$job at 2^$e: exit 0"
		grep -q 'mr-transform --unit' err || bad "$job at 2^$e: $(cat err)"
	done
	mr-info mesh$e.mrs | grep -q 'invalid .*the largest coordinate' || bad "mr-info at 2^$e says nothing"
	mr-export -f off - <mesh$e.mrs | mr-import -f off - | mr-transform --unit | mr-smooth -q | mr-info -l base --check >out ||
	    bad "what was at 2^$e cannot be brought back"
done
exit $fail
