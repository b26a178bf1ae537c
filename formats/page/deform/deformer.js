/*
 * deformer.js -- base and mesh as the handles pose them.  At once the base is where its response has it, and the detail on it
 * with the normals that are known; the worker then tells how these have turned, and the detail is put on once more: what is
 * shown when nothing moves any more is what mr-decode makes.
 */
import { textOf } from "../stream/data.js";
import { Base, Detail } from "./decode.js";
import { columnOf } from "../stream/stream.js";

/* The columns that it is made of; null where the frame has not all of them. */
export function posedBy(frame) {
	const named = { position: "base position", triangles: "base triangles", encoded: "base encoded", response: "base response",
		face: "mesh detail_face", bary: "mesh detail_bary", height: "mesh detail_height", offset: "mesh detail_offset" };
	const columns = Object.fromEntries(Object.entries(named).map(([key, name]) => [key, columnOf(frame, ...name.split(" "))]));

	return columns.response && columns.height ? columns : null;
}

function less(position, centre) {
	return Float64Array.from(position, (x, i) => x - centre[i % 3]);
}

/* The vertices that have an offset in place of a height: their row, the corners of the face and the weights there. */
function offsetRows(values, triangles) {
	const rows = [], o = values.offset;

	for (let i = 0; o && i < o.length / 3; i++)
		if (o[3 * i] || o[3 * i + 1] || o[3 * i + 2]) {
			const [u, v] = values.bary.subarray(2 * i, 2 * i + 2), f = 3 * values.face[i];
			rows.push({ row: i, corners: Array.from(triangles.subarray(f, f + 3)), weights: [u, v, 1 - u - v], offset: Array.from(o.subarray(3 * i, 3 * i + 3)) });
		}
	return rows;
}

async function startWorker() {
	const url = URL.createObjectURL(new Blob([await textOf("turner")], { type: "text/javascript" }));
	const worker = new Worker(url);

	URL.revokeObjectURL(url);
	return worker;
}

export class Deformer {
	/* changed(): there are other places to be drawn. */
	constructor(columns, changed) {
		this.columns = columns;
		this.changed = changed;
		this.working = false; /* whether the worker has more to say */
	}

	/* Whether it is made of these. */
	isOf(columns, centre) {
		return centre === this.centre && Object.keys(columns).every((key) => columns[key] === this.columns[key]);
	}

	/* Reads the columns, around the centre, and waits for the normals at rest. */
	async prepare(centre) {
		const keys = Object.keys(this.columns).filter((key) => this.columns[key]);
		const values = Object.fromEntries(await Promise.all(keys.map(async (key) => [key, await this.columns[key].values()])));

		this.centre = centre;
		const rest = less(values.encoded || values.position, centre);

		this.offsets = offsetRows(values, values.triangles);
		this.base = new Base(less(values.position, centre), values.response, this.columns.response.components / 4, this.columns.response.steps.origin);
		this.detail = new Detail(values.face, values.bary, values.height, values.triangles);
		this.places = { base: new Float32Array(values.position.length), mesh: new Float32Array(3 * values.height.length) };
		this.worker = await startWorker();
		this.worker.addEventListener("message", ({ data }) => this.hear(data));
		this.worker.addEventListener("error", () => this.failed());
		await this.ask({ rest, triangles: values.triangles, rows: this.offsets });
		return this;
	}

	/* Asks the worker for the base as it is now; a promise of the answer. */
	ask(more) {
		const position = this.base.position.slice();

		this.working = true;
		this.stale = false;
		this.worker.postMessage({ ...more, position });
		return new Promise((done, failed) => {
			this.answered = done;
			this.failed = failed;
		});
	}

	hear({ normals, offsets, took }) {
		this.normals = normals;
		this.turned = offsets;
		this.took = took;
		this.working = false;
		this.answered();
		if (this.stale)
			this.ask();
		this.decode();
		this.changed();
	}

	/* Poses by the changes of the handles' maps, as Pose says them. */
	pose(changes) {
		this.base.pose(changes);
		this.decode();
		this.stale = true;
		if (!this.working)
			this.ask();
	}

	decode() {
		const { mesh, base } = this.places;

		base.set(this.base.position);
		this.detail.decode(this.base.position, this.normals, mesh);
		this.offsets.forEach(({ row }, i) => {
			for (let c = 0; c < 3; c++)
				mesh[3 * row + c] += this.turned[3 * i + c];
		});
	}

	end() {
		this.worker.terminate();
	}
}
