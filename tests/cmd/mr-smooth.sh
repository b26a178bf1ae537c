# Diffusion of spheres has a closed form; the map of a new base is the identity; -j changes nothing.
radius() { # of the layer base: mean distance from the origin over that of the mesh
	for layer in mesh base; do
		mr-export -f off -l $layer - <"$1" | awk -v n="$2" 'NR == 2 { nv = $1 }
			NR > 2 && NR <= nv + 2 { s += sqrt($1 * $1 + $2 * $2 + $3 * $3) } END { print s / nv }'
	done | awk '{ r[NR] = $1 } END { print r[2] / r[1] }'
}
mr-make sphere -n 10000 -o sphere.mrs
mr-info sphere.mrs | sed -n 's/.*edge mean \([^,]*\),.*/\1/p' >edge # mean h, of a unit sphere
for t in 10 100; do
	mr-smooth --plain -t $t sphere.mrs -o out.mrs # p' = p / (1 + 2 t h^2)
	radius out.mrs | awk -v t=$t -v h="$(cat edge)" '{ x = 1 / (1 + 2 * t * h * h); e = $1 / x - 1
		print "implicit", t, (e * e < 1e-6 ? "ok" : "bad " e) }'
	mr-smooth --plain -m taubin -t $t sphere.mrs -o out.mrs # stays
	radius out.mrs | awk -v t=$t '{ e = $1 - 1; print "taubin", t, (e * e < 4e-4 ? "ok" : "bad " e) }'
done

# No body passes through itself, however long: a rod keeps 1 / 1.04^2 of its volume, a ball 1 / 1.08^3.
mr-smooth -t 1e6 --stats stats.json sphere.mrs | mr-info -l base | awk '/volume/ { e = $7 / 4.18879 * 1.08 ^ 3 - 1
	print "ball", (e * e < 1e-4 ? "ok" : "bad " e) }'
grep -o '"bounded":[0-9]*' stats.json
mr-smooth --plain -t 1e3 sphere.mrs -o out.mrs # says so
mr-transform --scale 0.02 --translate 3,0,0 sphere.mrs | mr-cat --append sphere.mrs - | mr-smooth --plain -o out.mrs # of one

# Noise goes: the area comes near that of the sphere, 12.566.
mr-make sphere -n 5000 --noise 0.02 -o noisy.mrs
for m in implicit taubin; do
	mr-smooth -m $m -t 3 noisy.mrs -o out.mrs
	mr-info -l base out.mrs | awk -v m=$m '$1 == "size" { print m, ($5 + 0 > 12 && $5 + 0 < 12.7 ? "smooth" : "bad " $5) }'
	mr-smooth -m $m -t 3 -j 1 noisy.mrs | cmp - out.mrs && echo same for -j 1
done

# The boundary stays, and a second smoothing works on the base and keeps its map.
mr-make plane -n 400 --noise 0.02 -o plane.mrs
mr-smooth -t 50 plane.mrs | mr-smooth -t 50 -o out.mrs
mr-info out.mrs | grep -c source_ # face and bary
mr-info -l base out.mrs | sed -n 's/^ *topology *//p'

# A time of 0 changes no byte.
mr-smooth -t 0 plane.mrs -o out.mrs
mr-export -f off -l base - <out.mrs >base.off
mr-export -f off -l mesh - <out.mrs | cmp - base.off && echo unchanged
echo 'two faces that lie on each other'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n' >two.obj
mr-smooth two.obj 2>&1 >out
echo '-- noise of a thin shell does not grow'
mr-make sphere -n 2000 --noise 0.008 -o outer.mrs
mr-make sphere -n 2000 | mr-transform -s 0.85 -o inner.mrs
mr-cat --append outer.mrs inner.mrs -o shell.mrs
mr-smooth -m taubin --stats - shell.mrs 2>&1 >out.mrs | grep -o '"area":[0-9.]*' | awk -F: '{ print ($2 < 1 ? "less area" : $2) }'
