/* library.js -- the library as WebAssembly, and arrays in its memory: they are at a number there, and move out of it as
 * copies, for what is in it moves when it grows. */
export class Library {
	constructor(run) {
		this.run = run;
	}

	/* What it answered, unless that is 0: then there was no memory. */
	had(answer) {
		if (!answer)
			throw new Error("There is not enough memory for this model.");
		return answer;
	}

	/* Room for so many bytes. */
	take(bytes) {
		return this.had(this.run.malloc(Math.max(bytes, 1))) >>> 0; /* not below 0 from 2 GB on */
	}

	/* An array put there; of none 0. */
	put(values) {
		return values ? this.set(this.take(values.byteLength), values) : 0;
	}

	set(at, values) {
		new values.constructor(this.run.memory.buffer, at, values.length).set(values);
		return at;
	}

	free(...places) {
		places.forEach((at) => this.run.free(at));
	}

	/* So many numbers from there, into `out` where there is such a one. */
	get(Type, at, length, out = new Type(length)) {
		out.set(new Type(this.run.memory.buffer, at >>> 0, length));
		return out;
	}
}
