# Handles dragged by the gizmo, by keys and by the line: the page's vertices are those of mr-pose | mr-decode, and so
# are those that its line makes; so where the page solves for painted handles.
. "$TOP/tests/page/begin"
regions='--free all --fixed below:y,0.2 --handle 1=above:y,0.8 --handle 3=above:x,0.85'
mr-make bumpy -n 2500 | mr-smooth | mr-remesh | mr-select $regions | mr-solve --basis | mr-encode -o rest.mrs || exit
mr-view -i rest.mrs rest.html || exit
# Far from the origin, with offsets at the rims in place of heights, and posed before.
mr-make cylinder -n 1500 --open --noise 0.5% | mr-transform --translate 5e5,4e6,-3e5 | mr-smooth -t 3 | mr-remesh |
	mr-select --free all --fixed below:x,0.1 --handle 1=above:x,0.9 --handle 3=above:y,0.9 | mr-solve --basis |
		mr-encode -o far.mrs || exit
mr-pose -H 3 --rotate 0,0,1,20 --translate 0,0.1,0 far.mrs -o posed.mrs && mr-view -q -i posed.mrs posed.html &&
	cat rest.mrs far.mrs | mr-view -q two.html || exit
mr-make bumpy -n 1500 -o plain.mrs && mr-view -i plain.mrs plain.html || exit
exec python3 "$TOP/tests/page/drag.py"
