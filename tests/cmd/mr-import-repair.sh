# --weld and --repair, and what they say they did.
count() { # vertices and faces of a stream
	mr-export -f obj - | awk '/^v / { v++ } /^f / { f++ } END { print v + 0, f + 0 }'
}
echo '-- three faces at an edge, one of them twice, one without area'
cat >bad.obj <<'X'
v 0 0 0
v 1 0 0
v 0 1 0
v 0 -1 0
v 0 0 1
v 9 9 9
f 1 2 3
f 2 1 4
f 1 2 5
f 3 1 2
f 1 1 2
X
mr-import bad.obj | count
mr-import --repair bad.obj 2>&1 >good.mrs | sed 's/.*repaired: //'
count <good.mrs

echo '-- a tetrahedron with a face inside out'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 4 3\nf 1 4 3\n' >in.obj
mr-import --repair in.obj | mr-export -f obj - | grep f

echo '-- repaired, any shape of mr-make stays as it is, and its soup comes together again'
for shape in sphere torus knot cube; do
	mr-make $shape -n 2000 | mr-export $shape.ply
	mr-import $shape.ply | mr-export -f ply-ascii - >before
	mr-import --repair $shape.ply | mr-export -f ply-ascii - | cmp - before && echo "ok $shape"
	mr-import $shape.ply | mr-export $shape.stl
	[ "$(mr-import $shape.stl | count)" = "$(mr-import $shape.ply | count)" ] && echo "ok $shape.stl"
done

echo '-- welding within a length, and a share of the diagonal'
printf '0 0 0\n0 0 0.001\n1 0 0\n1 0 0\n3 4 0\n' >p.xyz
mr-import p.xyz | mr-export -f xyz - | wc -l
mr-import --weld 0 p.xyz | mr-export -f xyz - | wc -l
mr-import --weld 0.01 p.xyz | mr-export -f xyz - | wc -l
mr-import --weld 20% p.xyz | mr-export -f xyz - | wc -l

echo '-- tools that need a manifold name the way to one'
mr-import bad.obj | mr-remesh 2>&1 >/dev/null | tail -n 1

echo '-- a hollow keeps its side, and a body its own, of whatever few faces are turned in them'
ball() { # NAME, scale, shift, inside out
	mr-make sphere -n 500 | mr-transform --scale "$2" --translate "$3,0,0" | mr-export -q "$1.obj"
	[ "$4" != yes ] || { awk '$1 == "f" { print $1, $2, $4, $3; next } { print }' "$1.obj" >turned && mv turned "$1.obj"; }
	awk '$1 == "f" && ++n == 7 { print $1, $2, $4, $3; next } { print }' "$1.obj" >turned && mv turned "$1.obj"
}
ball shell 1 0 no
ball hollow 0.5 0.1 yes
ball kernel 0.2 0 no
ball apart 0.5 3 no
for bodies in 'shell' 'shell hollow' 'shell hollow kernel' 'shell hollow kernel apart'; do
	mr-import $(printf '%s.obj ' $bodies) | mr-cat --append | mr-export -q all.obj
	mr-import --repair all.obj | mr-info --no-intersections | grep -o 'volume.*' # 4.1 (1 - 1/8 + 1/125 + 1/8)
done
