# Maps of heights and normals: another program, which has the files alone, gets the surface that mr-decode makes.
command -v python3 >/dev/null || { echo "no python3"; exit 77; }
fail=0
bad() {
	echo "$*"
	fail=1
}
try() { # name, level: of NAME.mrs, which has control and displacement
	mr-map --write "$1" --stats stats "$1.mrs" -o mapped.mrs && mr-decode mapped.mrs -o decoded.mrs &&
	    mr-export -i decoded.mrs decoded.obj && mr-export -l control "$1.glb" <mapped.mrs &&
	    mr-subdivide -n "$2" --limit -l control mapped.mrs | mr-export domain.obj || { bad "$1 fails"; return; }
	python3 "$TOP/tests/pipe/maps.py" domain.obj decoded.obj "$1.glb" "$1-height.png" "$1-normal.png" || bad "$1 differs"
	range=$(sed 's/.*"low":\([^,]*\),"high":\([^,]*\),.*/\1,\2/' stats)
	mr-export -l control "$1.obj" <mapped.mrs && mr-import -l control "$1.obj" | mr-map --read "$1-height.png" -o back.mrs &&
	    mr-map --write again --range="$range" back.mrs -o again.mrs && cmp "$1-height.png" again-height.png ||
	    bad "$1: read and written again, it is another picture"
	mr-import -q -l control "$1.glb" | mr-map --read "$1-height.png" | mr-decode | mr-export glb.obj
	mr-decode back.mrs | mr-export back.obj
	awk 'function abs(x) { return x < 0 ? -x : x }
		$1 == "v" { if (FNR == NR) { x[++n] = $2; y[n] = $3; z[n] = $4; next } i++
			if (abs(x[i] - $2) + abs(y[i] - $3) + abs(z[i] - $4) > 1e-5) worse++ }
		END { exit !(n && i == n && !worse) }' back.obj glb.obj || bad "$1: GLB and OBJ give other surfaces"
}

mr-make bumpy -n 6000 --points 6000 | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample -n 3 -o bumpy.mrs && try bumpy 3
mr-map --write coarse --level 2 bumpy.mrs | mr-map --read coarse-height.png | mr-decode -o low.mrs
mr-decode --level 2 bumpy.mrs | mr-compare --json -a mesh -b mesh low.mrs | grep -q '"vertex_max_relative":[0-9.]*e-0[6-9]' ||
    bad "a coarser level is another one"

# Open, an odd number of triangles, with a boundary of its own; and the level below which there is none.
mr-make cylinder --open -n 2000 | mr-simplify -n 61 -l mesh | mr-export -f off - | mr-import -l control -o open.mrs
mr-make cylinder --open -n 2000 | mr-select --free all | mr-export -f off - | mr-import -o tube.mrs
mr-cat --merge open.mrs tube.mrs -o both.mrs
mr-sample -n 4 both.mrs -o open.mrs && try open 4
mr-sample -n 0 both.mrs -o flat.mrs && try flat 0
exit $fail
