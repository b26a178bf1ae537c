# What a repair does is said in one line.
cat >model.obj <<'E'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v .5 0 0
v .5 0 1
v .3 .3 .3
vn 0 0 1
vn 0 0 0
usemtl front
f 1//1 5//1 2//1 3//2 4//1
usemtl copy
f 7 6 5
usemtl fin
f 5 2 6
f 1 5 6
f 2 5 7
f 5 6 7
usemtl flat
f 1 5 2
usemtl other
f 4 3 6
usemtl copy of two
f 4 3 6
f 3 6 4
E
mr-import --repair model.obj 2>&1 >model.mrs | sed 's/.*repaired: //'
echo '-- a polygon at whose diagonal two faces stand, and one with two corners at one place' >&2
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\nv .5 .5 -1\nf 1 2 3 4\nf 1 3 5\nf 3 1 6\n' >cut.obj
mr-import --repair cut.obj -o /dev/null
printf 'v 0 0 0\nv 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 5\n' >twice.obj
mr-import --repair twice.obj -o /dev/null
echo '-- faces that welding collapses, and their materials' >&2
printf 'v 0 0 0\nv 0.001 0 0\nv 1 0 0\nv 0 1 0\nusemtl A\nf 1 2 3\nusemtl B\nf 1 3 4\n' >thin.obj
mr-import --weld 0.01 thin.obj -o /dev/null
mr-import --weld 0.0001 thin.obj -o /dev/null
echo '-- what has neither is mended in silence' >&2
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 1 2\n' >quiet.obj
mr-import --repair quiet.obj -o /dev/null
