/* poser.js -- what follows the handles, as mr-decode makes it when nothing moves any more: the base by its response to
 * them, and over it the mesh by its detail (library/posable.c). */
import { library } from "../library/compile.js";
import { centred } from "../mesh/surface.js";
import { columnOf } from "../stream/stream.js";

const STREAM = { position: "base position", rest: "base encoded", triangles: "base triangles",
	response: "base response", face: "mesh detail_face", bary: "mesh detail_bary", height: "mesh detail_height",
	offset: "mesh detail_offset" };
const PAINTED = { position: "base position", triangles: "base triangles", mesh: "mesh position",
	faces: "mesh triangles" };
const PARTS = ["position", "rest", "triangles", "response", "origin", "face", "bary", "height", "offset", "mesh",
	"faces", "region"]; /* library/posable.c */
const MOST = 50000; /* vertices to solve for: a few seconds */
const FREE = 1, REST = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

const columnsOf = (frame, names) => Object.fromEntries(Object.entries(names).map(([key, name]) =>
	[key, columnOf(frame, ...name.split(" "))]));

/* The columns that the frame can be posed by, or that were solved for on this level; null: it cannot. */
export function posedBy(frame) {
	const columns = columnsOf(frame, STREAM), { solved } = frame;

	if (solved && solved.columns.mesh === columnOf(frame, "mesh", "position"))
		return solved.columns;
	return columns.response && columns.height ? columns : null;
}

/* Whether the page can solve for what was painted (painter.js). */
export function canSolve(frame, { name, triangles, regions: { counts } }) {
	const { position, mesh } = columnsOf(frame, PAINTED);

	return name === "mesh" && Boolean(triangles) && (position || mesh).rows <= MOST && !frame.film &&
		!columnOf(frame, "handles", "transform") && counts.get(FREE) > 0 &&
		[...counts].some(([region, n]) => region > FREE && n > 0);
}

/* Solves for handles that these regions have; false: a part of the model is not held, or memory is short. */
export async function solve(frame, region) {
	const poser = await new Poser({ ...columnsOf(frame, PAINTED), region }).prepare();

	if (poser && frame.solved)
		frame.solved.end();
	if (poser)
		Object.assign(frame, { solved: poser });
	return Boolean(poser);
}

export class Poser {
	/* columns: that it is made of. */
	constructor(columns) {
		this.columns = columns;
		this.places = {}; /* of each layer */
	}

	/* Whether it is made of these. */
	isOf(columns) {
		return Object.keys({ ...columns, ...this.columns }).every((key) => columns[key] === this.columns[key]);
	}

	/* Reads the columns; null where nothing can be made of them. */
	async prepare() {
		const { position, triangles, response, height, mesh, faces } = this.columns;
		const values = await Promise.all(PARTS.map((key) => this.columns[key] && this.columns[key].values()));

		values[PARTS.indexOf("origin")] = Float64Array.from(response ? response.steps.origin : [0, 0, 0]);
		this.held = values.map((array) => library.put(array));
		const counts = [position, triangles, height || mesh, faces].map((c) => (c ? c.rows : 0));
		const handles = response ? response.components / 4 : 0;
		const parts = library.put(Uint32Array.of(...this.held, ...counts, handles));
		this.at = library.run.posable_new(parts) >>> 0;
		library.free(parts);
		if (!this.at)
			library.free(...this.held);
		return this.at ? this : null;
	}

	/* Poses by the handles' maps; places are around the centre. */
	pose(maps, centre) {
		const [base, mesh, nv, n, handles] = library.get(Uint32Array, this.at, 5);
		const flat = library.put(Float64Array.from({ length: 12 * handles }, (_, i) =>
			(maps[Math.floor(i / 12)] || REST)[i % 12]));

		library.had(library.run.posable_pose(this.at, flat));
		library.free(flat);
		this.places = { base: centred(library.get(Float64Array, base, 3 * nv), centre),
			mesh: centred(library.get(Float64Array, mesh, 3 * n), centre) };
	}

	end() {
		library.run.posable_free(this.at);
		library.free(...this.held);
	}
}
