/*
 * mrz.js -- packed surfaces (man/mr-compact.5) in a page or in node, by mrz.wasm beside it:
 *
 *	import { Mrz } from "./mrz.js";
 *	const mrz = await Mrz.load();                                  // once; or Mrz.load(bytes of mrz.wasm)
 *	const surface = mrz.open(new Uint8Array(await (await fetch("scan.mrz")).arrayBuffer()));
 *	const { positions, normals, colors, triangles } = surface.mesh(surface.levels);
 *	surface.close();
 *
 * The first bytes of a file will do, if they hold the control mesh: surface.missing says how many are not there yet.
 * Level 0 has the vertices of the control mesh, surface.levels is the finest.  positions and normals are three doubles
 * a vertex, colors four bytes or null, triangles three indices a face.  What is wrong is an Error with a sentence.
 */
class Surface {
	constructor(run, at, bytes) {
		Object.assign(this, { run, at, bytes });
	}

	get levels() {
		return this.run.surface_levels(this.at);
	}

	get missing() {
		return this.run.surface_missing(this.at);
	}

	mesh(level = this.levels) {
		if (!(Number.isInteger(level) && level >= 0 && level <= this.levels))
			throw new Error(`there is no level ${level}: the finest is ${this.levels}`);
		const { run, at } = this;
		const positions = run.surface_positions(at, level), n = run.surface_vertices(at, level);
		const copy = (Type, from, length) => new Type(run.memory.buffer, from >>> 0, length).slice();
		const colors = run.surface_colors(at);
		const triangles = run.surface_triangles(at, level);
		return {
			positions: copy(Float64Array, positions, 3 * n),
			normals: copy(Float64Array, run.surface_normals(at), 3 * n),
			colors: colors ? copy(Uint8Array, colors, 4 * n) : null,
			triangles: copy(Uint32Array, triangles, 3 * run.surface_faces(at, level)),
		};
	}

	close() {
		this.run.surface_close(this.at, this.bytes);
	}
}

export class Mrz {
	constructor(run) {
		this.run = run;
	}

	static async load(code) {
		const place = new URL("mrz.wasm", import.meta.url);
		const bytes = code ?? (await (await fetch(place)).arrayBuffer());
		return new Mrz((await WebAssembly.instantiate(bytes)).instance.exports);
	}

	/* Opens a file, or its first bytes. */
	open(file) {
		const { run } = this, bytes = run.malloc(Math.max(file.length, 1));
		if (!bytes)
			throw new Error("there is not enough memory for this surface");
		new Uint8Array(run.memory.buffer, bytes >>> 0, file.length).set(file);
		const at = run.surface_open(bytes, file.length);
		if (!at)
			throw new Error("there is not enough memory for this surface");
		const surface = new Surface(run, at, bytes), error = run.surface_error(at);
		if (!error)
			return surface;
		const text = new Uint8Array(run.memory.buffer, error >>> 0);
		const sentence = new TextDecoder().decode(text.slice(0, text.indexOf(0)));
		surface.close();
		throw new Error(sentence);
	}
}
