# Models in files beside the page come when they are chosen: films, packed surfaces, under odd names, with the values
# that they have in one page; one that is not there is a sentence.
. "$TOP/tests/page/begin"
mr-make torus -n 500 -o torus.mrs && mr-make bumpy -n 900 | mr-smooth | mr-remesh |
	mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-solve --basis | mr-encode |
	mr-pose -q -H 1 --rotate 0,0,1,40 --frames 2 | mr-decode -q -o film.mrs &&
	mr-make bumpy -n 3000 | mr-simplify -q --to control | mr-fit -q | mr-sample -q -o scan.mrs || exit
set -- torus.mrs film.mrs scan.mrs film.mrs
mr-view -q --pack 0.1% one.html "$@" && mr-view -q --pack 0.1% --beside 'a #%41 page.html' "$@" || exit
rm 'a #%41 page.4.js'
exec python3 "$TOP/tests/page/beside.py"
