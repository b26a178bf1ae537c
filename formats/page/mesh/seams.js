/* seams.js -- a surface with three vertices of its own to each face, for colours of faces and for pictures on it. */

/* What is drawn of these faces, in that order: which drawn vertex of the surface each stands `from`, and of which face (`source`). */
export function apart({ index }, faces = Uint32Array.from({ length: index.length / 3 }, (_, f) => f)) {
	const from = new Uint32Array(3 * faces.length), source = new Uint32Array(3 * faces.length);

	for (let k = 0; k < from.length; k++) {
		source[k] = faces[Math.floor(k / 3)];
		from[k] = index[3 * source[k] + k % 3];
	}
	return { from, source, index: null };
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
