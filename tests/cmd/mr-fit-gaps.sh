# Both distances through the pipe: every tool has them under the same names, a ball's are what they must be, and surface without
# points is warned of, once more than 1 % of it stands away.
figure() { # file, name: a figure of --stats
	sed "s/.*\"$2\":\([^,}]*\).*/\1/" "$1"
}
mr-make sphere --points 8000 -o points.mrs
mr-shrinkwrap points.mrs --stats mr-shrinkwrap.json | mr-simplify --stats mr-simplify.json | mr-fit --stats mr-fit.json |
	mr-sample --stats mr-sample.json | mr-decode --stats mr-decode.json -o mesh.mrs
for tool in mr-shrinkwrap mr-simplify mr-fit mr-sample mr-decode; do # spacings are 0.04; the chords of 500 faces are 0.009 deep
	grep -oE '"(points_to_surface|surface_to_points|bare)[a-z0-9_]*"' $tool.json | tr -d '"' | paste -sd ' '
	awk -v tool=$tool -v p="$(figure $tool.json points_to_surface_mean)" -v h="$(figure $tool.json points_to_surface_99)" \
	    -v m="$(figure $tool.json points_to_surface_max)" -v s="$(figure $tool.json surface_to_points_mean)" \
	    -v t="$(figure $tool.json surface_to_points_99)" -v u="$(figure $tool.json surface_to_points_max)" \
	    'BEGIN { print tool (p < 0.03 && p <= h && h <= m && m < 0.1 && s > 0.01 && s < 0.04 && s <= t && t <= u && u < 0.12 ? " near" : " far") }'
done
mr-fit -v mesh.mrs 2>&1 >/dev/null | grep -c 'from points, 99 % within'

echo 'a half of a ball, wrapped, whose lid has no points: bare by so much as mr-compare finds'
mr-make sphere --points 8000 | mr-crop -l points --keep above:y,0.5 -o half.mrs 2>/dev/null
mr-shrinkwrap -q --lids all half.mrs | mr-simplify -q | mr-fit --stats half.json -o fitted.mrs 2>&1 | sed 's/warning: .* % of/warning: N % of/; s/up to .*/up to N/'
mr-subdivide -n 4 --limit fitted.mrs -o limit.mrs
mr-compare --json -a mesh -b points <limit.mrs >compare.json
python3 - half.json compare.json <<'END'
import json, sys
ours, theirs = (json.load(open(f)) for f in sys.argv[1:])
for ours, theirs in (ours['surface_to_points_mean'], theirs['a_to_b']['mean']), (ours['points_to_surface_mean'], theirs['b_to_a']['mean']):
    print('as by mr-compare' if abs(ours - theirs) < 0.03 * theirs else f'{ours} is not {theirs}')
END

echo 'a ball, fitted to points with noise, which are not held against it, and to a knot'
mr-make sphere -n 400 | mr-export -f off - | mr-import -l control -o ball.mrs
for cloud in 'sphere --noise 0.05' knot; do
	mr-make $cloud --points 20000 -o points.mrs
	mr-cat --merge ball.mrs points.mrs | mr-fit 2>&1 >/dev/null | sed 's/[0-9.]* from/N from/; s/, where .*//; s/: [0-9.]* % .*/: bare/'
done
