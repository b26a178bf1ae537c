/* decode.js -- a base posed by its response to handles, lib/edit/pose_basis.c, and the detail over it, lib/edit/detail.c. */

/* The same change about another place than the origin. */
export function about(a, [x, y, z]) {
	return a.map((m, i) => (i % 4 === 3 ? m + a[i - 3] * x + a[i - 2] * y + a[i - 1] * z : m));
}

/* The four numbers a vertex that are of one handle. */
function partOf(response, handles, h) {
	const out = new Float32Array(response.length / handles);

	for (let i = 0, k = 4 * h; i < out.length; i += 4, k += 4 * handles)
		for (let c = 0; c < 4; c++)
			out[i + c] = response[k + c];
	return out;
}

/* An area's values, in an array that was given before or a new one: fresh memory takes time. */
function copy(area, out = new area.Type(area.length)) {
	out.set(area.view());
	return out;
}

/* A base at `position`, and its response: 4 numbers a vertex for each of so many handles, to maps about `origin`. */
export class Base {
	constructor(kernel, { position, response, handles, origin }) {
		Object.assign(this, { kernel, response, handles, origin });
		this.vertices = position.length / 3;
		this.rest = kernel.keepVectors(Float64Array, position);
		this.places = kernel.take(Float64Array, 4 * this.vertices);
		this.out = kernel.take(Float32Array, 3 * this.vertices);
		this.columns = kernel.take(Float64Array, 16);
		this.parts = [];
	}

	/* changes: of each handle what its map is more than the identity, or null. */
	pose(changes) {
		const { kernel, rest, places, columns, vertices } = this;
		let from = rest;

		changes.slice(0, this.handles).forEach((change, h) => {
			if (!change)
				return;
			this.parts[h] = this.parts[h] || kernel.keep(Float32Array, partOf(this.response, this.handles, h));
			const a = about(change, this.origin);
			columns.view().set([0, 1, 2, 3].flatMap((c) => [a[c], a[c + 4], a[c + 8], 0]));
			kernel.run.pose(from.at, this.parts[h].at, columns.at, places.at, vertices);
			from = places;
		});
		if (from === rest)
			places.view().set(rest.view());
	}

	/* Three floats a vertex, into `out` where there is such a one. */
	floats(out) {
		this.kernel.run.narrow(this.places.at, this.out.at, this.vertices);
		return copy(this.out, out);
	}
}

/* The detail of a mesh: of each row the corners of the base's face, their weights, the height. */
export class Detail {
	constructor(kernel, { corner, weight, height }) {
		this.kernel = kernel;
		this.rows = height.length;
		this.corner = kernel.keep(Uint32Array, corner);
		this.weight = kernel.keep(Float32Array, weight);
		this.height = kernel.keep(Float32Array, height);
		this.out = kernel.take(Float32Array, 3 * this.rows);
	}

	/*
	 * Where it is on the base, with its normals turned, into `out` where there is such a one.  The face's own normal, where those of its corners cancel, is
	 * left to nobody: there is no height that mr-encode calls sound.
	 */
	floats(places, turned, out) {
		this.kernel.run.decode(places.at, turned.at, this.corner.at, this.weight.at, this.height.at, this.out.at, this.rows);
		return copy(this.out, out);
	}
}
