/* codec.js -- the values of a column: raw, or packed (mr-stream 5, codec 1): differences of rows, their bytes in
 * planes, deflated. */
import { library } from "../library/compile.js";

const SIZE = { d: 8, u: 4, b: 1, t: 1 };
const ARRAY = { d: Float64Array, u: Uint32Array, b: Uint8Array, t: Uint8Array };

async function inflate(bytes) {
	const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));

	return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* The inverse of the differences and planes. */
function join(planes, rows, components, size) {
	if (planes.length !== rows * components * size)
		throw new Error("The data of the page are damaged: save it again.");
	const at = library.put(planes), out = library.take(planes.length);

	library.run.column_join(at, rows, components, size, out);
	const { buffer } = library.get(Uint8Array, out, planes.length);
	library.free(at, out);
	return buffer;
}

/* Steps, of either direction: 0, 1, 2, 3, ... stand for 0, -1, 1, -2, ... */
function signed(n) {
	return n >>> 1 ^ -(n & 1);
}

/* The values of a column that was written as sums of such steps (the text `page`): whole numbers modulo 2^32, or, where
 * there is a step, so many steps from the origin; what that is of rows of more than three is for others to know. */
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

/* A column: its shape, and its values when they are asked for. */
export class Column {
	constructor(record) {
		Object.assign(this, record);
	}

	/* rows x components values, not to be written to; kept as long as the browser has room for them. */
	async values() {
		const there = this.kept && this.kept.deref(), values = there || await this.read();

		this.kept = there ? this.kept : new WeakRef(values);
		return values;
	}

	async read() {
		const size = SIZE[this.stored || this.type], Kind = ARRAY[this.stored || this.type];
		const values = new Kind(this.packed ? join(await inflate(this.bytes), this.rows, this.components,
			size) : this.bytes.slice().buffer);

		return this.steps ? fromSums(values, this.components, this.steps) : values;
	}

	/* Says that it is stored as sums of steps, of numbers where step is not 0. */
	setSteps(step, origin) {
		this.stored = "u";
		this.type = step ? "d" : "u";
		this.steps = { step, origin };
	}
}

/* A column that is computed, and found again by what it was computed from. */
export class Made extends Column {
	constructor(layer, name, shape, make) {
		super({ layer, name, ...shape });
		this.read = make;
	}
}
