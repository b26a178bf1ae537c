/*
 * displaced.js -- a control mesh as its handles pose it, by its response to them, lib/edit/pose_basis.c, and the
 * displaced surface over it on the level that is shown, as mr-decode makes it: few vertices are posed, and then
 * subdivided (mesh/levels.js).
 */
import { Poser, columnsOf, flat } from "./deformer.js";
import { library } from "../library/compile.js";

/* The columns that it is made of; null where the frame has not all of them. */
export function controlOf(frame) {
	const columns = columnsOf(frame, { position: "control position", triangles: "control triangles",
		response: "control response",
		region: "control region", height: "displacement height" });

	return frame.levels && columns.response ? columns : null;
}

const less = (position, centre) => Float32Array.from(position, (x, i) => x - centre[i % 3]);

export class DisplacedDeformer extends Poser {
	constructor(frame, columns, changed) {
		super(columns, changed);
		this.surface = frame.levels.surface;
	}

	async prepare(centre) {
		this.centre = centre;
		this.position = await this.columns.position.values();
		this.response = await this.columns.response.values();
		return this;
	}

	follow(frame) {
		if (this.level === frame.levels.at)
			return;
		this.level = frame.levels.at;
		this.places = {};
		if (this.maps.length)
			this.pose(this.maps);
	}

	/* The control mesh by these maps of the handles. */
	posed(maps) {
		const { position, response, columns: { response: { components, steps: { origin } } } } = this,
			handles = components / 4;
		const places = [position, response, Float64Array.from(origin), flat(maps, handles),
			position].map((values) => library.put(values));

		library.run.pose_by_response(places[0], position.length / 3, places[1], handles, ...places.slice(2));
		const out = library.get(Float64Array, places[4], position.length);
		library.free(...places);
		return out;
	}

	async compute(maps) {
		const { level, surface, centre } = this, control = this.posed(maps);
		const places = { control: less(control, centre),
			[surface.layer]: less(await surface.positionsOver(level, control), centre) };

		if (level === this.level)
			this.places = places;
	}

	/* The region of the control vertex nearest to where a vertex of the surface is at rest. */
	async regionAt(vertex) {
		const at = (await this.surface.at(this.level).position.values()).subarray(3 * vertex, 3 * vertex + 3),
			p = this.position;
		let best = 0, least = Infinity;

		for (let v = 0; v < p.length / 3; v++) {
			const away = Math.hypot(p[3 * v] - at[0], p[3 * v + 1] - at[1], p[3 * v + 2] - at[2]);
			if (away < least)
				[best, least] = [v, away];
		}
		return (await this.columns.region.values())[best];
	}
}
