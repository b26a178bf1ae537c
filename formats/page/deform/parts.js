/*
 * parts.js -- a base with its detail, in parts for several workers.  Its vertices are put into an order in which neighbours are
 * near each other, which spares time in memory too; a part is a range of that, with so many rings around it that its turns are
 * those of the whole, and the rows of detail that stand there.
 */
import { neighboursOf } from "../mesh/neighbours.js";

const RINGS = 3; /* a vertex's turn asks for the faces around it, and two rings of vertices have theirs smoothed */
const NONE = 0xffffffff;

/* Appends what is connected with `start`, by breadth, to the `count` vertices that are there; how many are there then. */
function walk({ first, other }, start, order, count, seen) {
	let end = count;

	order[end++] = start;
	seen[start] = 1;
	for (let i = count; i < end; i++)
		for (let j = first[order[i]]; j < first[order[i] + 1]; j++)
			if (!seen[other[j]]) {
				seen[other[j]] = 1;
				order[end++] = other[j];
			}
	return end;
}

/* The vertices by breadth, of each component from one at its end. */
function orderOf(around, vertices) {
	const order = new Uint32Array(vertices), seen = new Uint8Array(vertices), again = new Uint8Array(vertices);

	for (let v = 0, count = 0; v < vertices; v++)
		if (!seen[v])
			count = walk(around, order[walk(around, v, order, count, seen) - 1], order, count, again);
	return order;
}

/* Where each of these is among them; NONE for the others. */
function placesOf(list, length) {
	const place = new Uint32Array(length).fill(NONE);

	list.forEach((v, i) => {
		place[v] = i;
	});
	return place;
}

/* The vertices of the order that are in a set. */
const inOrder = (order, set) => order.filter((v) => set[v]);

/* Adds the neighbours of what is in the set. */
function grow({ first, other }, set) {
	const before = set.slice();

	before.forEach((is, v) => {
		for (let j = first[v]; is && j < first[v + 1]; j++)
			set[other[j]] = 1;
	});
}

/* The triangles between those that have a place, by their places, those of the first vertices first. */
function trianglesBetween(place, triangles, vertices) {
	const found = [], next = new Uint32Array(vertices + 1);

	for (let k = 0; k < triangles.length; k += 3) {
		const a = place[triangles[k]], b = place[triangles[k + 1]], c = place[triangles[k + 2]];
		if (a !== NONE && b !== NONE && c !== NONE) {
			found.push(k);
			next[Math.min(a, b, c) + 1]++;
		}
	}
	for (let v = 0; v < vertices; v++)
		next[v + 1] += next[v];
	const out = new Uint32Array(3 * found.length);
	for (const k of found) {
		const corners = [0, 1, 2].map((i) => place[triangles[k + i]]);
		out.set(corners, 3 * next[Math.min(...corners)]++);
	}
	return out;
}

/* Rows of n numbers. */
function pick(values, n, rows) {
	const out = new values.constructor(n * rows.length);

	for (let i = 0; i < rows.length; i++)
		for (let c = 0; c < n; c++)
			out[n * i + c] = values[n * rows[i] + c];
	return out;
}

/* The rows of detail by the place of their face's first corner. */
function sortRows(values, place) {
	const corner = (i) => place[values.triangles[3 * values.face[i]]];
	const next = new Uint32Array(place.length + 1), rows = new Uint32Array(values.height.length);

	for (let i = 0; i < rows.length; i++)
		next[corner(i) + 1]++;
	for (let v = 0; v < place.length; v++)
		next[v + 1] += next[v];
	for (let i = 0; i < rows.length; i++)
		rows[next[corner(i)]++] = i;
	return rows;
}

/* What a worker makes of these vertices and rows: see worker.js. */
function partOf(values, handles, vertices, rows) {
	const place = placesOf(vertices, values.position.length / 3), { face, bary, height, offset } = values;
	const part = {
		rest: pick(values.rest, 3, vertices),
		position: pick(values.position, 3, vertices),
		response: pick(values.response, 4 * handles, vertices),
		triangles: trianglesBetween(place, values.triangles, vertices.length),
		corner: new Uint32Array(3 * rows.length),
		weight: new Float64Array(3 * rows.length),
		height: pick(height, 1, rows),
		offsets: [],
	};

	rows.forEach((row, i) => {
		const u = bary[2 * row], v = bary[2 * row + 1];
		for (let k = 0; k < 3; k++)
			part.corner[3 * i + k] = place[values.triangles[3 * face[row] + k]];
		part.weight.set([u, v, 1 - u - v], 3 * i);
		const o = offset ? Array.from(offset.subarray(3 * row, 3 * row + 3)) : [];
		if (o.some((x) => x !== 0))
			part.offsets.push({ row: i, corners: Array.from(part.corner.subarray(3 * i, 3 * i + 3)), weights: [u, v, 1 - u - v], offset: o });
	});
	return part;
}

/*
 * So many parts: { vertices, rows, part }, of which the first two say what of the whole it is.  values: rest, position,
 * response, triangles, face, bary, height and offset, which may be null.
 */
export function split(values, handles, count) {
	const n = values.position.length / 3, around = neighboursOf(n, values.triangles);
	const order = orderOf(around, n), place = placesOf(order, n), rows = sortRows(values, place), parts = [];
	const first = (row) => place[values.triangles[3 * values.face[row]]];

	for (let i = 0, end = 0; i < count; i++) {
		const limit = Math.ceil((i + 1) * n / count), begin = end, set = new Uint8Array(n);
		while (end < rows.length && first(rows[end]) < limit)
			end++;
		const own = rows.subarray(begin, end);
		order.subarray(Math.ceil(i * n / count), limit).forEach((v) => {
			set[v] = 1;
		});
		for (const row of own)
			for (let k = 0; k < 3; k++)
				set[values.triangles[3 * values.face[row] + k]] = 1;
		for (let ring = 0; count > 1 && ring < RINGS; ring++)
			grow(around, set);
		const vertices = inOrder(order, set);
		parts.push({ vertices, rows: own, part: partOf(values, handles, vertices, own) });
	}
	return parts;
}
