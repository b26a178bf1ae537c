# Levels of detail: the surface that the page makes of control mesh and heights is that of mr-decode on every level,
# where edges are sharp, at boundaries, of a scan and posed; what its vertices have goes along, and its page is small.
. "$TOP/tests/page/begin"
levels() { # stream, finest level: what mr-decode makes of each, and the page
	for j in $(seq 0 "$2"); do
		mr-decode -q --no-check --from control --level "$j" "$1.mrs" -o "$1-$j.mrs" || exit
	done
	mr-view -q -i "$1.mrs" "$1.html" || exit
}
mr-make torus -n 200 -o torus.mrs && mr-make cylinder --open -n 150 -o cylinder.mrs &&
	mr-make sphere -n 60 -o ball.mrs || exit
python3 "$TOP/tests/page/heights.py" torus.mrs 3 0 1 >smooth.mrs && levels smooth 3
python3 "$TOP/tests/page/heights.py" torus.mrs 2 0.12 2 >sharp.mrs && levels sharp 2
python3 "$TOP/tests/page/heights.py" cylinder.mrs 3 0 3 >open.mrs && levels open 3
python3 "$TOP/tests/page/heights.py" cylinder.mrs 2 0.3 4 >both.mrs && levels both 2
python3 "$TOP/tests/page/heights.py" ball.mrs 4 0.06 5 >ball-sharp.mrs && levels ball-sharp 4
python3 "$TOP/tests/page/heights.py" ball.mrs 0 0 6 >flat.mrs && levels flat 0
mr-transform --translate 5e5,4e6,-3e5 sharp.mrs -o far.mrs && levels far 2
mr-make bumpy -n 30000 --points 30000 | mr-shrinkwrap -q | mr-simplify -q | mr-fit -q | mr-sample -q -o scan.mrs &&
	levels scan 2
mr-decode -q scan.mrs -o decoded.mrs && mr-view -q -l mesh,displacement -i decoded.mrs decoded.html &&
	mr-view -q -l mesh -i decoded.mrs stored.html &&
	mr-view -q -l displacement -i scan.mrs small.html || exit
mr-make bumpy -n 3000 | mr-cat --merge - scan.mrs | mr-view -q other.html || exit
mr-select -q -l control --free all --fixed below:y,0.2 --handle 1=above:y,0.8 scan.mrs |
	mr-solve -q -l control --basis -o basis.mrs &&
	mr-pose -q -H 1 --rotate 0,0,1,40 --frames 3 basis.mrs | mr-decode -q | mr-view -q film.html &&
	mr-pose -q -H 1 --rotate 0,0,1,40 basis.mrs | mr-decode -q -o posed.mrs || exit
exec python3 "$TOP/tests/page/levels.py"
