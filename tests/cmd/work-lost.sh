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

echo '-- a pose that mesh has not followed, and regions of which mr-solve takes others'
mr-make bumpy -n 1000 | mr-smooth | mr-remesh -q | mr-select --free all --fixed below:y,0.2 --handle 0=above:y,0.8 -o chosen.mrs
mr-pose --translate 1,0,0 chosen.mrs | mr-solve | mr-encode 2>&1 >after.mrs | grep -o 'base has moved.*'
mr-encode chosen.mrs | mr-pose --translate 1,0,0 | mr-solve | mr-decode | mr-encode -o after.mrs
mr-select --free above:y,0.3 --handle 0=above:y,0.8 scan.mrs | mr-pose --translate 0,0,1 | mr-solve | mr-decode -q -o posed.mrs
mr-select --free below:y,0.6 --handle 0=below:y,0.2 posed.mrs 2>&1 >after.mrs | grep -o 'mr-solve.*'
mr-smooth -l mesh posed.mrs | mr-select -l control --free below:y,0.6 2>&1 >after.mrs | grep -o 'mr-solve.*'
mr-decode -q scan.mrs | mr-smooth | mr-remesh -q | mr-encode | mr-decode --from control 2>&1 >after.mrs | grep -o 'mesh, which.*'

echo '-- what was selected goes with the triangles, but where what is made of them has it'
mr-make bumpy -n 1000 | mr-select --free all --handle 0=above:y,0.8 -o selected.mrs
mr-simplify -r 0.5 selected.mrs 2>&1 >after.mrs | grep -o 'mesh is.*'
mr-subdivide selected.mrs -o after.mrs
mr-smooth -q selected.mrs | mr-remesh -q | mr-encode | mr-pose --translate 0,0.2,0 | mr-solve | mr-remesh -q 2>/dev/null -o after.mrs
mr-select -l base --free all edit.mrs | mr-decode | mr-remesh -l base 2>&1 >after.mrs | grep -o 'base is made.*'
mr-select -l control --free all scan.mrs | mr-simplify -l control -r 0.5 2>&1 >after.mrs | grep -o 'control is made.*'

echo '-- what was done to mesh, which mr-decode makes anew, behind any tool; none where it was decoded'
mr-decode -q scan.mrs | mr-crop -q -l mesh --keep above:y,0.5 -o half.mrs
mr-decode -q scan.mrs | mr-transform -q -l mesh -s 2 -o twice.mrs
mr-decode -q scan.mrs -o decoded.mrs
mr-map -q -w map decoded.mrs -o mapped.mrs
for frame in half twice decoded; do
	for tool in mr-decode 'mr-equalize -g 1,2' mr-sample 'mr-map -r map-height.png'; do
		case $tool in mr-map*) mr-map -q -w map $frame.mrs -o mapped.mrs ;; *) cp $frame.mrs mapped.mrs ;; esac
		echo "$frame, $tool: $($tool mapped.mrs 2>&1 >after.mrs | grep -o 'what was done to it.*')"
	done
	echo "$frame, mr-pose: $(mr-select -l control --free all --fixed below:y,0.2 --handle 0=above:y,0.8 $frame.mrs |
	    mr-pose -l control --translate 0,1,0 2>&1 >after.mrs | grep -o 'what was done to it.*')"
done
mr-select -l control --free all --fixed below:y,0.2 --handle 0=above:y,0.8 decoded.mrs | mr-pose --translate 0,1,0 | mr-solve |
    mr-transform -r 1,2,3,40 | mr-decode -q | mr-equalize -g 1,2 2>&1 >after.mrs | grep 'what was done to it' || echo none behind a pose
mr-decode -q --level 1 scan.mrs | mr-equalize -g 1,2 2>&1 >after.mrs | grep 'what was done to it' || echo none of a coarser level

echo '-- the same at another level, and by mr-subdivide of control; a second edit, whose detail has served'
mr-decode -q --level 1 scan.mrs | mr-transform -q -l mesh -t 1,0,0 | mr-decode 2>&1 >after.mrs | grep -o 'what was done to it.*'
mr-subdivide -l control half.mrs 2>&1 >after.mrs | grep -o 'what was done to it.*'
mr-subdivide -q -l control decoded.mrs -o after.mrs
mr-select --free all --handle 0=above:y,0.8 edit.mrs | mr-pose --translate 0,0.2,0 | mr-solve | mr-decode | mr-smooth -l mesh 2>&1 >after.mrs |
    grep 'detail' || echo none
