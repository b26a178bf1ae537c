# From control and displacement: levels, defaults, moved control meshes, deltas, refusals.
mr-make torus --points 3000 -o points.mrs
mr-make torus -n 60 | mr-export -f off - | mr-import -l control - | mr-cat --merge - points.mrs |
	mr-sample -n 3 -o torus.mrs || exit
off() { # file: its mesh
	mr-export -l mesh -f off - <"$1"
}
for level in 0 2 3; do
	mr-decode --level $level torus.mrs -o out.mrs || exit
	mr-info -l mesh out.mrs | sed -n 's/^ *mesh: //p; s/^ *topology *//p'
done
off out.mrs >full.off
mr-decode torus.mrs -o out.mrs
off out.mrs | cmp - full.off && echo 'the default is all'
mr-decode --level 1 torus.mrs | mr-decode -o out.mrs
off out.mrs | cmp - full.off && echo 'the heights are still there'

echo 'what was done to mesh since is gone, and is told; what is as it was made, is not' >&2
mr-decode torus.mrs -o out.mrs
again() { # what was done
	mr-decode 2>&1 >again.mrs | sed "s/^/$1: /" >&2
	mr-info again.mrs | grep -q "mesh: 3840 vertices" || echo "$1: not the whole"
}
mr-crop -l mesh --keep above:z,0.5 out.mrs | again crop
mr-transform -l mesh --translate 0,0,0.1 out.mrs | again move
mr-simplify -q -l mesh -n 500 out.mrs | again simplify
mr-decode --level 1 out.mrs | again level
mr-decode --gain 2 out.mrs | again gain
mr-normals -l mesh out.mrs | again normals
mr-transform --scale 2 out.mrs | mr-transform --scale 0.5 | again transform
mr-make torus -n 3000 -o round.mrs
mr-compare --json -a mesh -b mesh round.mrs <out.mrs | sed 's/.*"hausdorff":\([^,}]*\).*/\1/' |
	awk '{ print ($1 < 0.05 ? "near the torus" : "far: " $1) }'

echo 'detail comes first'
mr-make torus -n 500 | mr-smooth | mr-encode | mr-cat --merge - torus.mrs -o both.mrs
mr-decode both.mrs | mr-info -l mesh | sed -n 's/^ *mesh: //p'
mr-decode --from control both.mrs | mr-info -l mesh | sed -n 's/^ *mesh: //p; /detail/p'

echo 'a control mesh that is posed carries the heights; deltas send positions alone'
mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 torus.mrs | mr-solve -q --flatten -o solved.mrs || exit
mr-solve --basis solved.mrs | mr-pose --translate 0.2,0,0.5 --frames 3 -o film.mrs
mr-decode film.mrs -o decoded.mrs || exit
mr-export frame%d.off <decoded.mrs
mr-solve film.mrs | mr-decode | mr-export slow%d.off
for i in 1 2 3 4; do
	paste frame$i.off slow$i.off | awk 'NF == 6 { for (k = 1; k <= 3; k++) { d = $k - $(k + 3); if (d * d > 1e-20) bad++ } }
		END { print (NR > 3000 && !bad ? "as by mr-solve" : "differ") }'
done
mr-solve --basis solved.mrs | mr-pose --translate 0.2,0,0.5 | mr-decode -o last.mrs
off last.mrs | cmp - frame4.off && echo 'as alone'
mr-decode -j 1 film.mrs | cmp - decoded.mrs && echo same
python3 - decoded.mrs <<'END'
import records, sys
sent = []
for layer, name, *_ in records.read(open(sys.argv[1], 'rb').read()):
    layer, name = layer.decode(), name.decode()
    sent = [] if name == 'FRAME' else sent + [layer + '.' + name]
    if name == 'ENDFRAME':
        last = [s for s in sent if '.' in s[1:]]
print(*last)
END

echo 'what a control mesh has from a file is not on the mesh'
cat >tet.obj <<'X'
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 0 1 0 0 0 1
v 0 0 1 1 1 1
vt 0 0
vt 1 0
vt 0 1
g side
usemtl red
f 1/1 3/2 2/3
f 1/1 2/2 4/3
f 2/1 3/2 4/3
f 1/1 4/2 3/3
X
mr-import -q -l control tet.obj | mr-cat --merge - points.mrs | mr-sample -q -n 1 -o tet.mrs
mr-decode tet.mrs 2>&1 >out.mrs

echo 'refusals'
refused() {
	mr-decode "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes"
	head -n 1 err
}
refused --level 4 torus.mrs
refused --level 16 torus.mrs
refused --level 1 --from detail torus.mrs
refused --level 1 both.mrs
refused --from detail torus.mrs
refused --from base torus.mrs
refused points.mrs
refused --from control points.mrs
mr-make torus -n 60 | mr-export -f off - | mr-import -l control - -o control.mrs
refused --from control control.mrs
mr-pose --scale 2 solved.mrs -o lost.mrs
refused lost.mrs
mr-make sphere -n 42 | mr-export -f off - | mr-import -l control - -o other.mrs
python3 - torus.mrs other.mrs <<'END' # the displacement of one over the control mesh of the other
import records, sys
one, other = (open(path, 'rb').read() for path in sys.argv[1:])
heights = b''.join(records.record(*r) for r in records.read(one) if r[0] == b'displacement')
with open('mixed.mrs', 'wb') as out:
    for r in records.read(other):
        out.write(heights if r[1] == b'ENDFRAME' else b'')
        out.write(records.record(*r))
END
refused mixed.mrs

echo 'heights that are scaled until the surface folds' >&2
mr-make bumpy -n 4000 --points 4000 | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample -o heights.mrs
mr-decode heights.mrs >/dev/null
mr-decode -g 20 heights.mrs 2>&1 >/dev/null | sed 's/[0-9][0-9]* more/N more/g; s/, most of.*//' >&2

echo 'what stands on vertices that are fixed, or of a handle, goes with free ones beside them where control is coarse' >&2
bend() { mr-select --free all --fixed below:x,0.2 --handle 0=above:x,0.8 | mr-pose --rotate 0,1,0,60 | mr-solve -q | mr-decode -o out.mrs; }
mr-make bumpy --points 3000 | mr-shrinkwrap -q -o wrap.mrs
for n in 400 1600; do
	mr-simplify -q -n $n wrap.mrs | mr-sample -q | bend
done
echo 'a mesh from elsewhere beside control and its heights' >&2
mr-make sphere -n 100 | mr-cat --merge - torus.mrs | mr-decode >out.mrs

echo 'a surface in the place of its mesh has what the mesh knows, while control has not moved'
mr-make bumpy --texcoords -n 2000 | mr-simplify --to control | mr-fit | mr-sample -o textured.mrs
mr-select --reset --fixed below:y,0.5 --handle 0=above:y,0.5 -l control textured.mrs |
	mr-pose --translate 0,1,0 | mr-solve -l control | mr-decode | mr-info | grep -c corner_texcoord
mr-decode textured.mrs | mr-info | grep corner_texcoord
