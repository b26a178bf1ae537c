# The work of a tool that another makes stale is told of where it goes: heights over control, detail over base.
told() { # what a tool says, without its numbers
	"$@" 2>said -o after.mrs || echo "$1: exit $?"
	grep -o '\[stale\]' said | sort -u | grep . || echo "$1 says nothing"
}
mr-make bumpy --points 3000 | mr-shrinkwrap -q | mr-simplify -q | mr-fit -q | mr-sample -q -o scan.mrs
told mr-crop --keep above:y,0.3 scan.mrs
told mr-simplify -r 0.5 scan.mrs
told mr-fit scan.mrs
mr-decode -q scan.mrs | mr-transform --scale 2 >after.mrs # what both follow

mr-make bumpy -n 1000 | mr-smooth | mr-remesh -q | mr-encode -q -o edit.mrs
told mr-crop -l base --keep above:y,0.3 edit.mrs
told mr-remesh -l base edit.mrs

echo '-- a pose that mesh has not followed'
mr-make bumpy -n 1000 | mr-smooth | mr-remesh -q | mr-select --free all --fixed below:y,0.2 --handle 0=above:y,0.8 -o chosen.mrs
mr-pose --translate 1,0,0 chosen.mrs | mr-solve | mr-encode 2>&1 >after.mrs | grep -o '\[stale\]'
mr-encode chosen.mrs | mr-pose --translate 1,0,0 | mr-solve | mr-decode | mr-encode -o after.mrs

echo '-- what was selected goes along to coarser and finer surfaces'
mr-make bumpy -n 1000 | mr-select --free all --handle 0=above:y,0.8 -o selected.mrs
mr-simplify -r 0.5 selected.mrs -o after.mrs
mr-subdivide selected.mrs -o after.mrs
