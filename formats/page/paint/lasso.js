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

/* The vertices of a screen that are in the picture and inside of the polygon; through: also those that are hidden. */
export function within(screen, polygon, through) {
	const { x, y, depth, t } = screen, { near, width, height } = screen.view, out = [];
	const xs = polygon.map((q) => q[0]), ys = polygon.map((q) => q[1]);
	const x0 = Math.max(Math.min(...xs), 0), x1 = Math.min(Math.max(...xs), width);
	const y0 = Math.max(Math.min(...ys), 0), y1 = Math.min(Math.max(...ys), height);

	for (let v = 0; v < x.length; v++)
		if (x[v] >= x0 && x[v] <= x1 && y[v] >= y0 && y[v] <= y1 && depth[v] >= near &&
			inside(polygon, x[v], y[v]) && (through || !t || screen.sees(v)))
			out.push(v);
	return out;
}
