/* solid.js -- a surface that is drawn in the library's memory: how it is shaded, what a ray meets, discs over it. */
import { library } from "../library/compile.js";

const NONE = 0xffffffff;

export class Solid {
	/* position: of floats, and may change: then it is to be told by move(). */
	constructor(position, triangles) {
		this.at = library.had(library.run.surface_new(position.length / 3, library.put(triangles),
			triangles.length / 3));
		this.position = new Float32Array(3 * triangles.length); /* of corners */
		this.normal = new Float32Array(3 * triangles.length);
		this.move(position);
	}

	/* So many numbers of the k-th array that it has for the page (library/surface.c). */
	read(Type, k, length, out) {
		return library.get(Type, library.get(Uint32Array, this.at, 3)[k], length, out);
	}

	/* Places and normals of what is drawn: each face has three vertices of its own. */
	move(position) {
		const at = library.put(position);

		library.run.surface_move(this.at, at);
		library.free(at);
		library.run.surface_corners(this.at);
		this.read(Float32Array, 1, this.position.length, this.position);
		this.read(Float32Array, 2, this.normal.length, this.normal);
	}

	/* The face that a ray meets first: { face, at }; null: none. */
	hit(from, along) {
		library.had(library.run.surface_ready(this.at)); /* makes what rays ask for, the first time */
		const ray = library.put(Float64Array.from([...from, ...along])),
			face = library.run.surface_hit(this.at, ray) >>> 0;
		const at = Array.from(library.get(Float64Array, ray, 3));

		library.free(ray);
		return face === NONE ? null : { face, at };
	}

	/* The vertices no farther than radius over the surface from a place on a face. */
	disc(face, place, radius) {
		const at = library.put(Float64Array.from(place)),
			n = library.run.surface_disc(this.at, face, at, radius);

		library.free(at);
		return this.read(Uint32Array, 0, n);
	}

	/* The corners that vertices are of faces. */
	corners(vertices) {
		const at = library.put(Uint32Array.from(vertices)),
			n = library.run.surface_corners_of(this.at, at, vertices.length);

		library.free(at);
		return this.read(Uint32Array, 0, n);
	}

	free() {
		library.run.surface_free(this.at);
	}
}
