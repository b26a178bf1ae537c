/*
 * poser.js -- what follows the handles, as mr-decode makes it when nothing moves any more: a base or a control mesh by
 * its response to them, and over it the mesh by its detail (library/detail.c), or the displaced surface on the level
 * that is shown (mesh/levels.js).
 */
import { library } from "../library/compile.js";
import { centred } from "../mesh/surface.js";
import { columnOf } from "../stream/stream.js";

const BASE = { position: "base position", triangles: "base triangles", response: "base response",
	encoded: "base encoded", face: "mesh detail_face", bary: "mesh detail_bary", height: "mesh detail_height",
	offset: "mesh detail_offset" };
const CONTROL = { position: "control position", triangles: "control triangles", response: "control response",
	region: "control region", height: "displacement height" };
const PARTS = ["rest", "triangles", "face", "bary", "height", "offset"]; /* library/detail.c */

/* The columns that the frame can be posed by: of base where it has those, else of control; null: it cannot. */
export function posedBy(frame) {
	for (const named of frame.levels ? [BASE, CONTROL] : [BASE]) {
		const columns = Object.fromEntries(Object.entries(named).map(([key, name]) =>
			[key, columnOf(frame, ...name.split(" "))]));
		if (columns.response && columns.height)
			return columns;
	}
	return null;
}

export class Poser {
	/* columns: that it is made of; changed(): there are other places to be drawn. */
	constructor(frame, columns, changed) {
		Object.assign(this, { columns, changed, places: {}, maps: [], working: false });
		this.surface = columns.face ? null : frame.levels.surface;
		this.level = null; /* of a displaced surface */
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
		if (this.surface)
			return this;
		values.rest = values.encoded || values.position;
		this.held = PARTS.map((name) => library.put(values[name]));
		const counts = [values.position.length / 3, values.triangles.length / 3, values.height.length],
			parts = library.put(Uint32Array.from([...this.held, ...counts]));
		this.detail = library.had(library.run.detail_new(parts));
		library.free(parts);
		return this;
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

	/* Goes to the level of the frame. */
	follow(frame) {
		const level = this.surface && frame.levels.at;

		if (this.level === level)
			return;
		this.level = level;
		this.places = {};
		if (this.maps.length)
			this.pose(this.maps);
	}

	/* The base or the control mesh by these maps of the handles. */
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

	async compute(maps) {
		const { level, surface, centre } = this, p = this.posed(maps);
		const over = surface ? await surface.positionsOver(level, p) : this.decoded(p);

		if (level === this.level)
			this.places = { [surface ? "control" : "base"]: centred(p, centre),
				[surface ? surface.layer : "mesh"]: centred(over, centre) };
	}

	/* The region of the control vertex nearest to where a vertex of the surface is at rest. */
	async regionAt(vertex) {
		const at = (await this.surface.at(this.level).position.values()).subarray(3 * vertex, 3 * vertex + 3),
			p = this.values.position;
		let best = 0, least = Infinity;

		for (let v = 0; v < p.length / 3; v++) {
			const away = Math.hypot(p[3 * v] - at[0], p[3 * v + 1] - at[1], p[3 * v + 2] - at[2]);
			if (away < least)
				[best, least] = [v, away];
		}
		return this.values.region[best];
	}

	end() {
		this.next = null;
		if (this.detail)
			library.run.detail_free(this.detail);
		library.free(...this.held || []);
	}
}
