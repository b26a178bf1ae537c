/* packed.js -- surfaces that the page has packed (mr-compact 5): their columns, which are unpacked when the first of
 * them is asked for. */
import { library } from "../library/compile.js";
import { Made } from "../stream/codec.js";
import { columnOf, keyOf } from "../stream/stream.js";

const SHAPES = {
	"control position": ["v", "d", 3],
	"control triangles": ["f", "u", 3],
	"displacement height": ["v", "d", 1],
	"displacement color": ["v", "b", 4],
};
const CONTROL = ["packed_vertex", "packed_half"];

/* All columns of it: of control mesh and displacement, as the stream had them numbered. */
async function unpack(file, [vertex, half], crease, heights) {
	const columns = [file, vertex, half, crease], values = await Promise.all(columns.map((c) => c && c.values()));
	const places = values.map((v) => library.put(v)), { run } = library;
	const at = library.had(run.packed_open(places[0], file.rows, ...places.slice(1)));
	const [position, triangles, height, color] = library.get(Uint32Array, at, 4);
	const all = {
		"control position": library.get(Float64Array, position, 3 * vertex.rows),
		"control triangles": library.get(Uint32Array, triangles, 3 * half.rows),
		"displacement height": library.get(Float64Array, height, heights),
		"displacement color": library.get(Uint8Array, color, 4 * heights),
	};

	run.packed_free(at);
	library.free(...places);
	return all;
}

/* Frames of a film may share a packed surface. */
const known = new Map();

/* Gives a frame the columns of its packed surface, if it has one. */
export function addPacked(frame) {
	const file = columnOf(frame, "displacement", "packed");

	if (!file)
		return;
	const order = CONTROL.map((name) => columnOf(frame, "control", name));
	const heights = frame.displaced.vertices[frame.displaced.vertices.length - 1];
	if (!known.has(file)) {
		let all;
		const rows = [order[0].rows, order[1].rows, heights, heights];
		const of = async (key) => (await (all = all || unpack(file, order,
			columnOf(frame, "control", "crease"), heights)))[key];
		known.set(file, Object.entries(SHAPES).map(([key, [element, type, components]], i) =>
			new Made(...key.split(" "), { element, type, components, rows: rows[i] }, () => of(key))));
	}
	for (const column of known.get(file).slice(0, frame.packed.has("color") ? 4 : 3))
		frame.columns.set(keyOf(column.layer, column.name), column);
	for (const column of [file, ...order])
		frame.columns.delete(keyOf(column.layer, column.name));
}
