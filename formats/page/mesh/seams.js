/*
 * seams.js -- a surface whose vertices are parted: to a vertex for each corner, or where the picture on it, or the place in that,
 * changes.  What is drawn then has vertices that stand for those of the surface (`from`), and so for the stream's (`source`).
 */

/* Three vertices to a face, of which each stands for its face, for colours of faces. */
export function apart(surface) {
	return { from: surface.index, source: surface.index.map((_, k) => Math.floor(k / 3)), index: null };
}

/*
 * As few as there can be, the surface's own first.  places: u and v of each corner; looks: a number for each face.  uv and look are
 * those of the vertices.
 */
export function seamed(surface, places, looks) {
	const t = surface.index, n = surface.source.length, most = n + t.length;
	const from = new Uint32Array(most), uv = new Float32Array(2 * most), look = new Uint32Array(most), next = new Uint32Array(most);
	const used = new Uint8Array(most), index = new Uint32Array(t.length);
	let count = n;

	const is = (v, k) => uv[2 * v] === places[2 * k] && uv[2 * v + 1] === places[2 * k + 1] && look[v] === looks[Math.floor(k / 3)];
	const take = (v, k) => {
		used[v] = 1;
		from[v] = t[k];
		uv[2 * v] = places[2 * k];
		uv[2 * v + 1] = places[2 * k + 1];
		look[v] = looks[Math.floor(k / 3)];
		return v;
	};

	for (let v = 0; v < n; v++)
		from[v] = v;
	for (let k = 0; k < t.length; k++) {
		let v = t[k];
		while (used[v] && !is(v, k))
			v = next[v] = next[v] || count++;
		index[k] = used[v] ? v : take(v, k);
	}
	return { from: from.slice(0, count), source: from.slice(0, count).map((v) => surface.source[v]), index, uv: uv.slice(0, 2 * count), look: look.slice(0, count) };
}

/* Places and normals of the parted vertices. */
export function gather(surface, { from }) {
	const position = new Float32Array(3 * from.length), normal = new Float32Array(3 * from.length);

	for (let i = 0; i < from.length; i++)
		for (let c = 0, v = 3 * from[i]; c < 3; c++) {
			position[3 * i + c] = surface.position[v + c];
			normal[3 * i + c] = surface.normal[v + c];
		}
	return { position, normal };
}

/* The faces in the order of their looks, and where those of each begin in the index: { index, groups: [{ start, count, look }] }. */
export function sorted(index, looks) {
	const counts = new Map();

	for (const look of looks)
		counts.set(look, (counts.get(look) || 0) + 1);
	const groups = [], at = new Map(), out = new Uint32Array(index.length);
	let start = 0;
	for (const [look, faces] of [...counts].sort(([a], [b]) => a - b)) {
		groups.push({ start, count: 3 * faces, look });
		at.set(look, start);
		start += 3 * faces;
	}
	looks.forEach((look, f) => {
		const to = at.get(look);
		out.set(index.subarray(3 * f, 3 * f + 3), to);
		at.set(look, to + 3);
	});
	return { index: out, groups };
}
