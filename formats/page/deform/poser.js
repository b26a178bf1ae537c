/* poser.js -- what follows the handles, as mr-decode makes it when nothing moves any more: the base by its response to
 * them, and over it the mesh by its detail (library/detail.c). */
import { library } from "../library/compile.js";
import { centred } from "../mesh/surface.js";
import { columnOf } from "../stream/stream.js";

const BASE = { position: "base position", triangles: "base triangles", response: "base response",
	encoded: "base encoded", face: "mesh detail_face", bary: "mesh detail_bary", height: "mesh detail_height",
	offset: "mesh detail_offset" };
const PARTS = ["rest", "triangles", "face", "bary", "height", "offset"]; /* library/detail.c */

/* The columns that the frame can be posed by; null: it cannot. */
export function posedBy(frame) {
	const columns = Object.fromEntries(Object.entries(BASE).map(([key, name]) =>
		[key, columnOf(frame, ...name.split(" "))]));

	return columns.response && columns.height ? columns : null;
}

export class Poser {
	/* columns: that it is made of. */
	constructor(columns) {
		this.columns = columns;
		this.places = {}; /* of each layer */
	}

	/* Whether it is made of these. */
	isOf(columns, centre) {
		return centre === this.centre && Object.keys({ ...columns, ...this.columns }).every((key) =>
			columns[key] === this.columns[key]);
	}

	/* Reads the columns. */
	async prepare(centre) {
		const keys = Object.keys(this.columns).filter((key) => this.columns[key]);
		const values = this.values = Object.fromEntries(await Promise.all(keys.map(async (key) =>
			[key, await this.columns[key].values()])));

		this.centre = centre;
		values.rest = values.encoded || values.position;
		if (this.columns.bary.components === 3) /* as the library makes it, not as streams of pages have it */
			values.bary = values.bary.filter((_, i) => i % 3 < 2);
		this.held = PARTS.map((name) => library.put(values[name]));
		const counts = [values.position.length / 3, values.triangles.length / 3, values.height.length],
			parts = library.put(Uint32Array.from([...this.held, ...counts]));
		this.detail = library.had(library.run.detail_new(parts));
		library.free(parts);
		return this;
	}

	/* Poses by the handles' maps. */
	pose(maps) {
		const base = this.posed(maps);

		this.places = { base: centred(base, this.centre), mesh: centred(this.decoded(base), this.centre) };
	}

	/* The base by these maps of the handles. */
	posed(maps) {
		const { position, response } = this.values, { components, steps: { origin } } = this.columns.response,
			handles = components / 4;
		const flat = Float64Array.from({ length: 3 * components }, (_, i) =>
			(maps[Math.floor(i / 12)] || [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])[i % 12]);
		const places = [position, response, Float64Array.from(origin), flat, position].map((values) =>
			library.put(values));

		library.run.pose_by_response(places[0], position.length / 3, places[1], handles, ...places.slice(2));
		const out = library.get(Float64Array, places[4], position.length);
		library.free(...places);
		return out;
	}

	/* The mesh over the base at p. */
	decoded(p) {
		const base = library.put(p), mesh = library.take(24 * this.values.height.length);

		library.had(library.run.detail_decode(this.detail, base, mesh));
		const out = library.get(Float64Array, mesh, 3 * this.values.height.length);
		library.free(base, mesh);
		return out;
	}

	end() {
		library.run.detail_free(this.detail);
		library.free(...this.held);
	}
}
