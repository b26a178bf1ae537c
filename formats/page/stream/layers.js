/* layers.js -- what a frame has to show: its layers with positions, their columns, and which layer comes first. */
import { columnOf, linesOf } from "./stream.js";

/* Columns that are no values to colour by: places, and what poses or subdivides them. */
const PLACES = new Set(["position", "triangles", "normal", "detail_face", "detail_bary", "detail_offset", "encoded",
	"response", "crease", "texcoord", "corner_texcoord"]);

/* In place of a column to colour by: no column's name has a blank. */
export const TEXTURE = " texture";

/* Layers, in the order of the frame: name, position, triangles (undefined: points), what it wears, colours. */
export function layersOf(frame) {
	const layers = [];

	for (const column of frame.columns.values())
		if (column.name === "position" && column.layer)
			layers.push({
				name: column.layer,
				position: column,
				triangles: columnOf(frame, column.layer, "triangles"),
				normal: columnOf(frame, column.layer, "normal"),
				wears: frame.wears && frame.wears.get(column.layer),
				texcoord: columnOf(frame, column.layer, "corner_texcoord") ||
					columnOf(frame, column.layer, "texcoord"),
				material: columnOf(frame, column.layer, "material"),
				colors: [...frame.columns.values()].filter((c) => c.layer === column.layer &&
					!PLACES.has(c.name) && (c.element === "v" || c.element === "f")),
			});
	return layers;
}

/* The name of the layer that is shown first: the one worked on last, else mesh, control, points or base (mr 7).
 * Displacement is shown by its surface. */
export async function firstLayer(frame, layers) {
	const latest = await linesOf(frame, "", "latest"), surface = frame.displaced && frame.displaced.layer;
	const order = [...latest.map((name) => name === "displacement" && surface || name),
		"mesh", "control", "points", "base"];
	const found = order.find((name) => layers.some((l) => l.name === name));

	return found || layers[0].name;
}

/* Names of the values of a column of kinds: group 0 is the first line of groups, and so on. */
export function namesOf(frame, layer, column) {
	return linesOf(frame, layer, column + "s");
}
