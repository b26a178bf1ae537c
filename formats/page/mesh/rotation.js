/*
 * rotation.js -- 3x3 matrices as rows, affine maps as three rows of four, rotations and their logarithms: lib/base/rotation.c
 * for the few that handles need.
 */

export const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a) => Math.sqrt(dot(a, a));
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
export const unit = (a) => (norm(a) > 0 ? times(1 / norm(a), a) : a);

/* The rotation about w by |w| radians, by Rodrigues' formula. */
export function exponential(w) {
	const angle = norm(w), [x, y, z] = w;

	if (angle === 0)
		return [1, 0, 0, 0, 1, 0, 0, 0, 1];
	const half = Math.sin(angle / 2) / (angle / 2), a = Math.sin(angle) / angle, b = half * half / 2;
	return [
		1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y,
		b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x,
		b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y),
	];
}

/* T a */
export function apply(t, a) {
	return [0, 4, 8].map((i) => t[i] * a[0] + t[i + 1] * a[1] + t[i + 2] * a[2] + t[i + 3]);
}

/* a after b */
export function compose(a, b) {
	return IDENTITY.map((_, k) => {
		const i = k - k % 4, j = k % 4;
		return a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j] + (j === 3 ? a[i + 3] : 0);
	});
}

/* The rows and columns of an affine map that turn and stretch. */
export function linear(t) {
	return [t[0], t[1], t[2], t[4], t[5], t[6], t[8], t[9], t[10]];
}

/* Horn's matrix, shifted so that its largest eigenvalue is the largest by its amount too. */
function horn(m) {
	const s = 0.6 * Math.sqrt(m.reduce((sum, x) => sum + x * x, 0));

	return [
		m[0] + m[4] + m[8] + s, m[7] - m[5], m[2] - m[6], m[3] - m[1],
		m[7] - m[5], m[0] - m[4] - m[8] + s, m[1] + m[3], m[2] + m[6],
		m[2] - m[6], m[1] + m[3], m[4] - m[0] - m[8] + s, m[5] + m[7],
		m[3] - m[1], m[2] + m[6], m[5] + m[7], m[8] - m[0] - m[4] + s,
	];
}

const trace = (s) => s[0] + s[5] + s[10] + s[15];

function square(s) {
	const f = 1 / trace(s) ** 2;

	return s.map((_, k) => {
		const i = k - k % 4, j = k % 4;
		return f * (s[i] * s[j] + s[i + 1] * s[j + 4] + s[i + 2] * s[j + 8] + s[i + 3] * s[j + 12]);
	});
}

/*
 * The unit quaternion, scalar first and not negative, of the rotation nearest to a matrix: squared again and again Horn's
 * matrix becomes the projection on its largest eigenvector (Horn 1987).
 */
export function nearestQuaternion(m) {
	const most = Math.max(...m.map(Math.abs));
	let s = horn(most > 0 ? m.map((x) => x / most) : m);

	if (!(trace(s) > 0))
		return [1, 0, 0, 0];
	for (let i = 0; i < 45; i++) {
		s = square(s);
		if (s.reduce((sum, x) => sum + x * x, 0) >= (1 - 1e-15) * trace(s) ** 2)
			break;
	}
	const best = [0, 1, 2, 3].reduce((b, i) => (s[5 * i] > s[5 * b] ? i : b), 0), q = s.slice(4 * best, 4 * best + 4);
	const length = Math.sqrt(q.reduce((sum, x) => sum + x * x, 0)) * (q[0] < 0 ? -1 : 1);
	return q.map((x) => x / length);
}

/* The matrix of a unit quaternion. */
export function matrixOf([w, x, y, z]) {
	return [
		1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
		2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
		2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
	];
}

/* Of all vectors along the axis of that rotation, as long as its angle and whole turns, the one nearest to `near`. */
export function logarithm(m, near) {
	const q = nearestQuaternion(m), axis = q.slice(1), sine = norm(axis), angle = 2 * Math.atan2(sine, q[0]);

	if (angle < 1e-6)
		return add(times(2, axis), times(2 * Math.PI * Math.round(norm(near) / (2 * Math.PI)), unit(near)));
	const along = times(1 / sine, axis), turns = Math.round((dot(along, near) - angle) / (2 * Math.PI));
	return times(angle + 2 * Math.PI * turns, along);
}
