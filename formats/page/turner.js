/*
 * turner.js -- the worker that finds how the base has turned, so that the page need not wait for it: told once what the base is
 * at rest, then where it is, it answers with the normals there, and offsets of detail, turned.
 */
import { offsetIn, phongNormals } from "./deform/phong.js";
import { Turns } from "./deform/turns.js";

let normals, turns, offsets;

/* Offsets as vectors at rest: { corners, weights, vector }. */
function prepare({ rest, triangles, rows }) {
	normals = phongNormals(rest, triangles);
	turns = new Turns(rest, triangles);
	offsets = rows.map(({ corners, weights, offset }) => ({ corners, weights, vector: offsetIn(rest, normals, corners, weights, offset) }));
}

function turned({ corners, weights, vector: [x, y, z] }) {
	const m = turns.mean(corners, weights);

	return [0, 3, 6].map((i) => m[i] * x + m[i + 1] * y + m[i + 2] * z);
}

addEventListener("message", ({ data }) => {
	if (data.rest)
		prepare(data);
	const began = performance.now(), out = new Float64Array(normals.length);
	turns.find(data.position);
	turns.apply(normals, out);
	const moved = new Float64Array(offsets.flatMap(turned));
	postMessage({ normals: out, offsets: moved, position: data.position, took: performance.now() - began }, [out.buffer, moved.buffer, data.position.buffer]);
});
