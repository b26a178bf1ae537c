/*
 * worker.js -- poses a base with the detail on it (library/body.c): told once what they are, then the handles' maps, it
 * answers with the places of both, in floats.
 */
import { Library } from "./library/library.js";

const ARRAYS = ["position", "rest", "triangles", "response", "face", "bary", "height", "offset"];
let library, body, maps, sizes;

/* The whole as body.c has it: places of arrays, how many of each, the origin of the response. */
async function begin({ module, values, counts, origin }) {
	library = await Library.load(module);
	const parts = [Uint32Array.from([...ARRAYS.map((name) => library.put(values[name])), ...counts]),
		Float64Array.from(origin)];
	const whole = library.put(new Uint8Array(await new Blob(parts).arrayBuffer()));

	body = library.had(library.run.body_new(whole));
	library.free(whole);
	maps = library.take(96 * counts[3]);
	sizes = [3 * counts[0], 3 * counts[2]];
}

function pose(values) {
	library.set(maps, values);
	library.had(library.run.body_pose(body, maps));
	const [onBase, onMesh] = library.get(Uint32Array, body, 2);
	return { base: library.get(Float32Array, onBase, sizes[0]), mesh: library.get(Float32Array, onMesh, sizes[1]) };
}

addEventListener("message", async ({ data }) => {
	if (data.module)
		await begin(data);
	const began = performance.now(), places = pose(data.maps);

	postMessage({ places, took: performance.now() - began }, [places.base.buffer, places.mesh.buffer]);
});
