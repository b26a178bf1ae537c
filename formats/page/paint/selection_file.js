/*
 * selection_file.js -- regions as a text, which mr-select --from reads (its page says how it is made): written, and read
 * as strictly as there.
 */
import { FIXED, FREE, HANDLE } from "./regions.js";

const WIDTH = 100; /* characters of a line, about */
const WORD = "mr-selection";

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

	return [WORD, 1, model.layer, model.vertices, t.length / 3, checksum(t)].join(" ");
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

/* Lines of about one width that begin with the region's name. */
function linesOf(name, words) {
	const lines = [];
	let line = name;

	for (const word of words) {
		line += " " + word;
		if (line.length >= WIDTH) {
			lines.push(line);
			line = name;
		}
	}
	return line === name ? lines : [...lines, line];
}

/* The text of all regions. */
export function write(model, values) {
	const found = [...ranges(values)].sort((a, b) => a[0] - b[0]);

	return [head(model), ...found.flatMap(([region, words]) => linesOf(nameOf(region), words))].join("\n") + "\n";
}

function refuse(line, why) {
	throw new Error((line ? "Line " + line + ": " : "") + why + " Nothing was changed.");
}

const quoted = (words) => "“" + (words.length > 40 ? words.slice(0, 40) + "…" : words) + "”";

function checkHead(line, model) {
	const words = line.split(/[ \t]+/), wanted = head(model).split(" ");

	if (words[0] !== WORD)
		refuse(1, "This is no file of regions, which begins with " + WORD + ".");
	if (words[1] !== "1")
		refuse(1, quoted(line) + " is not version 1, which this page reads.");
	if (words[2] !== model.layer)
		refuse(1, "These are regions of " + quoted(words[2] || "") + ", not of " + quoted(model.layer) + ".");
	if (words.length !== 6 || words.some((w, i) => i > 2 && w !== wanted[i]))
		refuse(1, "These regions are of another model: " + quoted(words.slice(3).join(" ")) + ", where this one has " + quoted(wanted.slice(3).join(" ")) + ".");
}

/* A whole number; -1: none. */
function whole(word) {
	return /^[0-9]{1,10}$/.test(word || "") ? Number(word) : -1;
}

/* The region that the words begin with, which are taken away. */
function takeRegion(words, number) {
	const name = words.shift(), handle = name === "handle" ? whole(words[0]) : -1;

	if (name === "fixed" || name === "free")
		return name === "free" ? FREE : FIXED;
	if (handle < 0 || handle > 65535)
		return refuse(number, quoted([name, ...words].join(" ")) + " does not begin with fixed, free, or handle and its number up to 65535.");
	words.shift();
	return HANDLE + handle;
}

function takeRange(word, number, region, vertices, given) {
	const ends = word.split("-"), first = whole(ends[0]), last = ends.length > 1 ? whole(ends[1]) : first;

	if (ends.length > 2 || first < 0 || last < first)
		refuse(number, quoted(word) + " is neither a vertex nor a range as 3-17.");
	if (last >= vertices)
		refuse(number, "vertex " + last + " of " + vertices + ", which are counted from 0.");
	for (let v = first; v <= last; v++) {
		if (given[v] !== undefined)
			refuse(number, "vertex " + v + " has a region already.");
		given[v] = region;
	}
}

/* What the text says, as vertices and their regions; throws a sentence where it is malformed or of another model. */
export function read(text, model) {
	const lines = text.split("\n").map((line) => line.replace(/#.*/, "").replace(/^[ \t\r]+|[ \t\r]+$/g, ""));
	const given = new Array(model.vertices), vertices = [];

	checkHead(lines[0], model);
	lines.forEach((line, i) => {
		if (i === 0 || line === "")
			return;
		const words = line.split(/[ \t]+/), region = takeRegion(words, i + 1);
		if (words.length === 0)
			refuse(i + 1, quoted(line) + " has no vertex.");
		for (const word of words)
			takeRange(word, i + 1, region, model.vertices, given);
	});
	for (let v = 0; v < model.vertices; v++)
		if (given[v] !== undefined)
			vertices.push(v);
	if (vertices.length === 0)
		refuse(0, "No line gives a vertex a region.");
	return { vertices, regions: vertices.map((v) => given[v]) };
}
