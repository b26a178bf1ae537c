# An option that has no effect beside the others, or on the shape, is a wrong command line: exit 2, nothing on stdout.
mr-make cube -n 8 >cube.mrs
printf 'frame\n0 scale=2\n' >script
while read -r line; do
	$line <cube.mrs >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done <<'LINES'
mr-make sphere --genus 2
mr-make cylinder --genus 0
mr-make boxes --open
mr-make cube --seed 2
mr-solve -s lu --iterations 7
mr-solve -s cg --memory 7
mr-make cube -l mesh
mr-cat -l mesh
mr-encode -l mesh
mr-decode -l mesh
mr-equalize -l mesh
mr-map -w map -l control
mr-simplify --creases --to base
mr-simplify --smooth --to base
mr-simplify --smooth --creases
mr-import --points --repair
mr-remesh -L 2% -r 1
mr-subdivide --longest 1 -n 1
mr-remesh -a 0 --gravity 1
mr-remesh --faces 9 --vertices 9
mr-remesh --faces 9 -L 1
mr-remesh --vertices 9 -r 1
mr-pose -H 1 --script script
mr-compare -l mesh -a mesh
mr-compare --vertices --samples 7
mr-compare --vertices --tolerance 0.1
mr-render --columns 2 a.png
mr-render --range 0,1 a.png
LINES
# So is a layer without a name, of every tool that has -l.
for tool in compare crop export fit import info normals pose remesh render sample select shrinkwrap simplify smooth solve split subdivide transform; do
	mr-$tool -l '' cube.mrs >out 2>err
	echo "mr-$tool: exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done
for list in , mesh, ,mesh a,,b; do
	mr-export -l $list out.obj <cube.mrs 2>err
	echo "exit $?: $(head -n 1 err)"
done
# and standard input that is named twice.
for tool in cat import smooth; do
	mr-$tool - - <cube.mrs >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done
mr-compare -a '' -b mesh cube.mrs >out 2>&1
echo "exit $?: $(head -n 1 out)"
# and those that have one
mr-make boxes --genus 3 --seed 2 --noise 0 >boxes.mrs && mr-make cylinder --open >tube.mrs && echo good
