/* lasso.js -- what lies within a line that was drawn around it. */

/* Whether (x, y) is inside of a polygon [[x, y], ...], by the crossings of a ray to the right. */
function inside(polygon, x, y) {
	let odd = false;

	for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
		const [ax, ay] = polygon[i], [bx, by] = polygon[j];
		if (ay > y !== by > y && x < (bx - ax) * (y - ay) / (by - ay) + ax)
			odd = !odd;
	}
	return odd;
}

/* The vertices at p, in a view (stage.js), that are in its picture and inside of the polygon. */
export function within(p, { m, near, width, height }, polygon) {
	const out = [];

	for (let i = 0; i < p.length; i += 3) {
		const depth = m[3] * p[i] + m[7] * p[i + 1] + m[11] * p[i + 2] + m[15];
		const x = ((m[0] * p[i] + m[4] * p[i + 1] + m[8] * p[i + 2] + m[12]) / depth + 1) / 2 * width;
		const y = (1 - (m[1] * p[i] + m[5] * p[i + 1] + m[9] * p[i + 2] + m[13]) / depth) / 2 * height;
		if (depth >= near && x >= 0 && x <= width && y >= 0 && y <= height && inside(polygon, x, y))
			out.push(i / 3);
	}
	return out;
}
