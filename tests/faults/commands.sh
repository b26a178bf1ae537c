# One command of each tool and of each format, small: the words are given to try.  What they write is in made/.
mr-make bumpy -n 400 -o mesh.mrs
mr-make bumpy -n 400 --points 600 --noise 0.01 -o points.mrs
mr-crop --keep below:y,0.9 mesh.mrs >cropped.mrs
mr-smooth -t 2 mesh.mrs | mr-remesh -r 1.5 >base.mrs
mr-select --free all --fixed below:y,0.3 --handle 1=above:y,0.8 base.mrs | mr-encode >encoded.mrs
mr-pose -H 1 --rotate 0,0,1,30 encoded.mrs >posed.mrs
mr-solve posed.mrs >solved.mrs
mr-shrinkwrap -r 12 points.mrs >wrap.mrs 2>/dev/null
mr-simplify -n 60 wrap.mrs >control.mrs 2>/dev/null
mr-fit control.mrs >fit.mrs 2>/dev/null
mr-sample -n 2 fit.mrs >displaced.mrs 2>/dev/null
for suffix in obj ply stl off glb; do
	mr-export model.$suffix <mesh.mrs
done
for suffix in xyz pts pwn; do
	mr-export model.$suffix <points.mrs
done
mr-export --quantize --compress packed.glb <mesh.mrs
gzip -k model.obj
mr-make sphere -n 100 --texcoords -o card.mrs
mr-render -s 32x32 --no-labels card.png card.mrs
mr-map --bake card.mrs --texture card.png -w card --size 64 card.mrs | mr-export --materials . textured.glb
mr-import textured.glb -o textured.mrs

for model in model.obj.gz model.ply model.stl model.off model.glb packed.glb textured.glb model.xyz model.pts model.pwn; do
	try mr-import -j1 $model
done
for suffix in obj.gz ply stl off glb; do
	try mr-export -j1 -i mesh.mrs made/x.$suffix
done
try mr-export -j1 -i mesh.mrs --quantize --compress made/x.glb
try mr-export -j1 -i textured.mrs made/x.glb
try mr-export -j1 -i textured.mrs made/x.obj
try mr-make -j1 torus -n 300 --noise 0.01 --seed 3
try mr-make -j1 knot -n 300 --points 200
try mr-cat -j1 -z mesh.mrs points.mrs
try mr-cat -j1 --merge mesh.mrs points.mrs
try mr-cat -j1 --append -o made/all.mrs mesh.mrs mesh.mrs
try mr-info -j1 --json solved.mrs
try mr-compare -j1 -i mesh.mrs base.mrs
try mr-smooth -j1 -t 2 mesh.mrs
try mr-remesh -j1 -r 1.5 mesh.mrs
try mr-select -j1 --free all --fixed geodesic:0,1,0,0.3 mesh.mrs
printf 'mr-selection 1 points 600 0 811c9dc5\nfree 0 2-9\nhandle 1 10\n' >regions
try mr-select -j1 --from regions points.mrs
try mr-encode -j1 base.mrs
try mr-pose -j1 -H 1 --rotate 0,0,1,30 encoded.mrs
try mr-solve -j1 posed.mrs
try mr-solve -j1 --basis encoded.mrs
try mr-decode -j1 solved.mrs
try mr-shrinkwrap -j1 -r 10 points.mrs
try mr-simplify -j1 -n 60 wrap.mrs
try mr-fit -j1 control.mrs
try mr-sample -j1 -n 2 fit.mrs
try mr-decode -j1 displaced.mrs
try mr-equalize -j1 --gain 1,2 displaced.mrs
try mr-subdivide -j1 -n 1 --limit mesh.mrs
try mr-normals -j1 points.mrs
try mr-split -j1 mesh.mrs
try mr-crop -j1 --keep above:y,0.5 mesh.mrs
try mr-fill -j1 --loops 1 cropped.mrs
try mr-align -j1 cropped.mrs mesh.mrs
try mr-align -j1 --all cropped.mrs
try mr-transform -j1 --rotate 0,0,1,30 solved.mrs
try mr-map -j1 -w made/x displaced.mrs
try mr-map -j1 --bake points.mrs -w made/y --size 64 displaced.mrs
try mr-render -j1 --size 64x64 -i mesh.mrs made/x.png
try mr-view -j1 -i posed.mrs made/x.html
try mr-render -j1 --size 64x64 -i textured.mrs made/x.png
try mr-view -j1 -i textured.mrs made/x.html
