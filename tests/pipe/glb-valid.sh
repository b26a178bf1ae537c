# GLB and glTF of every kind: Khronos' own validator finds no fault.  NODE_PATH names the folder of npm's gltf-validator.
command -v node >/dev/null && node -e 'require("gltf-validator")' 2>/dev/null || {
	echo "no gltf-validator: npm install gltf-validator, and NODE_PATH=.../node_modules"
	exit 77
}
cat >valid.js <<'END'
const fs = require("fs"), { validateBytes } = require("gltf-validator");
const bytes = (file) => new Uint8Array(fs.readFileSync(file));
const externalResourceFunction = (uri) => Promise.resolve(bytes(decodeURIComponent(uri)));
for (const file of process.argv.slice(2))
	validateBytes(bytes(file), { externalResourceFunction }).then((report) => {
		const { numErrors, numWarnings, messages } = report.issues;
		if (numErrors + numWarnings === 0)
			return;
		console.log(file, JSON.stringify(messages.slice(0, 3)));
		process.exitCode = 1;
	});
END

mr-make sphere -n 300 --texcoords -o sphere.mrs
mr-make cube -n 100 -o cube.mrs
mr-make knot --points 100 -o points.mrs
mr-make bumpy -n 2500 | mr-smooth | mr-select --free all --fixed below:y,0.6 --handle 0=above:y,0.9 | mr-solve --basis |
    mr-encode | mr-pose --rotate 0,0,1,70 --frames 4 | mr-decode -o poses.mrs
mr-cat sphere.mrs cube.mrs >several.mrs
models='sphere cube points poses several'
for model in spot.obj.gz pirate.obj.gz mesh_with_colors.off chair_model.obj.gz; do
	[ -n "$DATA" ] || continue
	mr-import -q "$DATA/meshes/$model" -o "${model%%.*}.mrs"
	models="$models ${model%%.*}"
done
for model in $models; do
	mr-export -q -i $model.mrs $model.glb
	mr-export -q --no-normals -i $model.mrs $model-flat.glb
	mr-export -q --quantize -i $model.mrs $model-few.glb
	mr-export -q --quantize --compress -i $model.mrs $model-packed.glb
	mr-export -q -i $model.mrs $model.gltf
done
python3 -c '
from glbs import *
root, data = square([png(8, 8, lambda x, y: (0, 32 * x, 32 * y))])
write("pictures.glb", root, data)'
mr-import pictures.glb -o again.mrs
mr-export -i again.mrs again.glb
mr-export -i again.mrs again.gltf
mr-export -q --lods -i several.mrs levels.glb
node valid.js ./*.glb ./*.gltf
