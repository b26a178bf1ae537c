/*
 * folds.js -- folded edges: those between two faces whose normals are more than 170 degrees apart, as lib/mesh/fold.h has them
 * and mr-info counts them.
 */
import { faceNormals } from "./surface.js";

const FOLD = Math.cos(170 * Math.PI / 180);

const endOf = (t, h) => t[h % 3 === 2 ? h - 2 : h + 1];

/* Half-edges in the order of the lower vertex of each: half[first[v]] to half[first[v + 1]]; a face with a vertex twice has none. */
function sortHalves(vertices, t) {
	const first = new Uint32Array(vertices + 1), half = new Uint32Array(t.length);
	const isFlat = (h, k = h - h % 3) => t[k] === t[k + 1] || t[k + 1] === t[k + 2] || t[k + 2] === t[k];

	for (let h = 0; h < t.length; h++)
		if (!isFlat(h))
			first[Math.min(t[h], endOf(t, h)) + 1]++;
	for (let v = 0; v < vertices; v++)
		first[v + 1] += first[v];
	const next = first.slice();
	for (let h = 0; h < t.length; h++)
		if (!isFlat(h))
			half[next[Math.min(t[h], endOf(t, h))]++] = h;
	return { first, half };
}

/* The two half-edges of each edge that has two faces: pair by pair. */
export function pairsOf(vertices, t) {
	const { first, half } = sortHalves(vertices, t), pairs = [], met = new Map();

	for (let v = 0; v < vertices; v++) {
		met.clear();
		for (let i = first[v]; i < first[v + 1]; i++) {
			const other = t[half[i]] === v ? endOf(t, half[i]) : t[half[i]], there = met.get(other);
			if (there)
				there.push(half[i]);
			else
				met.set(other, [half[i]]);
		}
		for (const halves of met.values())
			if (halves.length === 2)
				pairs.push(halves[0], halves[1]);
	}
	return Uint32Array.from(pairs);
}

/* Those half-edges of which the edge is folded, one of each pair; p: places of the vertices. */
export function foldsOf(pairs, p, t) {
	const normal = new Float64Array(t.length), folds = [];

	faceNormals(p, t, normal);
	for (let i = 0; i < pairs.length; i += 2) {
		const h = pairs[i], g = pairs[i + 1], a = h - h % 3, b = g - g % 3, side = t[h] === t[g] ? -1 : 1;
		const dot = side * (normal[a] * normal[b] + normal[a + 1] * normal[b + 1] + normal[a + 2] * normal[b + 2]);
		const m = normal[a] ** 2 + normal[a + 1] ** 2 + normal[a + 2] ** 2, n = normal[b] ** 2 + normal[b + 1] ** 2 + normal[b + 2] ** 2;
		if (dot < 0 && dot * dot > FOLD * FOLD * m * n)
			folds.push(h);
	}
	return folds;
}

/* The two ends of the edges of these half-edges. */
export function endsOf(halves, t) {
	return Uint32Array.from(halves.flatMap((h) => [t[h], endOf(t, h)]));
}
