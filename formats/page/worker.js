/*
 * worker.js -- a worker that poses a part of a base with the detail on it: told once what that is (parts.js), then how the
 * handles' maps have changed, it answers with the places of both, in floats.  It writes them where it had written them before, if
 * it is given that back.
 */
import { Base, Detail } from "./deform/decode.js";
import { Kernel } from "./deform/kernel.js";
import { offsetIn, phongNormals } from "./deform/phong.js";
import { Turns } from "./deform/turns.js";

let base, detail, turns, offsets;

/* Offsets in place of heights as vectors at rest: { row, corners, weights, vector }. */
function prepare(part) {
	const kernel = new Kernel(), normals = phongNormals(part.rest, part.triangles);

	base = new Base(kernel, part);
	turns = new Turns(kernel, part.rest, part.triangles, normals);
	detail = new Detail(kernel, part);
	offsets = part.offsets.map(({ row, corners, weights, offset }) => ({ row, corners, weights, vector: offsetIn(part.rest, normals, corners, weights, offset) }));
}

function addOffset({ row, corners, weights, vector: [x, y, z] }, out) {
	const m = turns.mean(corners, weights);

	for (let c = 0; c < 3; c++)
		out[3 * row + c] += m[3 * c] * x + m[3 * c + 1] * y + m[3 * c + 2] * z;
}

const buffersOf = (places) => Object.values(places).map((floats) => floats.buffer);

addEventListener("message", ({ data: { part, changes, places = {} } }) => {
	if (part)
		prepare(part);
	const began = performance.now();
	base.pose(changes);
	turns.find(base.places);
	const now = { base: base.floats(places.base), mesh: detail.floats(base.places, turns.turned, places.mesh) };
	offsets.forEach((offset) => addOffset(offset, now.mesh));
	postMessage({ places: now, took: performance.now() - began }, buffersOf(now));
});
