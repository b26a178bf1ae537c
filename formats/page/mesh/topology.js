/* topology.js -- what can be reached from a vertex along edges. */

/* All vertices that are connected with v: sets that faces join. */
export function partOf(t, vertices, v) {
	const root = Uint32Array.from({ length: vertices }, (_, i) => i);
	const find = (i) => {
		while (root[i] !== i)
			i = root[i] = root[root[i]];
		return i;
	};

	for (let k = 0; k < t.length; k++)
		root[find(t[k])] = find(t[k - k % 3]);
	const own = find(v);
	return root.map((_, u) => u).filter((u) => find(u) === own);
}
