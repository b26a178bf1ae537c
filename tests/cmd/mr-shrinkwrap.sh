# A wrapped sphere is a closed surface of genus 0 within the sampling of the points; -j changes nothing.
worst() { # distance of the control's vertices to the unit sphere is below $1
	mr-export -f off -l control - | awk -v least="$1" 'NR == 2 { nv = $1 }
		NR > 2 && NR <= nv + 2 { e = sqrt($1 * $1 + $2 * $2 + $3 * $3) - 1; if (e * e > w) w = e * e }
		END { print (nv && w < least * least ? "on the sphere" : "off by " sqrt(w)) }'
}
mr-make sphere --points 3000 -o sphere.mrs
for m in auto cube volume; do
	echo "$m"
	mr-shrinkwrap -q -m $m sphere.mrs -o out.mrs
	mr-shrinkwrap -q -j 1 -m $m sphere.mrs | mr-export -f off -l control - >one.off
	mr-export -f off -l control - <out.mrs | cmp - one.off && echo same for -j 1
	mr-info -l control out.mrs | sed -n 's/^ *topology *//p'
	worst 0.03 <out.mrs
done

echo 'by the volume, 2'
taken() { # shape, points
	mr-make $1 --points $2 | mr-shrinkwrap --stats stats.json -o out.mrs
	python3 -c '
import json, sys
s = json.loads(open("stats.json").readline())
good = max(s["points_to_surface_max"], s["surface_to_points_max"]) < 2 * s["sampling"]
print(sys.argv[1], s["method"], "covers" if good else s, s["folded_edges"], "folds")' "$1"
	mr-info -l control out.mrs | sed -n 's/^ *topology *//p'
}
taken sphere 2000
taken torus 3000
taken knot 5000

echo 'the resolution is that of the cube: 6 r^2 + 2 vertices'
mr-shrinkwrap -m cube -r 5 sphere.mrs | mr-info -l control - | sed -n 's/^ *control: //p'

echo 'points that repeat change nothing'
mr-export -l points -f xyz - <sphere.mrs >once.xyz
cat once.xyz once.xyz >twice.xyz
for n in once twice; do
	mr-import $n.xyz | mr-shrinkwrap -q -m cube | mr-export -f off -l control - >$n.off
done
cmp once.off twice.off && echo same

echo 'a template keeps its connectivity and goes onto the points'
rename() { # mesh becomes control
	python3 -c '
import records, sys
def other(layer, *rest):
    return (b"control" if layer == b"mesh" else layer, *rest)
sys.stdout.buffer.write(records.changed(sys.stdin.buffer.read(), other))'
}
mr-make sphere -n 500 | mr-export -f off - |
	awk 'NR > 2 && NF == 3 { $0 = 1.3 * $1 " " 1.1 * $2 " " $3 + 0.2 } 1' >start.off
mr-import start.off | rename >start.mrs
mr-cat --merge start.mrs sphere.mrs -o both.mrs
mr-shrinkwrap --template both.mrs -o out.mrs
for f in both out; do
	mr-export -f off -l control - <$f.mrs | awk 'NF == 4' >$f.faces
done
cmp both.faces out.faces && echo same faces
worst 0.03 <out.mrs

echo 'a template loses what followed from where it was: responses and heights'
mr-select --free above:z,0.3 --handle 0=above:z,0.8 both.mrs | mr-solve --flatten | mr-solve --basis | mr-sample -n 1 -o old.mrs
mr-shrinkwrap --template old.mrs -o new.mrs
for f in old new; do
	mr-info $f.mrs | sed -n 's/^ *\(displacement\|height\|rest\|response\) .*/\1/p; s/^ *displacement$/displacement/p' |
		tr '\n' ' '
	echo "in $f.mrs"
done

echo 'points whose distances are no numbers'
mr-make sphere --points 200 | mr-export -f xyz - | awk '{ print $1, $2, $3 } END { for (i = 0; i < 400; i++) print i "e-300", 0, 0 }' >near.xyz
mr-import near.xyz | mr-shrinkwrap >out
echo "exit $?, $(wc -c <out) bytes"
