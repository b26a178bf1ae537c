# Handles of a control mesh: the displaced surface follows on the level that is shown, as mr-pose | mr-decode have it,
# and the line says so.
. "$TOP/tests/page/begin"
mr-make bumpy -n 6000 --points 8000 | mr-shrinkwrap -q | mr-simplify -q -n 300 | mr-fit -q | mr-sample -q -o scan.mrs &&
	mr-select -q --free all --fixed below:y,0.2 --handle 1=above:y,0.8 --handle 3=above:x,0.85 scan.mrs -o \
		picked.mrs &&
	mr-solve -q --basis picked.mrs -o rest.mrs && mr-view -q -i rest.mrs rest.html || exit
mr-transform --translate 5e5,4e6,-3e5 picked.mrs | mr-solve -q --basis -o far.mrs &&
	mr-pose -H 3 --rotate 0,0,1,20 far.mrs -o posed.mrs && mr-view -q -i posed.mrs posed.html || exit
exec python3 "$TOP/tests/page/drag_control.py"
