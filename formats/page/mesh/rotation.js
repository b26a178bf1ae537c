/* rotation.js -- vectors, affine maps as three rows of four, rotations and their logarithms, for the few that handles
 * need. */

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

/* Of all vectors along the axis of a rotation, as long as its angle and whole turns, the one nearest to `near`. */
export function logarithm({ x, y, z, w }, near) {
	const axis = times(w < 0 ? -1 : 1, [x, y, z]), sine = norm(axis), angle = 2 * Math.atan2(sine, Math.abs(w));

	if (angle < 1e-6)
		return add(times(2, axis), times(2 * Math.PI * Math.round(norm(near) / (2 * Math.PI)), unit(near)));
	const along = times(1 / sine, axis), turns = Math.round((dot(along, near) - angle) / (2 * Math.PI));
	return times(angle + 2 * Math.PI * turns, along);
}
