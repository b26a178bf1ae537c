# examples/tiles: four tiles of a cloud agree where they overlap, lie on the points, and lack no more than an edge along
# their borders.
[ -z "$SAN" ] || { echo "make has no use for sanitizers here"; exit 77; }
fail=0
complain() { echo "$*"; fail=1; }

mr-make torus -n 20000 --points 12000 | mr-export -l points torus.xyz
make -s -j2 -f "$TOP/examples/tiles/Makefile" SCAN="$PWD/torus.xyz" OUT=tiles >log 2>&1 || { cat log; exit 1; }
[ "$(wc -l <tiles/seams.txt)" -eq 6 ] || complain "not four seams and the whole"
awk '/-/ && !($2 > 0 && $2 < 0.15 && $3 < 1) { bad = 1 }
	/^points/ && !($4 > 0 && $4 < 0.1 && $5 < 2) { bad = 1 } END { exit bad }' \
    tiles/seams.txt || { cat tiles/seams.txt
    complain "tiles are farther apart, or from the points, than they should be"; }
mr-make torus -n 20000 | mr-compare -a mesh -b mesh - tiles/surface.ply |
	awk '/^ *a to b/ && $7 < 0.1 { good = 1 } END { exit !good }' ||
    complain "a part of the torus is in no tile"
[ "$(make -s -n -f "$TOP/examples/tiles/Makefile" SCAN="$PWD/torus.xyz" OUT=tiles | grep -c mr-)" -eq 0 ] ||
	complain "a second make makes something again"

# A tool that is killed leaves no box behind that is none; tiles without a seam are not passed over.
mkdir bin
printf '#!/bin/sh\nkill -9 $$\n' >bin/mr-info
chmod +x bin/mr-info
! PATH=$PWD/bin:$PATH make -s -f "$TOP/examples/tiles/Makefile" SCAN="$PWD/torus.xyz" OUT=killed killed/boxes >log \
	2>&1 ||
    complain "boxes of nothing: $(cat log)"
[ ! -e killed/boxes ] || complain "boxes of nothing are there"
make -s -f "$TOP/examples/tiles/Makefile" SCAN="$PWD/torus.xyz" OUT=killed killed/boxes ||
	complain "no boxes behind that"
mr-make sphere --points 3000 >ball.mrs
mr-transform --translate 6,0,0 ball.mrs | mr-cat --append ball.mrs - | mr-export -l points two.xyz
! make -s -f "$TOP/examples/tiles/Makefile" SCAN="$PWD/two.xyz" OUT=two >log 2>&1 ||
	complain "a seam that is none: $(cat log)"
grep -q 'nothing would be left' log || complain "it is not told why there is no seam: $(cat log)"
exit $fail
