/* regions.js -- the region of each vertex as it is painted: counts, changes that can be taken back, changes along
 * edges. */
export const FIXED = 0, FREE = 1, HANDLE = 2;
const MOST = 32; /* changes that can be taken back */

export class Regions {
	/* values: what the stream says, which stays as it is; null: all fixed. */
	constructor(values, n) {
		this.values = values ? Uint32Array.from(values) : new Uint32Array(n);
		this.past = []; /* values before each change */
		this.future = [];
		this.before = null; /* those before the change that was begun */
		this.countAll();
	}

	countAll() {
		this.counts = new Map();
		for (const region of this.values)
			this.count(region, 1);
	}

	count(region, by) {
		this.counts.set(region, (this.counts.get(region) || 0) + by);
	}

	/* Begins a change that is taken back as one. */
	begin() {
		this.before = this.values.slice();
	}

	/* Gives vertices a region, as a part of the change that was begun; returns those that did not have it. */
	set(vertices, region) {
		const changed = Array.from(vertices).filter((v) => this.values[v] !== region);

		for (const v of changed) {
			this.count(this.values[v], -1);
			this.count(region, 1);
			this.values[v] = region;
		}
		return changed;
	}

	/* Ends the change, so that it can be taken back; whether there is any. */
	end() {
		const { before } = this, changes = before.some((region, v) => region !== this.values[v]);

		this.before = null;
		if (!changes)
			return false;
		this.past = [...this.past, before].slice(-MOST);
		this.future = [];
		return true;
	}

	/* Ends the change as if it had not been. */
	cancel() {
		this.values.set(this.before);
		this.before = null;
		this.countAll();
	}

	/* Whether there was a step from one list to the other. */
	step(from, to) {
		if (from.length === 0)
			return false;
		to.push(this.values.slice());
		this.values.set(from.pop());
		this.countAll();
		return true;
	}

	undo() {
		return this.step(this.past, this.future);
	}

	redo() {
		return this.step(this.future, this.past);
	}

	/* All vertices where `holds` of their region and number get a region, as one change. */
	change(region, holds) {
		this.begin();
		this.set(Array.from(this.values.keys()).filter((v) => holds(this.values[v], v)), region);
		return this.end();
	}

	/* All that is in no handle gets the region; so does what is in none but it. */
	fill(region) {
		return this.change(region, (r) => r < HANDLE);
	}

	/* The region gives its vertices back: they are fixed. */
	clear(region) {
		return this.change(FIXED, (r) => r === region);
	}
}
