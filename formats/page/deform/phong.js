/* phong.js -- the normals on which detail stands: lib/mesh/mesh.c, weighted by angle, and the frames of lib/edit/phong.c. */
import { add, dot, norm, sub, times, unit } from "../mesh/rotation.js";

const row = (p, v) => [p[3 * v], p[3 * v + 1], p[3 * v + 2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function addFace(p, t, k, out) {
	const a = row(p, t[k]), u = sub(row(p, t[k + 1]), a), v = sub(row(p, t[k + 2]), a), n = cross(u, v), area = norm(n);

	if (!(area > 0))
		return;
	const first = Math.atan2(area, dot(u, v)), second = Math.atan2(area, dot(u, sub(u, v)));
	const angles = [first, second, Math.PI - first - second];
	for (let i = 0; i < 3; i++)
		for (let c = 0; c < 3; c++)
			out[3 * t[k + i] + c] += angles[i] / area * n[c];
}

/* Unit normals of the vertices; zero where those of the faces cancel. */
export function phongNormals(p, t) {
	const out = new Float64Array(p.length);

	for (let k = 0; k < t.length; k += 3)
		addFace(p, t, k, out);
	for (let i = 0; i < out.length; i += 3)
		out.set(unit(row(out, i / 3)), i);
	return out;
}

/* A without its part along n, at unit length; zero where nothing is left. */
function tangent(a, n) {
	const along = unit(a), t = sub(along, times(dot(along, n), n));

	return dot(t, t) > 1e-20 ? unit(sub(unit(t), times(dot(unit(t), n), n))) : [0, 0, 0];
}

/* The normal over a face at a place of weights w. */
export function phongNormal(p, normals, corners, w) {
	const n = corners.reduce((sum, v, k) => add(sum, times(w[k], row(normals, v))), [0, 0, 0]);

	if (norm(n) > 0)
		return unit(n);
	const [a, b, c] = corners.map((v) => row(p, v)), flat = unit(cross(sub(b, a), sub(c, a)));
	return norm(flat) > 0 ? flat : [0, 0, 1];
}

/* The offset o in the frame there: along the face's first edge without its part along n, n x that, and n. */
export function offsetIn(p, normals, corners, w, o) {
	const n = phongNormal(p, normals, corners, w);
	let t = tangent(sub(row(p, corners[1]), row(p, corners[0])), n);

	if (norm(t) === 0)
		t = tangent(Math.abs(n[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0], n);
	return add(add(times(o[0], t), times(o[1], cross(n, t))), times(o[2], n));
}
