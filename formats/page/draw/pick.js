/* pick.js -- what is under a place of the picture: the nearest triangle along a ray, the nearest point about it. */

/*
 * The triangle that the ray meets first, by Moeller and Trumbore's test of each, from both sides: a million take some
 * tens of milliseconds.  null where there is none; t: how far along the ray.
 */
export function nearestFace(p, index, from, along) {
	const [ox, oy, oz] = from, [dx, dy, dz] = along;
	let best = Infinity, face = -1;

	for (let k = 0; k < index.length; k += 3) {
		const a = 3 * index[k], b = 3 * index[k + 1], c = 3 * index[k + 2];
		const ax = p[a], ay = p[a + 1], az = p[a + 2];
		const ux = p[b] - ax, uy = p[b + 1] - ay, uz = p[b + 2] - az;
		const vx = p[c] - ax, vy = p[c + 1] - ay, vz = p[c + 2] - az;
		const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
		const det = ux * px + uy * py + uz * pz;
		const sx = ox - ax, sy = oy - ay, sz = oz - az;
		const u = (sx * px + sy * py + sz * pz) / det;
		if (!(u >= 0 && u <= 1))
			continue;
		const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
		const v = (dx * qx + dy * qy + dz * qz) / det;
		if (!(v >= 0 && u + v <= 1))
			continue;
		const t = (vx * qx + vy * qy + vz * qz) / det;
		if (t > 0 && t < best) {
			best = t;
			face = k / 3;
		}
	}
	return face < 0 ? null : { face, t: best };
}

/* The corner of the face that is nearest to the place. */
export function nearestCorner(p, index, face, place) {
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

/*
 * Of the points that are drawn within `radius` of the place (x, y), all in halves of the picture's height, the
 * nearest to the eye.  m: the 16 numbers of projection times view.
 */
export function nearestPoint(p, m, x, y, radius, aspect) {
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
