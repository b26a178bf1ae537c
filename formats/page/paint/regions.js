/* regions.js -- the region of each vertex as it is painted: counts, changes that can be taken back, changes along edges. */
export const FIXED = 0, FREE = 1, HANDLE = 2;
const MOST = 8e6; /* vertices that all changes together may hold to be taken back */

export class Regions {
	/* values: what the stream says, which stays as it is; null: all fixed. */
	constructor(values, n) {
		this.values = values ? Uint32Array.from(values) : new Uint32Array(n);
		this.past = [];
		this.future = [];
		this.change = null;
		this.counts = new Map();
		for (const region of this.values)
			this.count(region, 1);
	}

	count(region, by) {
		this.counts.set(region, (this.counts.get(region) || 0) + by);
	}

	put(v, region) {
		this.count(this.values[v], -1);
		this.count(region, 1);
		this.values[v] = region;
	}

	/* Begins a change that is taken back as one. */
	begin() {
		this.change = { at: [], before: [] };
	}

	/* Gives vertices a region, as a part of the change that was begun; returns those that did not have it. */
	set(vertices, region) {
		const changed = [];

		for (const v of vertices)
			if (this.values[v] !== region) {
				this.change.at.push(v);
				this.change.before.push(this.values[v]);
				this.put(v, region);
				changed.push(v);
			}
		return changed;
	}

	/* Ends the change, so that it can be taken back; returns its vertices. */
	end() {
		const at = Uint32Array.from(this.change.at), before = Uint32Array.from(this.change.before);

		this.change = null;
		if (at.length === 0)
			return at;
		this.past.push({ at, before, after: at.map((v) => this.values[v]) });
		this.future = [];
		for (let held = this.past.reduce((n, c) => n + c.at.length, 0); held > MOST && this.past.length > 1;)
			held -= this.past.shift().at.length;
		return at;
	}

	/* Ends the change as if it had not been; returns its vertices. */
	cancel() {
		const { at, before } = this.change;

		for (let i = at.length - 1; i >= 0; i--)
			this.put(at[i], before[i]);
		this.change = null;
		return at;
	}

	undo() {
		const last = this.past.pop();

		if (!last)
			return [];
		for (let i = last.at.length - 1; i >= 0; i--)
			this.put(last.at[i], last.before[i]);
		this.future.push(last);
		return last.at;
	}

	redo() {
		const next = this.future.pop();

		if (!next)
			return [];
		next.at.forEach((v, i) => this.put(v, next.after[i]));
		this.past.push(next);
		return next.at;
	}

	/* All at once: vertices get the regions beside them. */
	replace(vertices, regions) {
		this.begin();
		vertices.forEach((v, i) => this.set([v], regions[i]));
		return this.end();
	}

	/* The vertices where `holds` of their number and region. */
	where(holds) {
		const out = [];

		for (let v = 0; v < this.values.length; v++)
			if (holds(this.values[v], v))
				out.push(v);
		return out;
	}

	/* All that is in no handle gets the region; so does what is in none but it. */
	fill(region) {
		const vertices = this.where((r) => r < HANDLE);

		return this.replace(vertices, vertices.map(() => region));
	}

	/* The region gives its vertices back: they are fixed. */
	clear(region) {
		const vertices = this.where((r) => r === region);

		return this.replace(vertices, vertices.map(() => FIXED));
	}

	/* A ring of vertices of no handle around the region gets into it. */
	grow(region, t) {
		const { values } = this, beside = new Uint8Array(values.length);

		for (let k = 0; k < t.length; k += 3)
			if (values[t[k]] === region || values[t[k + 1]] === region || values[t[k + 2]] === region)
				beside[t[k]] = beside[t[k + 1]] = beside[t[k + 2]] = 1;
		const vertices = this.where((r, v) => beside[v] && r !== region && r < HANDLE);
		return this.replace(vertices, vertices.map(() => region));
	}
}
