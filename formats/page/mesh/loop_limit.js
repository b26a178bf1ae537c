/*
 * loop_limit.js -- limit points and normals of Loop's surfaces as lib/subdivide/loop_limit.c has them, from the eigenvectors of
 * the subdivision matrix around a vertex.
 */
import { betaOf, CORNER, CREASE, DART, Ring, sumRing } from "./loop.js";

const ZERO = [0, 0, 0];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const more = (f, a, b) => [f * a[0] + b[0], f * a[1] + b[1], f * a[2] + b[2]];

function unit(a) {
	const n = norm(a);

	return n > 0 ? [a[0] / n, a[1] / n, a[2] / n] : ZERO;
}

/* The unit normal of two tangents; zero where they are parallel, but for rounding. */
function normalOf(a, b) {
	const n = cross(a, b);

	return norm(n) > 1e-12 * norm(a) * norm(b) ? unit(n) : ZERO;
}

function limitMask({ shape, n }) {
	const chi = n && shape < CREASE ? 1 / (n + 0.375 / betaOf(n)) : 0;

	if (n === 0 || shape === CORNER)
		return [1, 0, 0];
	return shape === CREASE ? [2 / 3, 0, 1 / 6] : [1 - n * chi, chi, chi];
}

/* The weight of neighbour j of a dart's n, whose crease ends in neighbour 0; the vertex itself has 1. */
function dartWeight(n, j) {
	const mu = Math.log((5 + Math.sqrt(21)) / 2), beta = betaOf(n);

	if (j === 0)
		return 2 * beta + 0.5 * dartWeight(n, 1);
	return 8 * beta / 3 * (1 - (Math.exp(-mu * j) + Math.exp(-mu * (n - j))) / (1 + Math.exp(-mu * n)));
}

const placeOf = (p, v) => [p[3 * v], p[3 * v + 1], p[3 * v + 2]];

function dartPoint(ring, p, v) {
	const first = ring.firstSharp();
	let sum = placeOf(p, v), total = 1;

	for (let j = 0; j < ring.n; j++) {
		const w = dartWeight(ring.n, j);
		sum = more(w, placeOf(p, ring.to[(first + j) % ring.n]), sum);
		total += w;
	}
	return sum.map((x) => x / total);
}

/* Neighbour i, from around once again, as seen from the vertex. */
function spoke(ring, p, v, i) {
	return more(-1, placeOf(p, v), placeOf(p, ring.to[i % ring.n]));
}

function smoothNormal(ring, p, v) {
	let a = ZERO, b = ZERO;

	for (let i = 0; i < ring.n; i++) {
		const w = spoke(ring, p, v, i), angle = 2 * Math.PI * i / ring.n;
		a = more(Math.cos(angle), w, a);
		b = more(Math.sin(angle), w, b);
	}
	return normalOf(a, b);
}

/* The neighbours from one sharp edge to the next, k faces on, in the sums that tangents need. */
function sectorFrom(ring, p, v, begin) {
	let k = 1;

	while (!ring.sharp[(begin + k) % ring.n])
		k++;
	const sector = { k, first: spoke(ring, p, v, begin), last: spoke(ring, p, v, begin + k), sine: ZERO, second: ZERO };
	for (let i = 1; i < k; i++) {
		const w = spoke(ring, p, v, begin + i), x = Math.PI * i / k;
		sector.sine = more(Math.sin(x), w, sector.sine);
		sector.second = more(Math.sin(2 * x), w, sector.second);
	}
	return sector;
}

/* The antisymmetric tangent. */
function tangentAlong({ k, first, last, second }) {
	const chord = more(-1, last, first), x = 2 * Math.PI / k;

	return k <= 6 ? chord : more(Math.sin(x) / (2 * Math.cos(x) - 1), chord, second);
}

/* The symmetric one on a smooth curve. */
function tangentAcross({ k, first, last, sine }) {
	const sum = more(1, first, last), x = Math.PI / k;

	return k === 1 ? sum : more(-Math.sin(x) * Math.cos(x) / ((1 - Math.cos(x)) * (1 + 2 * Math.cos(x))), sum, sine);
}

/* The same at a corner. */
function tangentInto({ k, first, last, sine }) {
	const sum = more(1, first, last), x = Math.PI / k;

	return k <= 3 ? sum : more(Math.sin(x) / (2 * Math.cos(x) - 1), sum, sine);
}

function sectorNormal(sector, shape) {
	const along = tangentAlong(sector), n = normalOf(along, shape === CREASE ? tangentAcross(sector) : tangentInto(sector));

	return shape === CREASE || norm(n) > 0 ? n : normalOf(along, sector.sine);
}

/* On a crease and at a corner the unit sum of the normals of the sectors. */
function sharpNormal(ring, p, v) {
	const first = ring.firstSharp(), end = ring.open ? ring.n - 1 : first + ring.n;
	let sum = ZERO;

	for (let i = first; i < end;) {
		const sector = sectorFrom(ring, p, v, i);
		sum = more(1, sectorNormal(sector, ring.shape), sum);
		i += sector.k;
	}
	return unit(sum);
}

/* A dart's symmetric eigenvector, cos((n/2 - j) x) - cos(n/2 x), and what is zero where it is one. */
function dartModeAt(n, x) {
	const at = (j) => Math.cos((0.5 * n - j) * x) - Math.cos(0.5 * n * x), beta = betaOf(n);
	const self = Math.cos(0.5 * n * x) * (1 - Math.cos(x)) / (4 * beta);
	const sum = Math.sin(0.5 * (n - 1) * x) / Math.sin(0.5 * x) - (n - 1) * Math.cos(0.5 * n * x);

	return { at, zeroth: self + sum, defect: (2 * Math.cos(x) - 1) * (self + sum) + 2 * at(1) + 8 * beta * self };
}

/* Its largest eigenvalue has x between pi / n and 3 pi / n. */
function dartModeOf(n) {
	let low = Math.PI / n, high = n > 3 ? 3 * low : Math.PI, mode = null;
	const rises = dartModeAt(n, low).defect < 0;

	for (let i = 0; i < 60; i++) {
		const x = 0.5 * (low + high);
		mode = dartModeAt(n, x);
		if (mode.defect < 0 === rises)
			low = x;
		else
			high = x;
	}
	return mode;
}

function dartNormal(ring, p, v) {
	const first = ring.firstSharp(), mode = dartModeOf(ring.n), sector = sectorFrom(ring, p, v, first);
	let a = more(mode.zeroth, sector.first, ZERO);

	for (let j = 1; j < ring.n; j++)
		a = more(-mode.at(j), spoke(ring, p, v, first + j), a);
	return normalOf(a, sector.second);
}

function limitNormal(ring, p, v) {
	if (ring.n === 0)
		return ZERO;
	if (ring.shape >= CREASE)
		return sharpNormal(ring, p, v);
	return ring.shape === DART ? dartNormal(ring, p, v) : smoothNormal(ring, p, v);
}

/* The masks of six neighbours all around in numbers. */
function regularLimit({ to }, p, v, limit, normal) {
	const w = to.slice(0, 6).map((u) => more(-1, placeOf(p, v), placeOf(p, u)));

	for (let c = 0; c < 3; c++)
		limit[3 * v + c] = p[3 * v + c] + (w[0][c] + w[1][c] + w[2][c] + w[3][c] + w[4][c] + w[5][c]) / 12;
	const a = ZERO.map((_, c) => w[0][c] - w[3][c] + 0.5 * (w[1][c] + w[5][c] - w[2][c] - w[4][c]));
	normal.set(normalOf(a, ZERO.map((_, c) => w[1][c] + w[2][c] - w[4][c] - w[5][c])), 3 * v);
}

/* Limit points and unit limit normals, zero where there is none, of the level's vertices at p. */
export function limitOf(level, p) {
	const limit = new Float64Array(p.length), normal = new Float64Array(p.length), ring = new Ring(level);

	for (let v = 0; v < level.nv; v++) {
		ring.read(v);
		if (ring.n === 6 && ring.shape === 0) {
			regularLimit(ring, p, v, limit, normal);
			continue;
		}
		if (ring.shape === DART)
			limit.set(dartPoint(ring, p, v), 3 * v);
		else
			sumRing(ring, limitMask(ring), 3, v, p, limit);
		normal.set(limitNormal(ring, p, v), 3 * v);
	}
	return { limit, normal };
}
