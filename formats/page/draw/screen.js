/*
 * screen.js -- a layer as one view has it: where its vertices are in the picture, and its faces by tiles of it, so that
 * what lies under a pixel, and whether a vertex is hidden, is asked of few faces.
 */
const FEW = 8; /* faces to a tile, about, were they spread over all */
const MOST = 3e7; /* entries in all tiles */
const CLOSE = 1e-6; /* of the way to a vertex: a face no nearer than that does not hide it */

/* How far along the ray, in lengths of d, the face at k is met; Infinity: not.  By Moeller and Trumbore, from both sides. */
function meet(p, t, k, o, d) {
	const a = 3 * t[k], b = 3 * t[k + 1], c = 3 * t[k + 2];
	const ax = p[a], ay = p[a + 1], az = p[a + 2];
	const ux = p[b] - ax, uy = p[b + 1] - ay, uz = p[b + 2] - az;
	const vx = p[c] - ax, vy = p[c + 1] - ay, vz = p[c + 2] - az;
	const px = d[1] * vz - d[2] * vy, py = d[2] * vx - d[0] * vz, pz = d[0] * vy - d[1] * vx;
	const det = ux * px + uy * py + uz * pz;
	const sx = o[0] - ax, sy = o[1] - ay, sz = o[2] - az;
	const u = (sx * px + sy * py + sz * pz) / det;
	if (!(u >= 0 && u <= 1))
		return Infinity;
	const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
	const v = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
	if (!(v >= 0 && u + v <= 1))
		return Infinity;
	return (vx * qx + vy * qy + vz * qz) / det;
}

/* Whether a number is neither less than all three nor greater. */
function among(a, b, c, x) {
	return (a <= x || b <= x || c <= x) && (a >= x || b >= x || c >= x);
}

/* Counts a face in tiles, whose counts stand one behind them. */
function countIn(start, from, to) {
	for (let i = from; i <= to; i++)
		start[i + 1]++;
}

function putIn(face, next, from, to, k) {
	for (let i = from; i <= to; i++)
		face[next[i]++] = k;
}

export class Screen {
	/* p, t (null: points) in a view: { m, eye, near, width, height }, m the 16 numbers of projection times view. */
	constructor(p, t, view) {
		Object.assign(this, { p, t, view });
		this.project();
		if (t)
			this.sort();
	}

	/* Pixels from the top left corner, and depth. */
	project() {
		const { p } = this, { m, width, height } = this.view, n = p.length / 3;

		this.x = new Float64Array(n);
		this.y = new Float64Array(n);
		this.depth = new Float64Array(n);
		for (let v = 0, i = 0; v < n; v++, i += 3) {
			const w = m[3] * p[i] + m[7] * p[i + 1] + m[11] * p[i + 2] + m[15];
			this.depth[v] = w;
			this.x[v] = ((m[0] * p[i] + m[4] * p[i + 1] + m[8] * p[i + 2] + m[12]) / w + 1) / 2 * width;
			this.y[v] = (1 - (m[1] * p[i] + m[5] * p[i + 1] + m[9] * p[i + 2] + m[13]) / w) / 2 * height;
		}
	}

	sort() {
		const { width, height } = this.view;

		this.side = Math.min(Math.max(Math.sqrt(width * height * FEW / (this.t.length / 3)), 2), 16);
		while (!this.fill())
			this.side *= 2;
	}

	/* The faces of each tile: face[start[i]] to face[start[i + 1]]; false where the tiles are too many. */
	fill() {
		const { t, side } = this, { width, height } = this.view;
		const columns = this.columns = Math.ceil(width / side), rows = this.rows = Math.ceil(height / side);
		const start = this.start = new Uint32Array(columns * rows + 1);
		let total = 0;

		for (let k = 0; k < t.length; k += 3) {
			if (!this.tilesOf(k))
				continue;
			for (let r = this.r0 * columns; r <= this.r1 * columns; r += columns)
				countIn(start, r + this.c0, r + this.c1);
			total += (this.r1 - this.r0 + 1) * (this.c1 - this.c0 + 1);
		}
		if (total > MOST && side < Math.max(width, height))
			return false;
		for (let i = 0; i < columns * rows; i++)
			start[i + 1] += start[i];
		this.put(total);
		return true;
	}

	put(total) {
		const { t, columns } = this, next = this.start.slice();

		this.face = new Uint32Array(total);
		for (let k = 0; k < t.length; k += 3) {
			if (!this.tilesOf(k))
				continue;
			for (let r = this.r0 * columns; r <= this.r1 * columns; r += columns)
				putIn(this.face, next, r + this.c0, r + this.c1, k);
		}
	}

	/* Tiles c0..c1 x r0..r1 that the face at k may be in; false: none. */
	tilesOf(k) {
		const { t, x, y, depth } = this, { near } = this.view, a = t[k], b = t[k + 1], c = t[k + 2];

		if (depth[a] >= near && depth[b] >= near && depth[c] >= near)
			return this.tiles(Math.min(x[a], x[b], x[c]), Math.max(x[a], x[b], x[c]), Math.min(y[a], y[b], y[c]), Math.max(y[a], y[b], y[c]));
		if (depth[a] < near && depth[b] < near && depth[c] < near)
			return false;
		return this.cutTiles([a, b, c]);
	}

	/* The same of a face that the near plane cuts: of the part behind that plane. */
	cutTiles(corners) {
		const { p } = this, { m, near, width, height } = this.view, xs = [], ys = [];

		corners.forEach((a, i) => {
			const b = corners[(i + 1) % 3], da = this.depth[a], db = this.depth[b];
			if (da >= near) {
				xs.push(this.x[a]);
				ys.push(this.y[a]);
			}
			if ((da >= near) === (db >= near))
				return;
			const s = (near - da) / (db - da), q = [0, 1, 2].map((k) => p[3 * a + k] + s * (p[3 * b + k] - p[3 * a + k]));
			xs.push(((m[0] * q[0] + m[4] * q[1] + m[8] * q[2] + m[12]) / near + 1) / 2 * width);
			ys.push((1 - (m[1] * q[0] + m[5] * q[1] + m[9] * q[2] + m[13]) / near) / 2 * height);
		});
		return this.tiles(Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys));
	}

	tiles(x0, x1, y0, y1) {
		const { side, columns, rows } = this;

		if (!(x1 >= 0 && y1 >= 0 && x0 < columns * side && y0 < rows * side))
			return false;
		this.c0 = Math.max(Math.floor(x0 / side), 0);
		this.c1 = Math.min(Math.floor(x1 / side), columns - 1);
		this.r0 = Math.max(Math.floor(y0 / side), 0);
		this.r1 = Math.min(Math.floor(y1 / side), rows - 1);
		return true;
	}

	/* The number of the tile at a pixel; -1 outside. */
	tileAt(x, y) {
		const c = Math.floor(x / this.side), r = Math.floor(y / this.side);

		return c >= 0 && r >= 0 && c < this.columns && r < this.rows ? r * this.columns + c : -1;
	}

	/* The face that a ray through a pixel meets first: { face, at }; null: none.  along: of length 1. */
	hit(x, y, along) {
		const tile = this.tileAt(x, y);
		let best = Infinity, face = -1;

		for (let i = tile < 0 ? 0 : this.start[tile]; tile >= 0 && i < this.start[tile + 1]; i++) {
			const d = meet(this.p, this.t, this.face[i], this.view.eye, along);
			if (d > 0 && d < best) {
				best = d;
				face = this.face[i] / 3;
			}
		}
		return face < 0 ? null : { face, at: this.view.eye.map((o, c) => o + best * along[c]) };
	}

	/* Whether v is in the picture and no face is before it. */
	sees(v) {
		const { p, t, view } = this, tile = this.depth[v] >= view.near ? this.tileAt(this.x[v], this.y[v]) : -1;

		if (tile < 0)
			return false;
		const d = [p[3 * v] - view.eye[0], p[3 * v + 1] - view.eye[1], p[3 * v + 2] - view.eye[2]];
		for (let i = this.start[tile]; i < this.start[tile + 1]; i++) {
			const k = this.face[i];
			if (!this.mayHide(t[k], t[k + 1], t[k + 2], v))
				continue;
			const s = meet(p, t, k, view.eye, d);
			if (s < 1 - CLOSE && s * this.depth[v] >= view.near)
				return false;
		}
		return true;
	}

	/* Whether a face of other corners is not all behind v, nor all to one side of it. */
	mayHide(a, b, c, v) {
		const { x, y, depth } = this, least = Math.min(depth[a], depth[b], depth[c]);

		if (a === v || b === v || c === v || least > depth[v])
			return false;
		return least < this.view.near || (among(x[a], x[b], x[c], x[v]) && among(y[a], y[b], y[c], y[v]));
	}
}
