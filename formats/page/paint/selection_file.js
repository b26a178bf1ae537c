/* selection_file.js -- regions as a text, which mr-select --from reads; its page says how it is made. */
import { FIXED, FREE, HANDLE } from "./regions.js";

/* FNV-1a, a corner at a time. */
export function checksum(t) {
	let sum = 2166136261;

	for (let k = 0; k < t.length; k++)
		sum = Math.imul(sum ^ t[k], 16777619);
	return (sum >>> 0).toString(16).padStart(8, "0");
}

/* model: { layer, vertices, triangles }, triangles null of points. */
function head(model) {
	const t = model.triangles || [];

	return ["mr-selection", 1, model.layer, model.vertices, t.length / 3, checksum(t)].join(" ");
}

function nameOf(region) {
	return region === FIXED ? "fixed" : region === FREE ? "free" : "handle " + (region - HANDLE);
}

/* Ranges of vertices of each region: region: ["3-17", "20", ...]. */
function ranges(values) {
	const out = new Map();

	for (let first = 0, v = 1; v <= values.length; v++)
		if (values[v] !== values[first]) {
			if (!out.has(values[first]))
				out.set(values[first], []);
			out.get(values[first]).push(v - 1 > first ? first + "-" + (v - 1) : String(first));
			first = v;
		}
	return out;
}

/* The text of all regions. */
export function write(model, values) {
	const found = [...ranges(values)].sort((a, b) => a[0] - b[0]);

	return [head(model), ...found.map(([region, words]) => [nameOf(region), ...words].join(" "))].join("\n") + "\n";
}
