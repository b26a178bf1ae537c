/* solving.js -- makes what painted handles are dragged by: a basis, and where there is no base, that and the detail
 * over it (library/basis.c).  The columns are put into the frame. */
import { library } from "../library/compile.js";
import { columnOf, keyOf } from "../stream/stream.js";
import { FREE, HANDLE } from "./regions.js";

const MOST = 50000; /* vertices: a few seconds */
const COLUMNS = { /* of basis.c, in order: where, how many numbers a row, of what */
	"base position": [3, Float64Array, "base"],
	"base triangles": [3, Uint32Array, "faces"],
	"base response": [0, Float64Array, "base"],
	"mesh detail_face": [1, Uint32Array, "mesh"],
	"mesh detail_bary": [3, Float64Array, "mesh"],
	"mesh detail_height": [1, Float64Array, "mesh"],
	"mesh detail_offset": [3, Float64Array, "mesh"],
};

/* The columns that a basis is made of; null: it cannot be made here. */
function partsOf(frame, { name, regions, triangles }) {
	const parts = ["mesh position", "base position", "mesh triangles", "base triangles"].map((column) =>
		columnOf(frame, ...column.split(" ")));
	const base = parts[1] && parts[3] ? parts[1] : parts[0], there = (r) => regions.counts.get(r) > 0;

	return name === "mesh" && triangles && base.rows <= MOST && !frame.film &&
		!columnOf(frame, "handles", "transform") && there(FREE) && [...regions.counts.keys()].some((r) =>
		r >= HANDLE && there(r)) ? parts : null;
}

export const canSolve = (frame, work) => Boolean(partsOf(frame, work));

/* Whether there is a basis now; else a part of the model is not held, or memory is short. */
export async function solve(frame, work) {
	const columns = partsOf(frame, work), rows = columns.map((c) => (c ? c.rows : 0));
	const values = await Promise.all(columns.map((c) => c && c.values()));
	const places = [...values, work.regions.values].map((v) => library.put(v)),
		model = library.put(Uint32Array.of(...places, rows[0], rows[2], rows[1], rows[3]));
	const basis = library.run.basis_new(model);

	if (basis) {
		putColumns(frame, basis >>> 0, rows[0]);
		library.run.basis_free(basis);
	}
	library.free(model, ...places);
	return Boolean(basis);
}

function putColumns(frame, basis, n) {
	const [nv, nf, handles] = library.get(Uint32Array, basis + 28, 3), rows = { base: nv, faces: nf, mesh: n };
	const places = library.get(Uint32Array, basis, 7);

	frame.solved = true;
	frame.columns.delete(keyOf("base", "encoded"));
	Object.entries(COLUMNS).forEach(([column, [width, Type, of]], i) => {
		const [layer, name] = column.split(" "), components = width || 4 * handles;
		const values = places[i] ? library.get(Type, places[i], rows[of] * components) : null;
		frame.columns.delete(keyOf(layer, name));
		if (values)
			frame.columns.set(keyOf(layer, name), { layer, name, element: of === "faces" ? "f" : "v",
				type: Type === Uint32Array ? "u" : "d", components, rows: rows[of],
				steps: { origin: [0, 0, 0] }, values: async () => values });
	});
}
