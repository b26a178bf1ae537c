/* coloring.js -- what gives the colours: a column, what layers wear, or nothing; of all that is seen.  A side is {
 * frame, layers, drawn }: layers that are seen, and what is drawn of each by its name. */
import { kindOf, kindsOf, paint, rangeOf } from "./draw/column_colors.js";
import { costumeOf } from "./draw/pictures.js";
import { posedBy } from "./deform/poser.js";
import { listColors, showLegend } from "./side.js";
import { TEXTURE, namesOf } from "./stream/layers.js";
import { columnOf } from "./stream/stream.js";

/* Whether something was painted by the same as now. */
function isKey(painted, key) {
	return Boolean(painted) && key.length === painted.length && key.every((x, i) => x === painted[i]);
}

/* Gives a layer its pictures, where it does not have them already. */
async function dress(drawn, layer, pictures) {
	const key = [layer.wears, layer.texcoord, layer.material];

	if (isKey(drawn.painted, key))
		return;
	drawn.painted = key;
	drawn.wear(await costumeOf(layer, pictures));
}

/* Paints by the column, if the layer has it, where it is not painted so already. */
async function paintBy(drawn, column, range) {
	const key = column ? [column, range.low, range.high, column.version] : [];

	if (isKey(drawn.painted, key))
		return;
	drawn.painted = key;
	drawn.paint(column ? paint(column, await column.values(), range) : null, Boolean(column) &&
		column.element === "f");
}

/* What layers wear, or their own colours, unless they are all the same: black, where a format has a place for them and
 * no more; of what can be posed its regions. */
async function ownColor(frame, all) {
	if (all.some(({ layer }) => layer.wears))
		return TEXTURE;
	for (const { layer } of all) {
		const column = columnOf(frame, layer.name, "color");
		const values = column ? await column.values() : [];
		if (values.some((x, i) => x !== values[i % column.components]))
			return "color";
	}
	return posedBy(frame) && !frame.film ? "region" : "";
}

/* What the colours mean, over all layers that are seen; a range stays until it is chosen anew. */
async function legend(frame, all, name, choice) {
	const columns = all.map(({ layer }) => columnOf(frame, layer.name, name)).filter(Boolean);
	const kind = kindOf(columns[0]), values = await Promise.all(columns.map((c) => c.values()));

	if (kind === "number" && !choice.range) {
		const ranges = columns.map((c, i) => rangeOf(c, values[i]));
		choice.range = { low: Math.min(...ranges.map((r) => r.low)),
			high: Math.max(...ranges.map((r) => r.high)) };
	}
	const kinds = kind === "region" || kind === "kind" ? kindsOf(values.flatMap((v) => kindsOf(v))) : [];
	return { kind, range: choice.range, kinds, names: kinds.length ? await namesOf(frame, columns[0].layer, name) :
		[] };
}

/* Colours a side by the choice { color, range }, whose range it finds where there is none; returns what colours: the
 * one chosen, before any is, what the layers wear or their own colours. */
export async function colour({ frame, layers, drawn: by }, choice, pictures) {
	const all = layers.map((layer) => ({ layer, drawn: by.get(layer.name).drawn }));
	const names = [...new Set(all.flatMap(({ layer }) => [...(layer.wears ? [TEXTURE] : []),
		...layer.colors.map((c) => c.name)]))];
	const chosen = choice.color === null ? await ownColor(frame, all) : choice.color,
		name = names.includes(chosen) ? chosen : "";

	listColors(names, name);
	showLegend(name && name !== TEXTURE ? await legend(frame, all, name, choice) : null);
	for (const { layer, drawn } of all)
		if (name === TEXTURE && layer.wears)
			await dress(drawn, layer, pictures);
		else
			await paintBy(drawn, name ? columnOf(frame, layer.name, name) : undefined, choice.range || {});
	return name;
}
