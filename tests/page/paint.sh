# Regions painted in the page: brush and parts give exactly the vertices that they should, undo takes them back, and
# what is saved mr-select reads as those regions; malformed texts change nothing.
. "$TOP/tests/page/begin"
mr-make plane -n 2601 -o plane.mrs || exit
mr-make bumpy -n 5000 | mr-select --free all --fixed below:y,0.2 -o bumpy.mrs || exit
{ mr-make sphere -n 300; mr-make torus -n 300 | mr-transform --translate 3,0,0; } | mr-cat --append -o parts.mrs || exit
mr-make torus --points 3000 -o points.mrs || exit
mr-make sphere -n 500000 -o million.mrs || exit
mr-make bumpy -n 2000 | mr-smooth | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
	mr-pose -q -H 1 --rotate 0,0,1,30 --frames 2 -o film.mrs || exit
{ mr-make torus -n 500; mr-make cube -n 500; } >two.mrs || exit
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 5 5 5\nf 1 2 3\nf 3 2 4\n' | mr-import |
	mr-select --free 'box:0,0,0,0,0,0' --handle 0='box:1,0,0,1,0,0' --handle 41='box:0,1,0,0,1,0' -o small.mrs ||
		exit
for model in plane bumpy parts points million film two small; do
	mr-view -q -i $model.mrs $model.html || exit
done
exec python3 "$TOP/tests/page/paint.py"
