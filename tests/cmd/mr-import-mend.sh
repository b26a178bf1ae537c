# What has come apart: vertices near each other are joined, those on edges stitched in, parts inside out turned.
figures() {
	mr-info --no-intersections | grep -oE 'vertices, .*|components.*|volume.*'
}
words() { # of a finding
	sed 's/.*repaired: //; s/ \[repaired\]//'
}
echo '-- T-junctions: one in the middle of an edge, several, in both of two faces, and beside it by 1e-6'
cat >cube.obj <<'X'
v 0 0 0
v 1 0 0
v 0 1 0
v 1 1 0
v 0 0 1
v 1 0 1
v 0 1 1
v 1 1 1
v 0.5 0.000001 0
v 0.25 0 0
v 0 0 0.75
f 1 3 4
f 1 4 2
f 5 6 8
f 5 8 7
f 1 6 5
f 3 7 8
f 3 8 4
f 11 5 7
f 11 7 3
f 11 3 1
f 2 4 8
f 2 8 6
f 1 10 6
f 10 9 6
f 9 2 6
X
mr-import --repair cube.obj 2>said | figures
words <said
printf 'v 0 0 0\nv 3 0 0\nv 1 1 0\nv 1 0 0\nv 4 0 0\nv 2 -1 0\nvt 0 0\nvt 3 0\nvt 1 1\nvt 0 0\nvt 1 0\nvt 0.5 1\nusemtl up\nf 1/1 2/2 3/3\nusemtl down\nf 5/4 4/5 6/6\n' >slide.obj
mr-import --repair slide.obj 2>said | mr-export -f obj - | grep -E '^(vt|f|usemtl)'
words <said
echo '-- soup that is off by 1e-6 of its size comes together; what is whole, or has a slit, stays'
mr-make torus -n 1000 | mr-export -q torus.obj
apart() { # by how much
	awk -v by="$1" 'BEGIN { srand(7) } function off() { return by * (rand() - 0.5) }
		$1 == "v" { n++; x[n] = $2; y[n] = $3; z[n] = $4 }
		$1 == "f" { for (i = 2; i < 5; i++) print "v", x[$i] + off(), y[$i] + off(), z[$i] + off()
			print "f -3 -2 -1" }' torus.obj
}
for by in 0 1e-9 1e-6 1e-3; do
	apart $by >soup.obj
	mr-import --weld auto --repair soup.obj 2>said | figures
	words <said
done
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.2 0 0\nv 2.2 0 0\nv 2.2 1 0\nv 1.2 1 0\nf 1 2 3 4\nf 5 6 7 8\n' >slit.obj
for file in torus.obj slit.obj; do
	mr-import --weld auto $file | figures
done
printf '0 0 0\n0 0 0\n1 0 0\n' | mr-import --weld auto | figures
echo '-- inside out: a body in a hollow of another, one beside it, and a sheet'
ball() { # NAME, scale, shift, inside out
	mr-make sphere -n 300 | mr-transform --scale "$2" --translate "$3,0.3,0" | mr-export -q "$1.obj"
	[ "$4" != yes ] || { awk '$1 == "f" { print $1, $2, $4, $3; next } { print }' "$1.obj" >turned && mv turned "$1.obj"; }
}
for way in no yes; do
	other=$([ $way = no ] && echo yes || echo no)
	ball shell 1 0 $way
	ball hollow 0.5 0.1 $other
	ball kernel 0.2 0.1 $way
	ball beside 0.5 3 $way
	for bodies in shell 'shell hollow' 'shell hollow kernel beside'; do
		mr-import $(printf '%s.obj ' $bodies) | mr-cat --append | mr-export -q all.obj
		for options in --repair --outward '--repair --outward'; do
			echo "$bodies: $options: $(mr-import $options all.obj 2>said | figures | tail -n 1)"
			words <said
		done
	done
done
mr-make sphere -n 300 | mr-crop --keep above:z,0.2 | mr-export -q cup.obj
mr-make plane -n 20 | mr-export -q plane.obj
for file in cup plane; do
	mr-import --outward $file.obj 2>&1 | mr-export -f obj - | cmp - $file.obj && echo "$file stays"
	awk '$1 == "f" { print $1, $2, $4, $3; next } { print }' $file.obj >turned.obj
	mr-import --outward turned.obj 2>said | mr-export -f obj - | cmp - turned.obj || words <said
done
echo '-- wrong command lines'
mr-import --weld automatic torus.obj 2>&1 | head -n 1
mr-import --points --outward torus.obj 2>&1 | head -n 1
mr-import --repair --outward cup.obj -j 1 --no-history -o a.mrs
mr-import --repair --outward cup.obj -j 4 --no-history -o b.mrs
cmp a.mrs b.mrs
