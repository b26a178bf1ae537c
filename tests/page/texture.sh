# Pictures on surfaces: the page against mr-render, seams in view; those of materials, repeating and transparent ones,
# JPEG; a pose wears them too.
. "$TOP/tests/page/begin"
python3 "$TOP/tests/page/texture.py" pictures || exit
mr-make sphere -n 3000 --texcoords -o sphere.mrs
mr-make cylinder -n 3000 --texcoords -o cylinder.mrs
mr-view --texture checks.png both.html sphere.mrs cylinder.mrs || exit
for model in sphere cylinder; do
	mr-view --texture checks.png -i $model.mrs $model.html || exit
	for view in front back left; do
		mr-render -s 984x800 --no-labels --view $view --texture checks.png -i $model.mrs $model-$view.png ||
			exit
	done
done
cat >card.obj <<'END'
mtllib card.mtl
v 0 0 0
v 3 0 0
v 3 1 0
v 0 1 0
v 1 0 0
v 2 0 0
v 1 1 0
v 2 1 0
vt 0 0
vt 2 0
vt 2 1
vt 0 1
usemtl picture
f 1/1 5/2 7/3 4/4
usemtl colour
f 5/1 6/2 8/3 7/4
usemtl neither
f 6/1 2/2 3/3 8/4
END
mr-import card.obj -o card.mrs
mr-view --materials . -i card.mrs card.html || exit
mr-import card.obj | mr-view --texture clear.png clear.html || exit
mr-make bumpy --texcoords -n 2500 | mr-smooth | mr-remesh |
	mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-solve --basis |
	mr-encode -o pose.mrs && mr-view --texture checks.png -i pose.mrs pose.html || exit
mr-pose -H 1 --translate 0.2,0.4,0 pose.mrs | mr-decode | mr-view -l mesh --texture checks.png posed.html || exit
exec python3 "$TOP/tests/page/texture.py"
