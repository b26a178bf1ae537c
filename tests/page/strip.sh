# The strip of a page of several models: names as text, a picture of each, made when it is in view; clicks, keys, the other axis.
. "$TOP/tests/page/begin"
mr-make bumpy -n 2500 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-solve --basis |
	mr-encode | mr-pose -q -H 1 --rotate 0,0,1,40 --frames 2 | mr-decode -q -o film.mrs || exit
mr-make torus -n 500 -o torus.mrs && mr-make knot -n 20000 -o '<img src=x onerror=alert(1)>.mrs' && mr-make cube -n 200 --points 900 -o points.mrs || exit
mr-view few.html film.mrs torus.mrs '<img src=x onerror=alert(1)>.mrs' points.mrs || exit
for i in $(seq 60); do cat torus.mrs; done | mr-view many.html || exit
mr-view -i film.mrs one.html || exit
exec python3 "$TOP/tests/page/strip.py"
