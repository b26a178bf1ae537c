/*
 * turns.js -- how a surface has turned around each of its vertices: lib/edit/turns.c, the rotations of Sorkine and Alexa
 * 2007 of faces with their normals, smoothed.  Each is found from the one before, by Newton's method, in kernel.c.
 */
import { apply, matrixOf, nearestQuaternion } from "../mesh/rotation.js";
import { neighboursOf } from "../mesh/neighbours.js";

const PASSES = 2;
const MATRIX = 12; /* floats of one: three columns of four */

/*
 * What a face at rest gives to the sum of y x^T of its edges and normals: 9 numbers, its sides at unit mean length; of the
 * sides y1, y2 and the normal of the face now: y1 (2 x1 + x2)^T + y2 (x1 + 2 x2)^T + 6 n (x1 x x2)^T.
 */
function facesAtRest(p, t) {
	const out = new Float64Array(3 * t.length);

	for (let k = 0, o = 0; k < t.length; k += 3, o += 9) {
		const a = 3 * t[k], b = 3 * t[k + 1], c = 3 * t[k + 2];
		const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
		const vx = p[c] - p[b], vy = p[c + 1] - p[b + 1], vz = p[c + 2] - p[b + 2];
		const wx = p[a] - p[c], wy = p[a + 1] - p[c + 1], wz = p[a + 2] - p[c + 2];
		const all = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz;
		if (!(all > 0))
			continue;
		const f = 2 / all, g = 12 / (all * all);
		out.set([
			f * (2 * ux + vx), f * (2 * uy + vy), f * (2 * uz + vz), f * (2 * vx + ux), f * (2 * vy + uy), f * (2 * vz + uz),
			g * (uy * vz - uz * vy), g * (uz * vx - ux * vz), g * (ux * vy - uy * vx),
		], o);
	}
	return out;
}

/* The rows of the v-th matrix. */
function matrixAt(sums, v) {
	const [a, b, c] = [0, 4, 8].map((column) => sums.subarray(MATRIX * v + column, MATRIX * v + column + 3));

	return [0, 1, 2].flatMap((row) => [a[row], b[row], c[row]]);
}

/* The field of turns of a surface that is at rest at p with these normals. */
export class Turns {
	constructor(kernel, p, t, normals) {
		const vertices = p.length / 3, n = Math.ceil(vertices / 4) * 4, around = neighboursOf(vertices, t);

		Object.assign(this, { kernel, vertices, n, faces: t.length / 3 });
		this.triangles = kernel.keep(Uint32Array, t);
		this.rest = kernel.keep(Float32Array, facesAtRest(p, t));
		this.around = [kernel.keep(Uint32Array, around.first), kernel.keep(Uint32Array, around.other), kernel.keep(Float32Array, around.weight)];
		this.normals = kernel.keepVectors(Float32Array, normals, n);
		[this.sums, this.other] = [0, 1].map(() => kernel.take(Float32Array, MATRIX * n));
		this.turned = kernel.take(Float32Array, 4 * n);
		this.lost = kernel.take(Uint32Array, n);
		this.q = kernel.take(Float32Array, 4 * n); /* fours of unit quaternions: their first numbers, their second, ... */
		this.q.view().forEach((_, i, q) => {
			q[i] = i % 16 < 4 ? 1 : 0;
		});
	}

	/* Finds them, and the normals as they are turned, for the surface at these places. */
	find(places) {
		const { kernel: { run }, n, sums, other, q } = this;

		sums.view().fill(0);
		run.add_faces(places.at, this.triangles.at, this.rest.at, sums.at, this.faces);
		let [from, to] = [sums, other];
		for (let i = 0; i < PASSES; i++, [from, to] = [to, from])
			run.smooth(from.at, ...this.around.map((area) => area.at), to.at, this.vertices);
		const lost = run.turn(from.at, q.at, this.normals.at, this.turned.at, this.lost.at, n);
		this.lost.view().subarray(0, lost).forEach((v) => v < this.vertices && this.turn(v, matrixAt(from.view(), v)));
	}

	/* What Newton's method has not found. */
	turn(v, sum) {
		const q = nearestQuaternion(sum), rotation = matrixOf(q), all = this.q.view();
		const turned = apply([0, 3, 6].flatMap((i) => [...rotation.slice(i, i + 3), 0]), this.normals.view().subarray(4 * v, 4 * v + 3));

		q.forEach((x, i) => {
			all[4 * (v - v % 4) + 4 * i + v % 4] = x;
		});
		this.turned.view().set(turned, 4 * v);
	}

	quaternion(v) {
		const q = this.q.view();

		return [0, 4, 8, 12].map((i) => q[4 * (v - v % 4) + i + v % 4]);
	}

	/* The rotation nearest to the mean of those of three vertices, by these weights. */
	mean(corners, weights) {
		const sum = new Array(9).fill(0);

		for (let k = 0; k < 3; k++)
			matrixOf(this.quaternion(corners[k])).forEach((x, i) => {
				sum[i] += weights[k] * x;
			});
		return matrixOf(nearestQuaternion(sum));
	}
}
