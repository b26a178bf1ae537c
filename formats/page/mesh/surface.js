/* surface.js -- from columns to what a graphics card draws: floats around a centre, edges; how large points are. */

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
