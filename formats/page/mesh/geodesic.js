/*
 * geodesic.js -- a disc on a surface, by the distance over it: the march over triangles of mr-select's "geodesic"
 * (Kimmel, Sethian 1998, with the update of Novotni and Klein 2002), that goes no farther than the disc.
 */
import { facesAt } from "./topology.js";

const STEP = 1e-4; /* of the way: less nearer does not pay, it would run on through all that lies behind */

/* A heap of vertices, the nearest first. */
class Queue {
	constructor() {
		this.key = [];
		this.vertex = [];
	}

	push(key, vertex) {
		let i = this.key.length;

		while (i > 0 && key < this.key[(i - 1) >> 1]) {
			this.key[i] = this.key[(i - 1) >> 1];
			this.vertex[i] = this.vertex[(i - 1) >> 1];
			i = (i - 1) >> 1;
		}
		this.key[i] = key;
		this.vertex[i] = vertex;
	}

	/* Takes the first away; the caller has read it. */
	pop() {
		const key = this.key.pop(), vertex = this.vertex.pop(), n = this.key.length;
		let i = 0;

		if (n === 0)
			return;
		for (let child = 1; child < n; child = 2 * i + 1) {
			if (child + 1 < n && this.key[child + 1] < this.key[child])
				child++;
			if (!(this.key[child] < key))
				break;
			this.key[i] = this.key[child];
			this.vertex[i] = this.vertex[child];
			i = child;
		}
		this.key[i] = key;
		this.vertex[i] = vertex;
	}
}

/* The distance of a corner behind an edge of length ab, whose ends a and b are da and db away; ac, bc: from them. */
function behindEdge(ab, ac, bc, da, db) {
	const along = Math.min(da + ac, db + bc);

	if (!(ab > 0) || da === Infinity || db === Infinity)
		return along;
	/* a at (0, 0), b at (ab, 0), the corner above the edge, the source below it */
	const sx = (da * da - db * db + ab * ab) / (2 * ab), cx = (ac * ac - bc * bc + ab * ab) / (2 * ab);
	if (da * da < sx * sx)
		return along;
	const sy = Math.sqrt(da * da - sx * sx), cy = Math.sqrt(Math.max(ac * ac - cx * cx, 0));
	const x = sy + cy > 0 ? sx + (cx - sx) * sy / (sy + cy) : cx;
	return x >= 0 && x <= ab ? Math.sqrt((cx - sx) ** 2 + (cy + sy) ** 2) : along;
}

export class Discs {
	/* On the surface p, t; p may move between discs. */
	constructor(p, t) {
		this.p = p;
		this.t = t;
		this.at = facesAt(t, p.length / 3);
		this.distance = new Float64Array(p.length / 3).fill(Infinity);
	}

	/* The distance of vertex i in space from vertex j. */
	apart(i, j) {
		const p = this.p;

		return Math.sqrt((p[3 * i] - p[3 * j]) ** 2 + (p[3 * i + 1] - p[3 * j + 1]) ** 2 + (p[3 * i + 2] - p[3 * j + 2]) ** 2);
	}

	/* Gives v the distance d if that is nearer by more than a step of the way it came over. */
	relax(v, d, way) {
		const p = this.p, [x, y, z] = this.source;
		const straight = Math.sqrt((p[3 * v] - x) ** 2 + (p[3 * v + 1] - y) ** 2 + (p[3 * v + 2] - z) ** 2);
		const nearer = Math.max(d, straight); /* corners that are not settled yet can put the source too near */

		if (!(nearer < this.distance[v] - STEP * way))
			return;
		if (this.distance[v] === Infinity)
			this.touched.push(v);
		this.distance[v] = nearer;
		if (nearer <= this.radius)
			this.queue.push(nearer, v);
	}

	/* Looks from v and one more corner of the face at the third, both ways. */
	relaxFace(v, k) {
		const t = this.t, d = this.distance;

		for (let i = 0; i < 3; i++) {
			const a = t[k + i], b = t[k + (i + 1) % 3], third = t[k + (i + 2) % 3];
			if (third === v)
				continue;
			const ac = this.apart(a, third), bc = this.apart(b, third);
			this.relax(third, behindEdge(this.apart(a, b), ac, bc, d[a], d[b]), Math.min(ac, bc));
		}
	}

	/* The vertices no farther than radius over the surface from a place on a face. */
	around(face, place, radius) {
		this.source = place;
		this.radius = radius;
		this.touched = [];
		this.queue = new Queue();
		for (let i = 0; i < 3; i++)
			this.relax(this.t[3 * face + i], 0, 0);
		while (this.queue.key.length > 0) {
			const d = this.queue.key[0], v = this.queue.vertex[0];
			this.queue.pop();
			if (d > this.distance[v])
				continue;
			for (let i = this.at.start[v]; i < this.at.start[v + 1]; i++)
				this.relaxFace(v, 3 * this.at.face[i]);
		}
		const out = this.touched.filter((v) => this.distance[v] <= radius);
		for (const v of this.touched)
			this.distance[v] = Infinity;
		return out;
	}
}

/* Of points: those in the ball. */
export function ball(p, place, radius) {
	const out = [];

	for (let i = 0; i < p.length; i += 3)
		if ((p[i] - place[0]) ** 2 + (p[i + 1] - place[1]) ** 2 + (p[i + 2] - place[2]) ** 2 <= radius * radius)
			out.push(i / 3);
	return out;
}
