/* stream.js -- bytes of a stream to frames (mr-stream 5).  A frame is a name and columns, of which one that a delta
 * keeps is the same object in both frames; nothing is unpacked here. */
import { Column } from "./codec.js";

const HEADER = 64;
const text = new TextDecoder();

/* Characters up to the first NUL. */
function nameAt(bytes, at, room) {
	let end = at;

	while (end < at + room && bytes[end])
		end++;
	return text.decode(bytes.subarray(at, end));
}

/* The record whose header is at `at`, and where the next one is. */
function recordAt(bytes, view, at) {
	const stored = Number(view.getBigUint64(at + 56, true));
	const next = at + HEADER + Math.ceil(stored / HEADER) * HEADER;

	if (next > bytes.length)
		throw new Error("The data of the page are cut off: save it again.");
	return {
		layer: nameAt(bytes, at, 16),
		name: nameAt(bytes, at + 16, 24),
		element: String.fromCharCode(bytes[at + 40]),
		type: String.fromCharCode(bytes[at + 41]),
		components: bytes[at + 42],
		packed: bytes[at + 43] === 1,
		rows: Number(view.getBigUint64(at + 48, true)),
		bytes: bytes.subarray(at + HEADER, at + HEADER + stored),
		next,
	};
}

export const keyOf = (layer, name) => layer + "\0" + name;

/* A frame that starts from nothing, or, a delta, from the columns of the one before. */
function begin(record, frames) {
	const said = text.decode(record.bytes);
	const blank = said.indexOf(" ");
	const before = said.startsWith("delta") ? frames[frames.length - 1] : null;

	if (before)
		frames[before.group].film = true;
	return {
		name: said.slice(blank + 1),
		columns: new Map(before ? before.columns : []),
		group: before ? before.group : frames.length, /* number of the key frame */
		film: Boolean(before), /* whether it is one of several of a model */
	};
}

function drop(frame, layer, name) {
	for (const [key, column] of frame.columns)
		if (column.layer === layer && (!name || column.name === name))
			frame.columns.delete(key);
}

/* What a layer of the frame wears: a picture for all of it, or those and the colours of its materials. */
function wearing(frame, layer) {
	frame.wears = frame.wears || new Map();
	if (!frame.wears.has(layer))
		frame.wears.set(layer, { texture: null, materials: new Map() });
	return frame.wears.get(layer);
}

const given = (word, read) => (word === "-" ? null : read(word));

/* What the page's text says: title, caption and file; which columns are stored as sums of steps; which layer is
 * computed; what layers wear. */
async function understand(frame) {
	for (const line of await linesOf(frame, "", "page")) {
		const [how, layer, name, ...more] = line.split(" ");
		if (how === "title" || how === "caption" || how === "file")
			frame[how] = line.slice(how.length + 1);
		else if (how === "beside")
			frame.beside = layer;
		else if (how === "surface")
			frame.displaced = { layer, vertices: [name, ...more].map(Number) };
		else if (how === "packed")
			frame.packed = new Set([layer]);
		else if (how === "texture")
			wearing(frame, layer).texture = Number(name);
		else if (how === "material")
			wearing(frame, layer).materials.set(Number(name),
				{ color: given(more[0], (rgb) => rgb.split(",").map(Number)),
					picture: given(more[1], Number) });
		else
			columnOf(frame, layer, name).setSteps(Number(more[0] || 0), more.slice(1).map(Number));
	}
	return frame;
}

/* A promise of all frames. */
export function parseStream(bytes) {
	const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
	const frames = [];
	let frame = null;

	for (let at = 0; at + HEADER <= bytes.length;) {
		const record = recordAt(bytes, view, at);
		at = record.next;
		if (record.name === "FRAME")
			frames.push((frame = begin(record, frames)));
		else if (record.name === "DROP")
			drop(frame, record.layer, text.decode(record.bytes));
		else if (record.name !== "START" && record.name !== "ENDFRAME" && record.name !== "END")
			frame.columns.set(keyOf(record.layer, record.name), new Column(record));
	}
	return Promise.all(frames.map(understand));
}

/* The frame's column, or undefined. */
export function columnOf(frame, layer, name) {
	return frame.columns.get(keyOf(layer, name));
}

/* The region column of the stream, though another may be painted over it; or undefined. */
export function ownRegion(frame, layer) {
	const column = columnOf(frame, layer, "region");

	return column && "origin" in column ? column.origin : column;
}

/* What a frame is called: by its file too, where that has another name. */
export function titleOf(frame) {
	return frame.file && frame.file !== frame.name ? frame.file + ": " + frame.name : frame.name;
}

/* A name for files of the frame, after its stream's where that is known: of letters, digits and few signs. */
export function fileOf(frame) {
	return (frame.file || frame.name).replace(/[^A-Za-z0-9._-]+/g, "-").replace(/^[-.]+/, "").slice(0, 60) ||
		"model";
}

/* The stream that a line for the shell reads: where the page has solved, that of the saved script. */
export function streamOf(frame) {
	return fileOf(frame) + (frame.solved ? "-painted" : "") + ".mrs";
}

/* A text column's lines; none where there is no such column. */
export async function linesOf(frame, layer, name) {
	const column = columnOf(frame, layer, name);

	return column ? text.decode(await column.values()).split("\n").filter((line, i, all) => line ||
		i < all.length - 1) : [];
}
