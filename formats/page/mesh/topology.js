/* topology.js -- which faces are at a vertex, and what can be reached from it along edges. */

const known = new WeakMap();

/* The faces at each vertex: face[start[v]] to face[start[v + 1]].  Kept as long as the triangles are. */
export function facesAt(t, vertices) {
	const there = known.get(t);

	if (there && there.start.length === vertices + 1)
		return there;
	const start = new Uint32Array(vertices + 1), face = new Uint32Array(t.length);
	for (let k = 0; k < t.length; k++)
		start[t[k] + 1]++;
	for (let v = 0; v < vertices; v++)
		start[v + 1] += start[v];
	const next = start.slice();
	for (let k = 0; k < t.length; k++)
		face[next[t[k]]++] = k / 3 | 0;
	const made = { start, face };
	known.set(t, made);
	return made;
}

/* Calls back for each vertex that has a face in common with v, several times for some, and for v itself. */
export function around(t, at, v, call) {
	for (let i = at.start[v]; i < at.start[v + 1]; i++) {
		const k = 3 * at.face[i];
		call(t[k]);
		call(t[k + 1]);
		call(t[k + 2]);
	}
}

/* All vertices that are connected with v by edges. */
export function partOf(t, vertices, v) {
	const at = facesAt(t, vertices), seen = new Uint8Array(vertices), out = [v];

	seen[v] = 1;
	for (let i = 0; i < out.length; i++)
		around(t, at, out[i], (u) => {
			if (!seen[u]) {
				seen[u] = 1;
				out.push(u);
			}
		});
	return out;
}
