# Clouds that are open, few or no surface: a sound surface where there can be one, and a warning where it is poor.
flaws() {
	mr-info -l "$1" "$2" | sed -n 's/^ *topology *//p; s/^ *flaws *//p'
}
nearest() { # the mean distance of the points to the surface is below $1 of the diagonal
	mr-compare --json -a points -b mesh <out.mrs | sed 's/.*"a_to_b_relative":{\([^}]*\)}.*/\1/; s/.*"mean":\([^,}]*\).*/\1/' |
		awk -v most="$1" '{ print $1 < most ? "near" : "off by " $1 }'
}
reconstruct() {
	mr-import --points "$1" | mr-shrinkwrap --lids all | mr-simplify | mr-fit | mr-sample | mr-decode -o out.mrs
	flaws mesh out.mrs
}

echo 'half a sphere, closed by a lid'
mr-make sphere --points 3000 --seed 5 | mr-export -l points -f xyz - | awk '$3 > 0' >half.xyz
reconstruct half.xyz 2>err
nearest 0.001
cat err

echo 'the same, quietly'
mr-import --points half.xyz | mr-shrinkwrap -q --lids all -o quiet.mrs
flaws control quiet.mrs

echo 'few points: 4, 6, 8, 20'
printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n' >4.xyz
printf '1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n' >6.xyz
printf '0 0 0\n0 0 1\n0 1 0\n0 1 1\n1 0 0\n1 0 1\n1 1 0\n1 1 1\n' >8.xyz
mr-make sphere --points 20 | mr-export -l points -f xyz - >20.xyz
for n in 4 6 8 20; do
	reconstruct $n.xyz 2>err
	nearest 0.09
done

echo 'so few that handles hide, and a few that lie apart'
mr-make sphere --points 100 | mr-shrinkwrap 2>&1 >/dev/null | grep -c uncertain
{ mr-make sphere --points 3000 | mr-export -l points -f xyz - && for i in 1 2 3 4 5 6 7 8 9; do echo 1.5 0.0$i 0.0$i 1 0 0; done; } |
	mr-import -f xyz - | mr-shrinkwrap 2>&1 >/dev/null | grep -c unreached

echo 'a solid has no surface, and gets a sound one'
mr-make sphere --points 4000 | mr-export -l points -f xyz - |
	awk '{ s = 1 - (NR % 10) / 11; print s * $1, s * $2, s * $3 }' >solid.xyz
mr-import --points solid.xyz | mr-shrinkwrap -o solid.mrs 2>&1
flaws control solid.mrs

echo 'a cube drawn around limbs'
mr-make knot --points 3000 | mr-shrinkwrap -m cube 2>&1 >/dev/null | grep -c folded

echo 'a bowl that is thinner than its points are apart, and one of one sheet'
for outer in 1.03 1; do
	awk -v outer=$outer '{ s = NR % 2 ? outer : 1; print s * $1, s * $2, s * $3 }' half.xyz >bowl.xyz
	mr-import --points bowl.xyz | mr-shrinkwrap 2>&1 >/dev/null | grep -c uncertain
done

echo 'a strip of a cube that two scans see, three spacings out of register, and in register'
for off in 0.09 0; do
	mr-make cube --points 8000 --seed 3 | mr-export -l points -f xyz - |
		awk -v off=$off '{ s = NR % 2 && $1 > -0.05 && $1 < 0.45 ? off : 0; print $1 + s, $2 + s, $3 + s }' >strip.xyz
	mr-import --points strip.xyz | mr-shrinkwrap 2>&1 >/dev/null | grep -c uncertain
done

echo 'a surface that leaves its points at one place'
mr-make knot --points 3000 | mr-shrinkwrap | mr-simplify -q --faces 40 | mr-fit -q | mr-sample -n 2 2>&1 >/dev/null
