/* decode.js -- a base posed by its response to handles, lib/edit/pose_basis.c, and the detail over it, lib/edit/detail.c. */

/* Of a handle's change A = T - I: adds A (w0, w1, w2, w3) of each vertex. */
function respond(w, a, p) {
	const [a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11] = a;

	for (let i = 0, k = 0; i < p.length; i += 3, k += 4) {
		const x = w[k], y = w[k + 1], z = w[k + 2], one = w[k + 3];
		p[i] += a0 * x + a1 * y + a2 * z + a3 * one;
		p[i + 1] += a4 * x + a5 * y + a6 * z + a7 * one;
		p[i + 2] += a8 * x + a9 * y + a10 * z + a11 * one;
	}
}

/* The four numbers a vertex that are of one handle. */
function partOf(response, handles, h) {
	const out = new Float64Array(response.length / handles);

	for (let i = 0, k = 4 * h; i < out.length; i += 4, k += 4 * handles)
		for (let c = 0; c < 4; c++)
			out[i + c] = response[k + c];
	return out;
}

/* The same change about another place than the origin. */
function about(a, [x, y, z]) {
	return a.map((m, i) => (i % 4 === 3 ? m + a[i - 3] * x + a[i - 2] * y + a[i - 1] * z : m));
}

/* A base at `rest`, around the page's centre, and its response: 4 numbers a vertex for each of so many handles, to maps about
 * `origin`. */
export class Base {
	constructor(rest, response, handles, origin) {
		this.origin = origin;
		this.rest = rest;
		this.response = response;
		this.handles = handles;
		this.parts = [];
		this.position = rest.slice();
	}

	/* changes: of each handle what its map is more than the identity, or null. */
	pose(changes) {
		this.position.set(this.rest);
		changes.forEach((change, h) => {
			if (change && h < this.handles) {
				this.parts[h] = this.parts[h] || partOf(this.response, this.handles, h);
				respond(this.parts[h], about(change, this.origin), this.position);
			}
		});
	}
}

/* The detail of a mesh: for each vertex the corners of the base's face, times 3, the weights of the first two, the height. */
export class Detail {
	constructor(face, bary, height, triangles) {
		this.corner = new Uint32Array(3 * face.length);
		this.bary = bary;
		this.height = height;
		for (let i = 0; i < face.length; i++)
			for (let k = 0; k < 3; k++)
				this.corner[3 * i + k] = 3 * triangles[3 * face[i] + k];
	}

	/*
	 * b + h n of each vertex as floats; p, normals: of the base, the normals turned.  The face's own normal, where those of
	 * its corners cancel, is left to nobody: there is no height that mr-encode calls sound.
	 */
	decode(p, n, out) {
		const { corner, bary, height } = this;

		for (let i = 0, k = 0, w = 0; i < height.length; i++, k += 3, w += 2) {
			const a = corner[k], b = corner[k + 1], c = corner[k + 2], u = bary[w], v = bary[w + 1], s = 1 - u - v;
			const x = u * n[a] + v * n[b] + s * n[c];
			const y = u * n[a + 1] + v * n[b + 1] + s * n[c + 1];
			const z = u * n[a + 2] + v * n[b + 2] + s * n[c + 2];
			const h = height[i] / (Math.sqrt(x * x + y * y + z * z) || 1);
			out[k] = u * p[a] + v * p[b] + s * p[c] + h * x;
			out[k + 1] = u * p[a + 1] + v * p[b + 1] + s * p[c + 1] + h * y;
			out[k + 2] = u * p[a + 2] + v * p[b + 2] + s * p[c + 2] + h * z;
		}
	}
}
