/* pick.js -- what is under a place of the picture: the corner of a triangle, the nearest point about it. */
const NEAR = 9; /* pixels about a point */

/* The corner of the face that is nearest to the place. */
function nearestCorner(p, index, face, place) {
	let best = Infinity, vertex = 0;

	for (let k = 3 * face; k < 3 * face + 3; k++) {
		const v = 3 * index[k];
		const d = (p[v] - place[0]) ** 2 + (p[v + 1] - place[1]) ** 2 + (p[v + 2] - place[2]) ** 2;
		if (d < best) {
			best = d;
			vertex = index[k];
		}
	}
	return vertex;
}

/* Of the points that are drawn within `radius` of the place (x, y), all in halves of the picture's height, the nearest
 * to the eye.  m: the 16 numbers of projection times view. */
function nearestPoint(p, m, x, y, radius, aspect) {
	let best = Infinity, vertex = -1;

	for (let i = 0; i < p.length; i += 3) {
		const w = m[3] * p[i] + m[7] * p[i + 1] + m[11] * p[i + 2] + m[15];
		if (!(w > 0 && w < best))
			continue;
		const px = (m[0] * p[i] + m[4] * p[i + 1] + m[8] * p[i + 2] + m[12]) / w * aspect - x * aspect;
		const py = (m[1] * p[i] + m[5] * p[i + 1] + m[9] * p[i + 2] + m[13]) / w - y;
		if (px * px + py * py <= radius * radius) {
			best = w;
			vertex = i / 3;
		}
	}
	return vertex < 0 ? null : { vertex, t: best };
}

/* The first thing that a ray (stage.js) hits, as { name, face, vertex, at }, or null.  layers: pairs [name, drawn].
 * at is in the layer's floats; face is null for points. */
export function hitAt(ray, layers) {
	let best = null;

	for (const [name, { position: p, triangles, solid }] of layers) {
		const hit = solid ? solid.hit(ray.from, ray.along) :
			nearestPoint(p, ray.projection, ray.right, ray.top, NEAR * 2 / ray.height, ray.aspect);
		if (!hit)
			continue;
		const at = hit.at || Array.from(p.subarray(3 * hit.vertex, 3 * hit.vertex + 3)),
			t = hit.t || Math.hypot(...at.map((x, c) => x - ray.from[c]));
		if (!best || t < best.t)
			best = { name, t, at, face: solid ? hit.face : null,
				vertex: solid ? nearestCorner(p, triangles, hit.face, at) : hit.vertex };
	}
	return best;
}
