/*
 * surface.js -- from columns to what a graphics card draws: floats around a centre, normals, and vertices that are
 * parted where the surface has a crease; how large points are.
 */
const CREASE = Math.cos(45 * Math.PI / 180); /* faces farther apart are not shaded as one, as in mr-render */
const BENT = Math.cos(25 * Math.PI / 180); /* a vertex is asked whose normal is farther from one of its faces */

/* The box of positions: low and high corners; null of none. */
export function boxOf(position) {
	const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];

	for (let i = 0; i < position.length; i += 3)
		for (let c = 0; c < 3; c++) {
			const x = position[i + c];
			if (x < low[c])
				low[c] = x;
			if (x > high[c])
				high[c] = x;
		}
	return position.length ? { low, high } : null;
}

export function centreOf(box) {
	return box.low.map((x, c) => (x + box.high[c]) / 2);
}

/* Floats, less the centre. */
export function centred(position, centre) {
	const out = new Float32Array(position.length);

	for (let i = 0; i < out.length; i += 3) {
		out[i] = position[i] - centre[0];
		out[i + 1] = position[i + 1] - centre[1];
		out[i + 2] = position[i + 2] - centre[2];
	}
	return out;
}

/* Scales the vector at i to length 1, where it has one. */
function unit(v, i) {
	const n = Math.sqrt(v[i] * v[i] + v[i + 1] * v[i + 1] + v[i + 2] * v[i + 2]), f = n > 0 ? 1 / n : 1;

	v[i] *= f;
	v[i + 1] *= f;
	v[i + 2] *= f;
}

/* Twice the area times the normal of each face. */
export function faceNormals(p, t, out) {
	for (let f = 0; f < t.length; f += 3) {
		const a = 3 * t[f], b = 3 * t[f + 1], c = 3 * t[f + 2];
		const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
		const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
		out[f] = uy * vz - uz * vy;
		out[f + 1] = uz * vx - ux * vz;
		out[f + 2] = ux * vy - uy * vx;
	}
}

/* Unit sums of the normals of the faces around each vertex. */
function vertexNormals(n, t, faces, out) {
	out.fill(0, 0, n);
	for (let f = 0; f < t.length; f += 3) {
		const x = faces[f], y = faces[f + 1], z = faces[f + 2];
		for (let k = f; k < f + 3; k++) {
			const v = 3 * t[k];
			out[v] += x;
			out[v + 1] += y;
			out[v + 2] += z;
		}
	}
	for (let i = 0; i < n; i += 3)
		unit(out, i);
}

function dot(a, i, b, j) {
	return a[i] * b[j] + a[i + 1] * b[j + 1] + a[i + 2] * b[j + 2];
}

/* Which vertices have a face that leans far from their normal; faces: made unit. */
function creased(normals, n, t, faces) {
	const out = new Uint8Array(n);

	for (let k = 0; k < t.length; k++)
		if (dot(normals, 3 * t[k], faces, k - k % 3) < BENT)
			out[t[k]] = 1;
	return out;
}

/* The corners at each creased vertex: corner[first[v]] to corner[first[v + 1]]. */
function cornersAt(marks, t) {
	const first = new Uint32Array(marks.length + 1);

	for (let k = 0; k < t.length; k++)
		first[t[k] + 1] += marks[t[k]];
	for (let v = 0; v < marks.length; v++)
		first[v + 1] += first[v];
	const corner = new Uint32Array(first[marks.length]), next = first.slice();
	for (let k = 0; k < t.length; k++)
		if (marks[t[k]])
			corner[next[t[k]]++] = k;
	return { first, corner };
}

/* Of each of these corners the faces at its vertex that are within the crease of its own: face[end[j - 1]] to face[end[j]]. */
function groupsOf(at, t, faces) {
	const end = new Uint32Array(at.corner.length), face = [];

	for (let j = 0; j < end.length; j++) {
		const k = at.corner[j], v = t[k];
		for (let i = at.first[v]; i < at.first[v + 1]; i++) {
			const f = at.corner[i] - at.corner[i] % 3;
			if (dot(faces, k - k % 3, faces, f) >= CREASE)
				face.push(f);
		}
		end[j] = face.length;
	}
	return { end, face: Uint32Array.from(face) };
}

/* Unit sums of the normals of those faces. */
function cornerNormals(groups, faces, out, o) {
	for (let j = 0, i = 0; j < groups.end.length; j++, o += 3) {
		let x = 0, y = 0, z = 0;
		for (; i < groups.end[j]; i++) {
			const f = groups.face[i];
			x += faces[f];
			y += faces[f + 1];
			z += faces[f + 2];
		}
		out[o] = x;
		out[o + 1] = y;
		out[o + 2] = z;
		unit(out, o);
	}
}

/* Gives the corners of creased vertices vertices of their own, behind the others. */
function part(nv, t, at) {
	const index = t.slice(), source = new Uint32Array(nv + at.corner.length);

	for (let v = 0; v < nv; v++) {
		source[v] = v;
		for (let j = at.first[v]; j < at.first[v + 1]; j++) {
			index[at.corner[j]] = nv + j;
			source[nv + j] = v;
		}
	}
	return { index, source };
}

/* Places of its vertices, as those of the stream are at p now, and normals; the creases stay where they were. */
export function shade(surface, p) {
	const { position, normal, source, triangles, faces, groups } = surface;

	position.set(p);
	for (let i = p.length; i < position.length; i += 3) {
		const v = 3 * source[i / 3];
		position[i] = p[v];
		position[i + 1] = p[v + 1];
		position[i + 2] = p[v + 2];
	}
	faceNormals(p, triangles, faces);
	vertexNormals(p.length, triangles, faces, normal);
	cornerNormals(groups, faces, normal, p.length);
}

/*
 * A surface to draw: position, normal, index, and `source`, the vertex of the stream that each drawn one stands for.
 * The first vertices are those of the stream.
 */
export function surfaceOf(p, t) {
	const nv = p.length / 3, faces = new Float32Array(t.length), normals = new Float32Array(p.length);

	faceNormals(p, t, faces);
	vertexNormals(p.length, t, faces, normals);
	for (let f = 0; f < faces.length; f += 3)
		unit(faces, f);
	const at = cornersAt(creased(normals, nv, t, faces), t), n = p.length + 3 * at.corner.length;
	const surface = { position: new Float32Array(n), normal: new Float32Array(n), triangles: t, faces, groups: groupsOf(at, t, faces), ...part(nv, t, at) };
	shade(surface, p);
	return surface;
}

/* The two ends of the three edges of each face. */
export function edgesOf(t) {
	const out = new Uint32Array(2 * t.length);

	for (let k = 0; k < t.length; k++) {
		out[2 * k] = t[k];
		out[2 * k + 1] = t[k % 3 === 2 ? k - 2 : k + 1];
	}
	return out;
}

/* The usual distance of a point from the nearest other, by some of them. */
export function spacingOf(p) {
	const n = p.length / 3, asked = Math.min(n, 41), distances = [];

	for (let k = 0; k < asked; k++) {
		const a = 3 * Math.floor((k + 0.5) * n / asked);
		let best = Infinity;
		for (let i = 0; i < p.length; i += 3) {
			const d = (p[i] - p[a]) ** 2 + (p[i + 1] - p[a + 1]) ** 2 + (p[i + 2] - p[a + 2]) ** 2;
			if (d < best && d > 0)
				best = d;
		}
		distances.push(Math.sqrt(best));
	}
	distances.sort((a, b) => a - b);
	return Number.isFinite(distances[asked >> 1]) ? distances[asked >> 1] : 0;
}
