/* picked.js -- the vertex that was clicked: where it is, and what the card says of it. */
import { namesOf } from "./stream/layers.js";
import { numberAt } from "./draw/column_colors.js";
import { regionName } from "./draw/colors.js";
import { columnOf } from "./stream/stream.js";
import { element, number, place } from "./stream/text.js";

/* What a value is called: a name of a kind, numbers of a row. */
async function valueAt(frame, layer, column, row) {
	const values = await column.values(), n = column.components;

	if (column.name === "region")
		return regionName(values[row]);
	if (column.type === "u" && n === 1)
		return (await namesOf(frame, layer, column.name))[values[row]] || String(values[row]);
	const all = Array.from(values.subarray(n * row, n * row + n), number).join("  ");
	return n > 1 && column.type === "d" ? all + " (length " + number(numberAt(column, values, row)) + ")" : all;
}

/* Rows of the card (posed: where its vertices are, around the centre, if not where the stream has them): what, the
 * words for it, and whether a small window goes without. */
export async function rowsOf(frame, layer, picked, centre, extent, color, posed) {
	const position = await layer.position.values(), v = picked.vertex;
	const at = [0, 1, 2].map((c) => (posed ? posed[3 * v + c] + centre[c] : position[3 * v + c]));
	const rows = [["layer", layer.name], ["vertex", String(v)]];
	const region = columnOf(frame, layer.name, "region"), column = color && columnOf(frame, layer.name, color);

	rows.push(["at", place(at, extent)]);
	if (picked.face !== null) {
		const t = await layer.triangles.values();
		rows.push(["face", String(picked.face)]);
		rows.push(["corners", t.subarray(3 * picked.face, 3 * picked.face + 3).join("  "), true]);
	}
	if (picked.face !== null)
		rows.push(["clicked", place(picked.at.map((x, c) => x + centre[c]), extent), true]);
	if (region && region.element === "v")
		rows.push(["region", await valueAt(frame, layer.name, region, v)]);
	if (column && column !== region && (column.element === "v" || picked.face !== null))
		rows.push([color, await valueAt(frame, layer.name, column, column.element === "v" ? v : picked.face)]);
	return rows;
}

/* Fills the card. */
export function tell(card, rows) {
	card.replaceChildren(...rows.flatMap(([what, words, more]) =>
		["dt", "dd"].map((kind, i) => element(kind, i ? words : what, more ? "more" : ""))));
	card.hidden = rows.length === 0;
}
