/*
 * codec.js -- the values of a column: raw, or packed (mr-stream 5, codec 1): differences of rows, their bytes in planes,
 * deflated.  Unpacked values are kept as long as there is room for them.
 */
const ROWS = 32768;
const ROOM = 256 << 20; /* bytes of unpacked columns that are kept */
const SIZE = { d: 8, u: 4, b: 1, t: 1 };
const ARRAY = { d: Float64Array, u: Uint32Array, b: Uint8Array, t: Uint8Array };

async function inflate(bytes) {
	const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));

	return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* Sums of the differences of one component of n rows of 8 bytes, as halves of 4, of which `out` has two a value. */
function join8(planes, at, n, out, first, step) {
	let low = 0, high = 0;

	for (let i = at, o = first; i < at + n; i++, o += step) {
		const d = (planes[i] | planes[i + n] << 8 | planes[i + 2 * n] << 16 | planes[i + 3 * n] << 24) >>> 0;
		low = (low + d) >>> 0;
		high = (high + (low < d ? 1 : 0) + (planes[i + 4 * n] | planes[i + 5 * n] << 8 | planes[i + 6 * n] << 16 | planes[i + 7 * n] << 24)) | 0;
		out[2 * o] = low;
		out[2 * o + 1] = high;
	}
}

function join4(planes, at, n, out, first, step) {
	let sum = 0;

	for (let i = at, o = first; i < at + n; i++, o += step) {
		sum = (sum + (planes[i] | planes[i + n] << 8 | planes[i + 2 * n] << 16 | planes[i + 3 * n] << 24)) >>> 0;
		out[o] = sum;
	}
}

function join1(planes, at, n, out, first, step) {
	let sum = 0;

	for (let i = at, o = first; i < at + n; i++, o += step) {
		sum = (sum + planes[i]) & 255;
		out[o] = sum;
	}
}

const JOIN = { 8: join8, 4: join4, 1: join1 };
const UNIT = { 8: Uint32Array, 4: Uint32Array, 1: Uint8Array };

/* The inverse of the differences and planes, block by block. */
function join(planes, rows, components, size) {
	const buffer = new ArrayBuffer(rows * components * size);
	const out = new UNIT[size](buffer);
	let at = 0;

	if (planes.length !== buffer.byteLength)
		throw new Error("The data of the page are damaged: save it again.");
	for (let first = 0; first < rows; first += ROWS) {
		const n = Math.min(ROWS, rows - first);
		for (let c = 0; c < components; c++, at += n * size)
			JOIN[size](planes, at, n, out, first * components + c, components);
	}
	return buffer;
}

/* Steps, of either direction: 0, 1, 2, 3, ... stand for 0, -1, 1, -2, ... */
function signed(n) {
	return n >>> 1 ^ -(n & 1);
}

/*
 * The values of a column that was written as sums of such steps (the text `page`): whole numbers modulo 2^32, or, where
 * there is a step, so many steps from the origin; what that is of rows of more than three is for others to know.
 */
function fromSums(sums, components, { step, origin }) {
	const out = step ? new Float64Array(sums.length) : new Uint32Array(sums.length);

	for (let c = 0; c < components; c++) {
		const from = components <= 3 ? origin[c] : 0;
		for (let i = c, at = 0, before = 0; i < sums.length; i += components) {
			at = at + signed(sums[i] - before >>> 0) | 0;
			before = sums[i];
			out[i] = step ? from + step * at : at;
		}
	}
	return out;
}

/* Columns whose values are kept, the one asked for longest ago first. */
const kept = new Map();
let used = 0;

function keep(column, values) {
	kept.set(column, values);
	used += values.byteLength;
	for (const [old, its] of kept) {
		if (used <= ROOM || old === column)
			break;
		kept.delete(old);
		used -= its.byteLength;
	}
	return values;
}

/* A column: its shape, and its values when they are asked for. */
export class Column {
	constructor(record) {
		Object.assign(this, record);
	}

	/* rows x components values, not to be written to. */
	async values() {
		const there = kept.get(this);

		if (there) {
			kept.delete(this);
			kept.set(this, there);
			return there;
		}
		return keep(this, await this.read());
	}

	async read() {
		const size = SIZE[this.stored || this.type], Kind = ARRAY[this.stored || this.type];
		const values = new Kind(this.packed ? join(await inflate(this.bytes), this.rows, this.components, size) : this.bytes.slice().buffer);

		return this.steps ? fromSums(values, this.components, this.steps) : values;
	}

	/* Says that it is stored as sums of steps, of numbers where step is not 0. */
	setSteps(step, origin) {
		this.stored = "u";
		this.type = step ? "d" : "u";
		this.steps = { step, origin };
	}

	/* The same values as a column of another name: always the same object. */
	called(layer, name) {
		const key = layer + "\0" + name;

		this.others = this.others || new Map();
		if (!this.others.has(key))
			this.others.set(key, new Copy(this, layer, name));
		return this.others.get(key);
	}
}

class Copy extends Column {
	constructor(of, layer, name) {
		super({ of, layer, name, element: of.element, type: of.type, components: of.components, rows: of.rows });
	}

	values() {
		return this.of.values();
	}
}
