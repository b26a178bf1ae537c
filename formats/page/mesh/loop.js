/*
 * loop.js -- Loop's subdivision surfaces as lib/subdivide/loop.c has them: connectivity level by level, and values of
 * vertices on the next level.  Vertices keep their numbers on all finer levels.
 */
export const NONE = 0xffffffff;

const beforeOf = (h) => (h % 3 === 0 ? h + 2 : h - 1);
const afterOf = (h) => (h % 3 === 2 ? h - 2 : h + 1);

/* The half-edges of an oriented manifold: of each the one on the other side, or NONE; of each vertex one that leaves it, on a
 * boundary the first one counter-clockwise. */
function halfEdges(nv, t) {
	const twin = new Uint32Array(t.length).fill(NONE), out = new Uint32Array(nv).fill(NONE), met = new Map();

	for (let h = 0; h < t.length; h++) {
		const a = t[h], b = t[afterOf(h)], there = met.get(b * nv + a);
		if (there === undefined)
			met.set(a * nv + b, h);
		else {
			twin[h] = there;
			twin[there] = h;
		}
	}
	for (let h = 0; h < t.length; h++)
		if (out[t[h]] === NONE || twin[h] === NONE)
			out[t[h]] = h;
	return { twin, out };
}

/* Both sides of the edges that are marked on either; null: there is none. */
function creasesOf(twin, marked) {
	const crease = new Uint8Array(twin.length);

	for (let h = 0; h < twin.length; h++)
		if (twin[h] !== NONE && (marked[h] || marked[twin[h]]))
			crease[h] = 1;
	return crease.includes(1) ? crease : null;
}

/* Level 0; marked: 3 a face, 0 where an edge is smooth, or null. */
export function controlOf(nv, t, marked) {
	const { twin, out } = halfEdges(nv, t);

	return { nv, t, twin, out, crease: marked && creasesOf(twin, marked), edge: null };
}

/* The half-edges that half-edge h is cut into. */
function firstHalf(h) {
	return 4 * h;
}

function secondHalf(h) {
	return 12 * Math.floor(h / 3) + [3, 7, 2][h % 3];
}

/* The half-edges by which edges are counted: the lower ones. */
function edgesOf(twin) {
	const edge = new Uint32Array(twin.length);
	let n = 0;

	for (let h = 0; h < twin.length; h++)
		if (twin[h] > h) /* NONE too */
			edge[n++] = h;
	return edge.slice(0, n);
}

/* Each edge's new vertex, on the face in the middle of those on both its sides. */
function placeOdd(l, edge, fine) {
	edge.forEach((h, i) => {
		const g = l.twin[h];
		fine.t[12 * Math.floor(h / 3) + 9 + h % 3] = l.nv + i;
		if (g !== NONE)
			fine.t[12 * Math.floor(g / 3) + 9 + g % 3] = l.nv + i;
		fine.out[l.nv + i] = secondHalf(h);
	});
}

/* Face (a, b, c) with the new ab, bc, ca becomes (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca). */
function cutFaces(l, { t, twin, crease }) {
	const inner = [1, 5, 6], middle = [11, 9, 10];

	for (let k = 0; k < l.t.length; k += 3) {
		const h = 4 * k, ab = t[h + 9], bc = t[h + 10], ca = t[h + 11];
		t.set([l.t[k], ab, ca, ab, l.t[k + 1], bc, ca, bc, l.t[k + 2]], h);
		for (let i = 0; i < 3; i++) {
			const g = l.twin[k + i], a = firstHalf(k + i), b = secondHalf(k + i);
			twin[a] = g === NONE ? NONE : secondHalf(g);
			twin[b] = g === NONE ? NONE : firstHalf(g);
			twin[h + inner[i]] = h + middle[i];
			twin[h + middle[i]] = h + inner[i];
			if (crease)
				crease[a] = crease[b] = l.crease[k + i];
		}
	}
}

/* The next level. */
export function refine(l) {
	const edge = edgesOf(l.twin), n = 4 * l.t.length, nv = l.nv + edge.length;
	const fine = { nv, t: new Uint32Array(n), twin: new Uint32Array(n), out: new Uint32Array(nv), crease: l.crease && new Uint8Array(n), edge };

	placeOdd(l, edge, fine);
	cutFaces(l, fine);
	for (let v = 0; v < l.nv; v++)
		fine.out[v] = l.out[v] === NONE ? NONE : firstHalf(l.out[v]);
	return fine;
}

export const SMOOTH = 0, DART = 1, CREASE = 2, CORNER = 3;

/* The neighbours of a vertex, counter-clockwise, on a boundary from its first to its last: of each `to` and whether the edge is
 * `sharp`, a boundary or a crease; n of them; shape: by the number of those that are sharp. */
export class Ring {
	constructor(level) {
		this.level = level;
		this.to = [];
		this.sharp = [];
	}

	put(v, h) {
		const { twin, crease } = this.level, is = twin[h] === NONE || (crease !== null && crease[h] === 1);

		this.to[this.n] = v;
		this.sharp[this.n++] = is;
		this.shape += is ? 1 : 0;
	}

	read(v) {
		const { t, twin, out } = this.level, start = out[v];
		let h = start;

		this.n = this.shape = 0;
		this.open = false;
		if (start === NONE)
			return;
		this.put(t[afterOf(h)], h);
		do {
			const before = beforeOf(h);
			h = twin[before];
			this.open = h === NONE;
			if (h !== start)
				this.put(t[before], before);
		} while (h !== start && h !== NONE);
		this.shape = Math.min(this.shape, CORNER);
	}

	/* Which neighbour is the first across a sharp edge. */
	firstSharp() {
		return this.sharp.indexOf(true);
	}
}

export function betaOf(n) {
	const x = 0.375 + 0.25 * Math.cos(2 * Math.PI / n);

	return n === 6 ? 0.0625 : (0.625 - x * x) / n;
}

/* Weights of the vertex, of its neighbours, of those across sharp edges, where it goes. */
function evenMask({ shape, n }) {
	const beta = n && shape < CREASE ? betaOf(n) : 0;

	if (n === 0 || shape === CORNER)
		return [1, 0, 0];
	return shape === CREASE ? [0.75, 0, 0.125] : [1 - n * beta, beta, beta];
}

/* Adds the neighbours to the row of v, whose mask it is. */
export function sumRing(ring, [self, smooth, sharp], width, v, values, out) {
	for (let c = 0; c < width; c++)
		out[width * v + c] = self * values[width * v + c];
	for (let i = 0; i < ring.n && self !== 1; i++) {
		const w = ring.sharp[i] ? sharp : smooth, from = width * ring.to[i];
		for (let c = 0; c < width && w !== 0; c++)
			out[width * v + c] += w * values[from + c];
	}
}

/* Of the vertices on the edges of l, those of `fine` that are new: what lies between, behind the rows of l. */
export function predict(l, fine, width, values, out) {
	fine.edge.forEach((h, i) => {
		const g = l.twin[h], at = width * (l.nv + i), a = width * l.t[h], b = width * l.t[afterOf(h)];
		const sharp = g === NONE || (l.crease && l.crease[h]), c = width * l.t[beforeOf(h)], d = sharp ? 0 : width * l.t[beforeOf(g)];
		for (let k = 0; k < width; k++)
			out[at + k] = sharp ? 0.5 * (values[a + k] + values[b + k])
				: 0.375 * (values[a + k] + values[b + k]) + 0.125 * (values[c + k] + values[d + k]);
	});
}

/* Values on the next level: `width` a vertex. */
export function subdivide(l, fine, width, values) {
	const out = new Float64Array(width * fine.nv), ring = new Ring(l);

	for (let v = 0; v < l.nv; v++) {
		ring.read(v);
		sumRing(ring, evenMask(ring), width, v, values, out);
	}
	predict(l, fine, width, values, out);
	return out;
}
