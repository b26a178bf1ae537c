/* solid.js -- a surface that is drawn in the library's memory: what a ray meets, what the eye sees, discs over it, folds. */
import { library } from "../library/compile.js";

const NONE = 0xffffffff;

export class Solid {
	/* position: of floats, and may change: then it is to be told by move(). */
	constructor(position, triangles) {
		this.position = position;
		this.at = library.had(library.run.surface_new(position.length / 3, library.put(triangles), triangles.length / 3));
		this.move();
	}

	move() {
		const at = library.put(this.position);

		library.run.surface_move(this.at, at);
		library.free(at);
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

	/* Those of these vertices before which there is no face, from `near` before the eye on. */
	seen(eye, near, vertices) {
		this.prepare();
		const from = library.put(Float64Array.from(eye)), list = library.put(Uint32Array.from(vertices));
		const seen = library.get(Uint32Array, list, library.run.surface_seen(this.at, from, near, list, vertices.length));

		library.free(from, list);
		return seen;
	}

	/* The vertices no farther than radius over the surface from a place on a face. */
	disc(face, place, radius) {
		const at = library.put(Float64Array.from(place)), n = library.run.surface_disc(this.at, face, at, radius);

		library.free(at);
		return library.get(Uint32Array, library.run.surface_found(this.at), n);
	}

	/* The two ends of each folded edge: between faces whose normals are more than 170 degrees apart. */
	folds() {
		const n = library.run.surface_folds(this.at);

		return library.get(Uint32Array, library.run.surface_found(this.at), 2 * n);
	}

	free() {
		library.run.surface_free(this.at);
	}
}
