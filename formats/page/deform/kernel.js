/*
 * kernel.js -- kernel.c, compiled, and its memory: an area of it is a place and its length, and is read and written by a view,
 * which is good until another area is taken.
 */
import code from "kernel.wasm";

const PAGE = 65536, ALIGNED = 64;

class Area {
	constructor(memory, at, Type, length) {
		Object.assign(this, { memory, at, Type, length });
	}

	view() {
		return new this.Type(this.memory.buffer, this.at, this.length);
	}
}

export class Kernel {
	constructor() {
		this.run = new WebAssembly.Instance(new WebAssembly.Module(code)).exports;
		this.top = this.run.__heap_base.value;
	}

	/* An area of so many numbers, all 0. */
	take(Type, length) {
		const { memory } = this.run, at = Math.ceil(this.top / ALIGNED) * ALIGNED;

		this.top = at + Type.BYTES_PER_ELEMENT * length;
		if (this.top > memory.buffer.byteLength)
			memory.grow(Math.ceil((this.top - memory.buffer.byteLength) / PAGE));
		return new Area(memory, at, Type, length);
	}

	/* An area that holds these. */
	keep(Type, values) {
		const area = this.take(Type, values.length);

		area.view().set(values);
		return area;
	}

	/* Vectors of three as vectors of four, and zeros after them up to so many. */
	keepVectors(Type, values, count = values.length / 3) {
		const area = this.take(Type, 4 * count), out = area.view();

		for (let i = 0, k = 0; i < values.length; i += 3, k += 4)
			for (let c = 0; c < 3; c++)
				out[k + c] = values[i + c];
		return area;
	}
}
