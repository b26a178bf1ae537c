/*
 * turns.js -- how a surface has turned around each of its vertices: lib/edit/turns.c, the rotations of Sorkine and Alexa
 * 2007 of faces with their normals, smoothed.  Each is found from the one before, by Newton's method.
 */
import { matrixOf, nearestQuaternion } from "../mesh/rotation.js";
import { neighboursOf } from "../mesh/neighbours.js";

const PASSES = 2;
const NEAR = 1e-12; /* square of the last step, in radians: the next would be its square */
const STEPS = 12;

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

/* Adds the sums of the faces, now at p, to those of their vertices. */
function addFaces(p, t, rest, sums) {
	sums.fill(0);
	for (let k = 0, o = 0; k < t.length; k += 3, o += 9) {
		const a = 3 * t[k], b = 3 * t[k + 1], c = 3 * t[k + 2];
		const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
		const vx = p[c] - p[b], vy = p[c + 1] - p[b + 1], vz = p[c + 2] - p[b + 2];
		const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
		const x0 = rest[o], x1 = rest[o + 1], x2 = rest[o + 2];
		const y0 = rest[o + 3], y1 = rest[o + 4], y2 = rest[o + 5];
		const z0 = rest[o + 6], z1 = rest[o + 7], z2 = rest[o + 8];
		const s0 = ux * x0 + vx * y0 + nx * z0, s1 = ux * x1 + vx * y1 + nx * z1, s2 = ux * x2 + vx * y2 + nx * z2;
		const s3 = uy * x0 + vy * y0 + ny * z0, s4 = uy * x1 + vy * y1 + ny * z1, s5 = uy * x2 + vy * y2 + ny * z2;
		const s6 = uz * x0 + vz * y0 + nz * z0, s7 = uz * x1 + vz * y1 + nz * z1, s8 = uz * x2 + vz * y2 + nz * z2;
		for (let i = k; i < k + 3; i++) {
			const v = 9 * t[i];
			sums[v] += s0;
			sums[v + 1] += s1;
			sums[v + 2] += s2;
			sums[v + 3] += s3;
			sums[v + 4] += s4;
			sums[v + 5] += s5;
			sums[v + 6] += s6;
			sums[v + 7] += s7;
			sums[v + 8] += s8;
		}
	}
}

/* Of each vertex the sums of the faces around it, which are those of their corners. */
function smooth(around, sums, out) {
	const { first, other, weight } = around;

	for (let v = 0, o = 0; o < sums.length; v++, o += 9) {
		let s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0, s8 = 0;
		for (let j = first[v]; j < first[v + 1]; j++) {
			const u = 9 * other[j], w = weight[j];
			s0 += w * sums[u];
			s1 += w * sums[u + 1];
			s2 += w * sums[u + 2];
			s3 += w * sums[u + 3];
			s4 += w * sums[u + 4];
			s5 += w * sums[u + 5];
			s6 += w * sums[u + 6];
			s7 += w * sums[u + 7];
			s8 += w * sums[u + 8];
		}
		out[o] = s0;
		out[o + 1] = s1;
		out[o + 2] = s2;
		out[o + 3] = s3;
		out[o + 4] = s4;
		out[o + 5] = s5;
		out[o + 6] = s6;
		out[o + 7] = s7;
		out[o + 8] = s8;
	}
}

/*
 * One step from the rotation q (at 4 v) towards that which is nearest to the sum s (at 9 v): with K = R^T S the turn w of
 * (tr K - K) w = what K has of no symmetry, twice.  Returns |w|^2; NaN where the matrix is not definite: q is left alone.
 */
function step(q, a, s, o) {
	const w = q[a], x = q[a + 1], y = q[a + 2], z = q[a + 3];
	const r0 = 1 - 2 * (y * y + z * z), r1 = 2 * (x * y - w * z), r2 = 2 * (x * z + w * y);
	const r3 = 2 * (x * y + w * z), r4 = 1 - 2 * (x * x + z * z), r5 = 2 * (y * z - w * x);
	const r6 = 2 * (x * z - w * y), r7 = 2 * (y * z + w * x), r8 = 1 - 2 * (x * x + y * y);
	const s0 = s[o], s1 = s[o + 1], s2 = s[o + 2], s3 = s[o + 3], s4 = s[o + 4], s5 = s[o + 5];
	const s6 = s[o + 6], s7 = s[o + 7], s8 = s[o + 8];
	const k0 = r0 * s0 + r3 * s3 + r6 * s6, k1 = r0 * s1 + r3 * s4 + r6 * s7, k2 = r0 * s2 + r3 * s5 + r6 * s8;
	const k3 = r1 * s0 + r4 * s3 + r7 * s6, k4 = r1 * s1 + r4 * s4 + r7 * s7, k5 = r1 * s2 + r4 * s5 + r7 * s8;
	const k6 = r2 * s0 + r5 * s3 + r8 * s6, k7 = r2 * s1 + r5 * s4 + r8 * s7, k8 = r2 * s2 + r5 * s5 + r8 * s8;
	const a0 = k4 + k8, a4 = k0 + k8, a8 = k0 + k4, a1 = -(k1 + k3) / 2, a2 = -(k2 + k6) / 2, a5 = -(k5 + k7) / 2;
	const b0 = k7 - k5, b1 = k2 - k6, b2 = k3 - k1;
	const c0 = a4 * a8 - a5 * a5, c1 = a2 * a5 - a1 * a8, c2 = a1 * a5 - a2 * a4;
	const det = a0 * c0 + a1 * c1 + a2 * c2;
	const c4 = a0 * a8 - a2 * a2, c5 = a1 * a2 - a0 * a5, c8 = a0 * a4 - a1 * a1, f = 0.5 / det;
	if (!(det > 0 && c8 > 0 && a0 > 0))
		return NaN;
	const u0 = f * (c0 * b0 + c1 * b1 + c2 * b2), u1 = f * (c1 * b0 + c4 * b1 + c5 * b2), u2 = f * (c2 * b0 + c5 * b1 + c8 * b2);
	const n0 = w - x * u0 - y * u1 - z * u2, n1 = x + w * u0 + y * u2 - z * u1;
	const n2 = y + w * u1 + z * u0 - x * u2, n3 = z + w * u2 + x * u1 - y * u0;
	const g = 1 / Math.sqrt(n0 * n0 + n1 * n1 + n2 * n2 + n3 * n3);
	q[a] = g * n0;
	q[a + 1] = g * n1;
	q[a + 2] = g * n2;
	q[a + 3] = g * n3;
	return 4 * (u0 * u0 + u1 * u1 + u2 * u2);
}

/* The rotation nearest to the sum at 9 v, from the one that was; without its help where that leads nowhere. */
function turnOf(q, v, s) {
	let moved = 1;

	for (let i = 0; i < STEPS && moved > NEAR; i++)
		moved = step(q, 4 * v, s, 9 * v);
	if (!(moved <= NEAR))
		q.set(nearestQuaternion(Array.from(s.subarray(9 * v, 9 * v + 9))), 4 * v);
}

/* The field of turns of a surface that is at rest at p; q: a unit quaternion a vertex. */
export class Turns {
	constructor(p, t) {
		this.triangles = t;
		this.rest = facesAtRest(p, t);
		this.around = neighboursOf(p.length / 3, t);
		this.sums = new Float64Array(3 * p.length);
		this.other = new Float64Array(3 * p.length);
		this.q = new Float64Array(p.length / 3 * 4);
		for (let i = 0; i < this.q.length; i += 4)
			this.q[i] = 1;
	}

	/* Finds them for the surface now at p. */
	find(p) {
		addFaces(p, this.triangles, this.rest, this.sums);
		for (let i = 0; i < PASSES; i++) {
			smooth(this.around, this.sums, this.other);
			[this.sums, this.other] = [this.other, this.sums];
		}
		for (let v = 0; v < this.q.length / 4; v++)
			turnOf(this.q, v, this.sums);
	}

	/* Of a vector a vertex, each turned. */
	apply(vectors, out) {
		const q = this.q;

		for (let i = 0, a = 0; i < vectors.length; i += 3, a += 4) {
			const w = q[a], x = q[a + 1], y = q[a + 2], z = q[a + 3];
			const v0 = vectors[i], v1 = vectors[i + 1], v2 = vectors[i + 2];
			const t0 = 2 * (y * v2 - z * v1), t1 = 2 * (z * v0 - x * v2), t2 = 2 * (x * v1 - y * v0);
			out[i] = v0 + w * t0 + y * t2 - z * t1;
			out[i + 1] = v1 + w * t1 + z * t0 - x * t2;
			out[i + 2] = v2 + w * t2 + x * t1 - y * t0;
		}
	}

	/* The rotation nearest to the mean of those of three vertices, by these weights. */
	mean(corners, weights) {
		const sum = new Array(9).fill(0);

		for (let k = 0; k < 3; k++)
			matrixOf(this.q.subarray(4 * corners[k], 4 * corners[k] + 4)).forEach((x, i) => {
				sum[i] += weights[k] * x;
			});
		return matrixOf(nearestQuaternion(sum));
	}
}
