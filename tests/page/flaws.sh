# Folded edges are as many as mr-info counts, of what the page subdivides and poses too; intersecting faces are those of another test.
. "$TOP/tests/page/begin"
mr-make torus -n 400 --noise 0.4 --seed 3 -o noisy.mrs && mr-view -i noisy.mrs noisy.html &&
	mr-info --json noisy.mrs >noisy.json || exit
mr-make torus -n 200 -o torus.mrs && python3 "$TOP/tests/page/heights.py" torus.mrs 1 0 7 | mr-equalize -q -g 8,8 -o rough.mrs || exit
mr-view -i rough.mrs rough.html && mr-decode -q --no-check rough.mrs | mr-info --json -l mesh >rough.json || exit
mr-make bumpy -n 2500 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-solve --basis | mr-encode -o edit.mrs || exit
mr-view -i edit.mrs edit.html && mr-pose -q -H 1 --rotate 0,0,1,170 edit.mrs | mr-decode -q | mr-info --json -l mesh >posed.json || exit
exec python3 "$TOP/tests/page/flaws.py"
