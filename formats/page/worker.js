/*
 * worker.js -- a worker that poses a part of a base with the detail on it (library/body.c): told once what the whole is and which
 * part, then the handles' maps, it answers with the places of both, in floats.  It writes them where it had written them before,
 * if it is given that back.
 */
import { Library } from "./library/library.js";

const ARRAYS = ["position", "rest", "triangles", "response", "face", "bary", "height", "offset"];
let library, body, maps;

/* The whole as body.c has it: places of arrays, how many of each, the origin of the response. */
async function begin({ module, values, counts, origin, part, parts }) {
	library = await Library.load(module);
	const places = ARRAYS.map((name) => library.put(values[name]));
	const whole = library.put(new Uint8Array(await new Blob([Uint32Array.from([...places, ...counts]), Float64Array.from(origin)]).arrayBuffer()));

	body = library.had(library.run.body_new(whole, part, parts));
	library.free(...places.filter(Boolean), whole);
	maps = library.take(96 * counts[3]);
	const [, , vertex, row, vertices, rows] = library.get(Uint32Array, body, 6);
	return { vertices: library.get(Uint32Array, vertex, vertices), rows: library.get(Uint32Array, row, rows) };
}

function pose(values, { base, mesh } = {}) {
	library.set(maps, values);
	library.run.body_pose(body, maps);
	const [onBase, places, , , vertices, rows] = library.get(Uint32Array, body, 6);
	return { base: library.get(Float32Array, onBase, 3 * vertices, base), mesh: library.get(Float32Array, places, 3 * rows, mesh) };
}

addEventListener("message", async ({ data }) => {
	const known = data.module && await begin(data), began = performance.now(), places = pose(data.maps, data.places);

	postMessage({ known, places, took: performance.now() - began }, [places.base.buffer, places.mesh.buffer]);
});
