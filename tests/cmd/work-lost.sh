# The work of a tool that another makes stale is told of where it goes: heights over control, detail over base.
told() { # what a tool says, without its numbers
	"$@" 2>said -o after.mrs || echo "$1: exit $?"
	grep 'is gone\|without its displacement' said || echo "$1 says nothing"
}
mr-make bumpy --points 3000 | mr-shrinkwrap -q | mr-simplify -q | mr-fit -q | mr-sample -q -o scan.mrs
told mr-crop --keep above:y,0.3 scan.mrs
told mr-simplify -r 0.5 scan.mrs
told mr-fit scan.mrs
told mr-subdivide scan.mrs
mr-decode -q scan.mrs | mr-transform --scale 2 >after.mrs # what both follow

mr-make bumpy -n 1000 | mr-smooth | mr-remesh -q | mr-encode -q -o edit.mrs
told mr-crop -l base --keep above:y,0.3 edit.mrs
told mr-remesh -l base edit.mrs
told mr-crop --keep above:y,0.3 edit.mrs
