# Two frames beside each other with one camera: one is kept while the film, the level, the pose, the paint or the model goes on.
. "$TOP/tests/page/begin"
mr-make bumpy -n 1500 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-solve --basis | mr-encode -o pose.mrs
mr-pose -q -H 1 --rotate 0,0,1,40 --frames 3 pose.mrs | mr-decode -q -o film.mrs || exit
mr-view -i film.mrs film.html && mr-view -i pose.mrs pose.html || exit
mr-make sphere -n 400 | mr-simplify -t control -n 40 | mr-sample -n 2 | mr-view -l displacement levels.html || exit
mr-make torus -n 500 | mr-transform --translate 100,0,0 -o torus.mrs && mr-make cube -n 500 -o cube.mrs && mr-view models.html torus.mrs cube.mrs || exit
exec python3 "$TOP/tests/page/beside.py"
