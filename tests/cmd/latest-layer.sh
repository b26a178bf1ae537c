# Which layer a sink takes: the one that was worked on last; and what it says where that shows in no surface yet.
vertices() { # of what is exported, and of the layers, by name
	mr-export -f off - <"$1" >out.off 2>err
	code=$?
	[ $code -eq 0 ] || { echo "exit $code, $(wc -c <out.off) bytes: $(cat err)"; return; }
	for layer in mesh base control points; do
		mr-export -q -f off -l $layer - <"$1" 2>/dev/null | cmp -s - out.off && echo "exports $layer"
	done
}
mr-make torus -n 300 -o torus.mrs
mr-make torus -n 400 --points 400 -o cloud.mrs

for filter in mr-smooth 'mr-smooth | mr-remesh' mr-remesh 'mr-smooth | mr-simplify -n 100' 'mr-simplify -n 100' \
    'mr-subdivide -n 1' 'mr-smooth | mr-subdivide -q -n 1 -l base' \
    'mr-smooth | mr-crop -l mesh --keep above:x,0.5' 'mr-smooth | mr-transform --scale 2' \
    'mr-smooth | mr-remesh | mr-select --free all' 'mr-smooth | mr-remesh | mr-encode' \
    'mr-smooth | mr-remesh | mr-encode | mr-decode' 'mr-smooth | mr-encode | mr-smooth' \
    'mr-smooth | mr-encode | mr-remesh'; do
	echo "-- $filter"
	eval "$filter" <torus.mrs >frame.mrs
	vertices frame.mrs
done

echo '-- an edit, step by step'
mr-smooth torus.mrs | mr-remesh | mr-select --free all --fixed below:x,0.2 --handle 1=above:x,0.8 -o step0.mrs
mr-encode step0.mrs -o step1.mrs
mr-pose -H 1 --translate 1,0,0 step1.mrs -o step2.mrs
mr-solve step2.mrs -o step3.mrs
mr-decode step3.mrs -o step4.mrs
for i in 0 1 2 3 4; do
	vertices step$i.mrs
done
mr-pose -H 1 --translate 1,0,0 --frames 2 step1.mrs | mr-solve | mr-decode | mr-export posed-%d.off &&
    cmp posed-3.off out.off && echo 'a sequence ends with the pose'
mr-solve --basis step1.mrs -o basis.mrs # moves nothing
vertices basis.mrs
cp step2.mrs step-posed.mrs
mr-view page.html basis.mrs
mr-pose -H 1 --translate 1,0,0 basis.mrs -o posed.mrs
vertices posed.mrs

echo '-- a reconstruction'
mr-shrinkwrap -m cube cloud.mrs | mr-simplify -n 200 -o step0.mrs
mr-fit step0.mrs -o step1.mrs
mr-sample step1.mrs -o step2.mrs
mr-decode step2.mrs -o step3.mrs
for i in 0 1 2 3; do
	vertices step$i.mrs
done
mr-equalize --gain 1,2 step3.mrs -o step4.mrs
vertices step4.mrs
mr-decode step4.mrs | mr-export equalized.off

echo '-- a filter that takes another one says so'
for tool in 'mr-subdivide -n 1' mr-simplify 'mr-crop --keep above:x,0.5' mr-normals; do
	mr-smooth torus.mrs | $tool >/dev/null
	mr-smooth torus.mrs | mr-encode | $tool >/dev/null
	mr-smooth torus.mrs | $tool -l base >/dev/null
done

echo '-- merged and appended'
mr-remesh torus.mrs -o base.mrs
mr-cat --merge cloud.mrs base.mrs >both.mrs
vertices both.mrs
mr-cat --merge base.mrs step0.mrs 2>&1 >both.mrs
vertices both.mrs
mr-cat --append base.mrs base.mrs >both.mrs
vertices both.mrs
mr-info base.mrs | grep latest
mr-info --json base.mrs | grep -o '"latest":"[a-z]*"'
mr-info --json torus.mrs | grep -o '"latest":[a-z]*'

echo '-- of a frame that never had a second surface, its own'
mr-cat --append base.mrs torus.mrs >both.mrs
vertices both.mrs

echo '-- what no surface has followed stays known, whatever is worked on next'
for next in mr-encode 'mr-encode | mr-solve | mr-decode' 'mr-crop --keep above:x,0.5' 'mr-remesh -l mesh' \
    'mr-solve | mr-encode' 'mr-solve | mr-simplify -l mesh --to control'; do
	echo "-- mr-pose | $next"
	eval "$next" <step-posed.mrs >both.mrs
	vertices both.mrs
done
mr-crop --keep above:x,0.5 step4.mrs -o both.mrs # the heights, equalized, over control
vertices both.mrs
mr-smooth step3.mrs | mr-encode | mr-equalize --gain 1,2 -o both.mrs
mr-decode both.mrs | mr-export -f off - | cmp - equalized.off && echo 'decodes what was worked on last'
mr-decode --from detail both.mrs -o both.mrs
vertices both.mrs

echo '-- the other sinks'
mr-smooth torus.mrs | mr-encode | mr-smooth -o moved.mrs
mr-render -s 80x60 picture.png -i moved.mrs && mr-render -l base -s 80x60 picture.png -i moved.mrs

mr-compare torus.mrs -i moved.mrs
mr-compare torus.mrs -a base -b mesh -i moved.mrs | head -n 1
mr-compare torus.mrs -i base.mrs | head -n 1
mr-compare -i moved.mrs | head -n 1
mr-export moved.glb -i moved.mrs
mr-export -l base,mesh moved.glb -i moved.mrs && echo both
exit 0
