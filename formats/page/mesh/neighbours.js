/* neighbours.js -- which vertices share faces: with itself and each other one that of a face, and in how many. */

function countFaces(vertices, t) {
	const first = new Uint32Array(vertices + 1);

	for (let k = 0; k < t.length; k++)
		first[t[k] + 1]++;
	for (let v = 0; v < vertices; v++)
		first[v + 1] += first[v];
	return first;
}

/* The corners at each vertex, corner[first[v]] to corner[first[v + 1]]. */
function cornersOf(first, t) {
	const next = first.slice(), corner = new Uint32Array(t.length);

	for (let k = 0; k < t.length; k++)
		corner[next[t[k]]++] = k;
	return corner;
}

/* Of vertex v those are other[first[v]] to other[first[v + 1]], with weights. */
export function neighboursOf(vertices, t) {
	const faces = countFaces(vertices, t), corner = cornersOf(faces, t);
	const first = new Uint32Array(vertices + 1), other = new Uint32Array(3 * t.length), weight = new Float64Array(3 * t.length);
	const place = new Int32Array(vertices).fill(-1);
	let n = 0;
	const meet = (u, begin) => {
		if (place[u] < begin)
			other[place[u] = n++] = u;
		weight[place[u]]++;
	};

	for (let v = 0; v < vertices; v++) {
		for (let j = faces[v]; j < faces[v + 1]; j++)
			for (let i = 0, k = corner[j] - corner[j] % 3; i < 3; i++)
				meet(t[k + i], first[v]);
		first[v + 1] = n;
	}
	return { first, other: other.slice(0, n), weight: weight.slice(0, n) };
}
