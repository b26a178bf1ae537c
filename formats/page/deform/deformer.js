/*
 * deformer.js -- what follows the handles, as mr-decode makes it when nothing moves any more: base and mesh, which a
 * worker poses, or the displaced surface over a control mesh (displaced.js).
 */
import { module } from "../library/compile.js";
import { IDENTITY } from "../mesh/rotation.js";
import { textOf } from "../stream/data.js";
import { columnOf } from "../stream/stream.js";

/* Columns of the frame by other names. */
export const columnsOf = (frame, named) => Object.fromEntries(Object.entries(named).map(([key, name]) =>
	[key, columnOf(frame, ...name.split(" "))]));

/* The columns that it is made of; null where the frame has not all of them. */
export function posedBy(frame) {
	const columns = columnsOf(frame, { position: "base position", triangles: "base triangles",
		encoded: "base encoded", response: "base response",
		face: "mesh detail_face", bary: "mesh detail_bary", height: "mesh detail_height",
			offset: "mesh detail_offset" });

	return columns.response && columns.height ? columns : null;
}

const less = (position, centre) => position.map((x, i) => x - centre[i % 3]);

/* As many maps as a response is to, in a row. */
export const flat = (maps, handles) => Float64Array.from({ length: 12 * handles }, (_, i) =>
	(maps[Math.floor(i / 12)] || IDENTITY)[i % 12]);

/* What poses: prepare(centre) makes it ready, compute(maps) changes its `places`, of layers by their names. */
export class Poser {
	/* columns: that it is made of; changed(): there are other places to be drawn. */
	constructor(columns, changed) {
		Object.assign(this, { columns, changed, places: {}, maps: [], working: false });
	}

	/* Whether it is made of these. */
	isOf(columns, centre) {
		return centre === this.centre && Object.keys(columns).every((key) =>
			columns[key] === this.columns[key]);
	}

	/* Poses by the handles' maps; what is asked meanwhile comes next, the last of it. */
	async pose(maps) {
		this.maps = this.next = maps;
		if (this.working)
			return;
		this.working = true;
		while (this.next) {
			this.next = null;
			await this.compute(this.maps);
			this.working = Boolean(this.next);
			this.changed();
		}
	}

	/* Goes with the level of the frame. */
	follow() {}

	end() {
		this.next = null;
	}
}

export class Deformer extends Poser {
	/* Reads the columns, around the centre, and waits for the places at rest. */
	async prepare(centre) {
		const keys = Object.keys(this.columns).filter((key) => this.columns[key]);
		const values = Object.fromEntries(await Promise.all(keys.map(async (key) =>
			[key, await this.columns[key].values()])));
		const { components, steps: { origin } } = this.columns.response,
			{ position, triangles, height } = values;

		this.centre = centre;
		this.handles = components / 4;
		values.rest = less(values.encoded || position, centre);
		values.position = less(position, centre);
		const counts = [position.length / 3, triangles.length / 3, height.length, this.handles];
		const url = URL.createObjectURL(new Blob([await textOf("worker")], { type: "text/javascript" }));
		this.worker = new Worker(url);
		await this.ask({ module, values, counts, origin, maps: flat([], this.handles) });
		URL.revokeObjectURL(url);
		return this;
	}

	/* A promise of its answer: then there are its places. */
	ask(message) {
		return new Promise((done, failed) => {
			this.worker.onmessage = ({ data }) => done(Object.assign(this, data));
			this.worker.onerror = failed;
			this.worker.postMessage(message);
		});
	}

	compute(maps) {
		return this.ask({ maps: flat(maps, this.handles) });
	}

	end() {
		super.end();
		this.worker.terminate();
	}
}
