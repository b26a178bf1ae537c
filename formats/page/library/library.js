/*
 * library.js -- the library as WebAssembly, and arrays in its memory: they are at a number there, and move out of it as copies,
 * for what is in it moves when it grows.
 */
import code from "library.wasm";

let compiled;

/* Compiled once; a worker is given what is. */
export function compile() {
	compiled = compiled || WebAssembly.compile(code);
	return compiled;
}

export class Library {
	constructor(run) {
		this.run = run;
	}

	static async load(module = compile()) {
		return new Library((await WebAssembly.instantiate(await module)).exports);
	}

	/* What it answered, unless that is 0: then there was no memory. */
	had(answer) {
		if (!answer)
			throw new Error("There is not enough memory for this model.");
		return answer;
	}

	/* Room for so many bytes. */
	take(bytes) {
		return this.had(this.run.malloc(Math.max(bytes, 1)));
	}

	/* An array put there; of none 0. */
	put(values) {
		if (!values)
			return 0;
		const at = this.take(values.byteLength);

		new values.constructor(this.run.memory.buffer, at, values.length).set(values);
		return at;
	}

	free(...places) {
		places.forEach((at) => this.run.free(at));
	}

	/* So many numbers from there, into `out` where there is such a one. */
	get(Type, at, length, out = new Type(length)) {
		out.set(new Type(this.run.memory.buffer, at, length));
		return out;
	}
}
