# Models so large that every tool's loops are shared out among threads: the same bytes from one thread as from eight, and under
# the thread sanitizer (make check SAN=thread T=threads) no race.
[ -z "$SAN" ] || [ "$SAN" = thread ] || { echo "another sanitizer shows nothing more of threads"; exit 77; }
export TSAN_OPTIONS=halt_on_error=1:exitcode=66
fail=0 n=0
bad() {
	echo "$*"
	fail=1
}
mr-make bumpy -n 6000 -o mesh.mrs
mr-make bumpy --points 6000 --noise 0.002 -o points.mrs
try() { # result or -, command
	made=$1
	shift
	n=$((n + 1))
	if ! "$@" -j 8 -q >eight 2>err; then
		bad "$* -j 8: exit $?: $(head -n 30 err)"
	elif [ "$SAN" != thread ]; then # of which one has no races
		"$@" -j 1 -q >one 2>err || bad "$* -j 1: exit $?: $(cat err)"
		cmp one eight || bad "$*: other bytes from eight threads"
	fi
	[ "$made" = - ] || mv eight "$made"
}
try - mr-make bumpy -n 6000 --noise 0.001
try off mr-export -f off -i mesh.mrs -
try - mr-import -f off off
try obj mr-export -f obj -i mesh.mrs -
try - mr-import -f obj obj
try smooth.mrs mr-smooth mesh.mrs
try - mr-smooth -m taubin mesh.mrs
try base.mrs mr-remesh smooth.mrs
try - mr-remesh --adaptive 0.5% --feature 40 mesh.mrs
try free.mrs mr-select --free all --fixed below:y,0.3 --handle 1=above:y,0.8 base.mrs
try encoded.mrs mr-encode free.mrs
try posed.mrs mr-pose -H 1 --rotate 0,0,1,30 encoded.mrs
try solved.mrs mr-solve posed.mrs
try basis.mrs mr-solve --basis encoded.mrs
try - mr-solve -s multigrid --flatten encoded.mrs
try - mr-solve --arap 2 posed.mrs
try - mr-decode solved.mrs
try - mr-decode basis.mrs
try - mr-compare --json -a mesh -b base -i posed.mrs
try - mr-info --json mesh.mrs
try - mr-normals -l points points.mrs
try - mr-shrinkwrap -m volume points.mrs
try wrap.mrs mr-shrinkwrap -m cube -r 16 points.mrs
try control.mrs mr-simplify -n 400 wrap.mrs
try fit.mrs mr-fit -n 2 control.mrs
try - mr-fit -n 2 -m local control.mrs
try displaced.mrs mr-sample -n 2 fit.mrs
try - mr-sample -n 2 -m robust fit.mrs
try - mr-sample -n 2 -m triangle fit.mrs
try - mr-decode displaced.mrs
try - mr-equalize --gain 1,0.5 displaced.mrs
try - mr-subdivide -n 2 --limit control.mrs
try - mr-subdivide --longest 2% mesh.mrs
try - mr-map -w map displaced.mrs
try - mr-pack -i displaced.mrs -
try - mr-render --size 200x200 -i mesh.mrs -
try - mr-view -i mesh.mrs -
try - mr-transform --rotate 1,0,0,20 mesh.mrs
try cropped.mrs mr-crop --keep below:y,0.8 mesh.mrs
try - mr-fill cropped.mrs
try - mr-align cropped.mrs mesh.mrs
try - mr-align --all cropped.mrs
try - mr-split mesh.mrs
try - mr-cat -z mesh.mrs
echo "$n commands"
exit $fail
