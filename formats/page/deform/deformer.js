/*
 * deformer.js -- what follows the handles, as mr-decode makes it when nothing moves any more: base and mesh, of which workers
 * have a part each, or the displaced surface over a control mesh (displaced.js).
 */
import { module } from "../library/compile.js";
import { IDENTITY } from "../mesh/rotation.js";
import { textOf } from "../stream/data.js";
import { columnOf } from "../stream/stream.js";

const WORKERS = 4; /* at most */
const VERTICES = 10000; /* of a base, for which a worker more is worth the while */

/* Columns of the frame by other names. */
export const columnsOf = (frame, named) => Object.fromEntries(Object.entries(named).map(([key, name]) => [key, columnOf(frame, ...name.split(" "))]));

/* The columns that it is made of; null where the frame has not all of them. */
export function posedBy(frame) {
	const columns = columnsOf(frame, { position: "base position", triangles: "base triangles", encoded: "base encoded", response: "base response",
		face: "mesh detail_face", bary: "mesh detail_bary", height: "mesh detail_height", offset: "mesh detail_offset" });

	return columns.response && columns.height ? columns : null;
}

const less = (position, centre) => position.map((x, i) => x - centre[i % 3]);

/* Rows of three floats, where `to` has them. */
function scatter(from, rows, to) {
	for (let i = 0, k = 0; i < rows.length; i++, k += 3) {
		const at = 3 * rows[i];
		to[at] = from[k];
		to[at + 1] = from[k + 1];
		to[at + 2] = from[k + 2];
	}
}

/* As many maps as a response is to, in a row. */
export const flat = (maps, handles) => Float64Array.from({ length: 12 * handles }, (_, i) => (maps[Math.floor(i / 12)] || IDENTITY)[i % 12]);

/* A worker with a part; it answers one question at a time. */
class Hand {
	constructor(url) {
		this.worker = new Worker(url);
	}

	/* A promise of how long it took; then it has `places`, which go back to it with the next question. */
	ask(message) {
		const { places } = this, buffers = places ? [places.base.buffer, places.mesh.buffer] : [];

		return new Promise((done, failed) => {
			this.worker.onmessage = ({ data }) => {
				Object.assign(this, data.known); /* of which vertices and rows its places are */
				this.places = data.places;
				done(data.took);
			};
			this.worker.onerror = failed;
			this.worker.postMessage({ ...message, places }, buffers);
		});
	}
}

/* What poses: prepare(centre) makes it ready, compute(maps) changes its `places`, of layers by their names. */
export class Poser {
	/* columns: that it is made of; changed(): there are other places to be drawn. */
	constructor(columns, changed) {
		Object.assign(this, { columns, changed, places: {}, maps: [], working: false });
	}

	/* Whether it is made of these. */
	isOf(columns, centre) {
		return centre === this.centre && Object.keys(columns).every((key) => columns[key] === this.columns[key]);
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
		const values = Object.fromEntries(await Promise.all(keys.map(async (key) => [key, await this.columns[key].values()])));
		const { components, steps: { origin } } = this.columns.response, { position, triangles, height } = values;

		this.centre = centre;
		this.handles = components / 4;
		values.rest = less(values.encoded || position, centre);
		values.position = less(position, centre);
		this.places = { base: new Float32Array(position.length), mesh: new Float32Array(3 * height.length) };
		const counts = [position.length / 3, triangles.length / 3, height.length, this.handles];
		const parts = Math.min(WORKERS, navigator.hardwareConcurrency || 1, Math.ceil(counts[0] / VERTICES));
		const url = URL.createObjectURL(new Blob([await textOf("worker")], { type: "text/javascript" }));
		this.hands = Array.from({ length: parts }, () => new Hand(url));
		await this.all((part) => ({ module, values, counts, origin, part, parts, maps: flat([], this.handles) }));
		URL.revokeObjectURL(url);
		return this;
	}

	/* Asks every hand, and puts together what they answer. */
	async all(question) {
		this.took = Math.max(...await Promise.all(this.hands.map((hand, i) => hand.ask(question(i)))));
		for (const { vertices, rows, places } of this.hands) {
			scatter(places.base, vertices, this.places.base);
			scatter(places.mesh, rows, this.places.mesh);
		}
	}

	compute(maps) {
		return this.all(() => ({ maps: flat(maps, this.handles) }));
	}

	end() {
		super.end();
		this.hands.forEach(({ worker }) => worker.terminate());
	}
}
