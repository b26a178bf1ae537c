/* solid.js -- a surface that is drawn in the library's memory: how it is shaded, what a ray meets, discs over it. */
import { library } from "../library/compile.js";

const NONE = 0xffffffff;

export class Solid {
	/* position: of floats, and may change: then it is to be told by move().  Its creases are where they are now. */
	constructor(position, triangles) {
		this.vertices = position.length / 3;
		this.at = library.had(library.run.surface_new(this.vertices, library.put(triangles), triangles.length / 3));
		this.move(position);
		const parted = library.run.surface_part(this.at) >>> 0;
		library.had(parted !== NONE);
		this.index = this.read(Uint32Array, 1, triangles.length);
		this.source = Uint32Array.from({ length: this.vertices + parted }, (_, v) => v);
		this.source.set(this.read(Uint32Array, 2, parted), this.vertices);
		this.position = new Float32Array(3 * this.source.length);
		this.normal = new Float32Array(3 * this.source.length);
		this.shade(position);
	}

	/* So many numbers of the k-th array that it has for the page (library/surface.c). */
	read(Type, k, length, out) {
		return library.get(Type, library.get(Uint32Array, this.at, 4)[k], length, out);
	}

	move(position) {
		const at = library.put(position);

		library.run.surface_move(this.at, at);
		library.free(at);
	}

	/* Places and normals of what is drawn: position, normal, index, and `source`, the vertex that each drawn one stands for. */
	shade(p) {
		const { position, source } = this;

		position.set(p);
		for (let i = p.length; i < position.length; i += 3) {
			const v = 3 * source[i / 3];
			position[i] = p[v];
			position[i + 1] = p[v + 1];
			position[i + 2] = p[v + 2];
		}
		library.run.surface_normals(this.at);
		this.read(Float32Array, 3, position.length, this.normal);
	}

	/* Makes what rays ask for, which takes a moment, where it is not there. */
	prepare() {
		library.had(library.run.surface_ready(this.at));
	}

	/* The face that a ray meets first: { face, at }; null: none. */
	hit(from, along) {
		this.prepare();
		const ray = library.put(Float64Array.from([...from, ...along])), face = library.run.surface_hit(this.at, ray) >>> 0;
		const at = Array.from(library.get(Float64Array, ray, 3));

		library.free(ray);
		return face === NONE ? null : { face, at };
	}

	/* The vertices no farther than radius over the surface from a place on a face. */
	disc(face, place, radius) {
		const at = library.put(Float64Array.from(place)), n = library.run.surface_disc(this.at, face, at, radius);

		library.free(at);
		return this.read(Uint32Array, 0, n);
	}

	free() {
		library.run.surface_free(this.at);
	}
}
