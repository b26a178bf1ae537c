/* levels.js -- the displaced subdivision surface of a frame, as mr-decode makes it: a layer that the page's text names,
 * whose columns are computed when they are asked for, on the level that is chosen. */
import { Made } from "../stream/codec.js";
import { library } from "../library/compile.js";
import { columnOf, keyOf } from "../stream/stream.js";

const HEIGHTS = "displacement";

/* The first rows of a column: those of a coarser level. */
const firstRows = (column, layer, rows) => new Made(layer, column.name,
	{ element: column.element, type: column.type, components: column.components, rows },
	async () => (await column.values()).subarray(0, rows * column.components));

/* The surface over one control mesh with one set of heights; other frames may have the same. */
class Surface {
	/* vertices: how many each level has. */
	constructor(layer, vertices, parts) {
		this.layer = layer;
		this.vertices = vertices;
		this.most = vertices.length - 1;
		this.parts = parts;
		this.columns = []; /* of each level, those that have been asked for */
	}

	/* The levels in the library's memory. */
	async begin() {
		const { position, triangles, crease } = this.parts;
		const [p, t, c] = await Promise.all([position.values(), triangles.values(), crease && crease.values()]);

		return library.had(library.run.levels_new(library.put(p), position.rows, library.put(t), triangles.rows,
			library.put(c)));
	}

	/* Makes this level, where it is not there: { levels, at }, and its triangles there. */
	async make(level) {
		this.levels = this.levels || this.begin();
		const levels = await this.levels;
		return { levels, at: library.had(library.run.levels_triangles(levels, level)) };
	}

	async triangles(level) {
		return library.get(Uint32Array, (await this.make(level)).at,
			3 * this.parts.triangles.rows * 4 ** level);
	}

	/* Over the control mesh at p. */
	async positionsOver(level, p) {
		const height = (await this.parts.height.values()).subarray(0, this.vertices[level]);
		const { levels } = await this.make(level), places = [library.put(p), library.put(height),
			library.take(24 * height.length)];

		library.run.levels_displaced(levels, level, ...places);
		const out = library.get(Float64Array, places[2], 3 * height.length);
		library.free(...places);
		return out;
	}

	/* The columns of a level. */
	at(level) {
		this.columns[level] = this.columns[level] || {
			position: new Made(this.layer, "position",
				{ element: "v", type: "d", components: 3, rows: this.vertices[level] },
				async () => this.positionsOver(level, await this.parts.position.values())),
			triangles: new Made(this.layer, "triangles",
				{ element: "f", type: "u", components: 3,
					rows: this.parts.triangles.rows * 4 ** level },
				() => this.triangles(level)),
			others: new Map(),
		};
		return this.columns[level];
	}

	/* What a column of the stream has of a level: the first of the vertices, all of the faces; undefined where it
	 * has not that. */
	partOf(column, level) {
		const { others, position, triangles } = this.at(level), { element } = column,
			{ rows } = element === "f" ? triangles : position;

		if (element === "f" ? column.rows !== rows : element !== "v" || column.rows < rows)
			return undefined;
		if (!others.has(column))
			others.set(column, firstRows(column, this.layer, rows));
		return others.get(column);
	}
}

const surfaces = [];

/* The surface of these parts, which frames of a film may share. */
function surfaceOver(layer, vertices, parts) {
	const same = surfaces.find((s) => s.layer === layer && s.most === vertices.length - 1 &&
		Object.keys(parts).every((name) => s.parts[name] === parts[name]));

	if (!same)
		surfaces.push(new Surface(layer, vertices, parts));
	return same || surfaces[surfaces.length - 1];
}

/* Gives a frame the surface that the page's text tells of, if it does. */
export function addLevels(frame) {
	const { layer, vertices } = frame.displaced || {};
	const parts = { height: columnOf(frame, HEIGHTS, "height") };

	if (!frame.displaced)
		return;
	for (const name of ["position", "triangles", "crease"])
		parts[name] = columnOf(frame, "control", name);
	const others = [...frame.columns.values()].filter((c) => c.layer === HEIGHTS || c.layer === layer);
	frame.levels = { surface: surfaceOver(layer, vertices, parts), others };
	setLevel(frame, null);
}

/* Puts the frame's surface, where it has one, onto a level, or the nearest that it has; null: the finest. */
export function setLevel(frame, level) {
	const { surface, others, at: before } = frame.levels || {}, at = surface &&
		(level === null ? surface.most : Math.min(level, surface.most));

	if (!surface || at === before)
		return;
	frame.levels.at = at;
	for (const [key, column] of frame.columns)
		if (column.layer === surface.layer)
			frame.columns.delete(key);
	const { position, triangles } = surface.at(at);
	for (const column of [position, triangles, ...others.map((c) => surface.partOf(c, at))])
		if (column)
			frame.columns.set(keyOf(column.layer, column.name), column);
}

const $ = (id) => document.getElementById(id);

/* The slider of the levels, of a frame that has some to choose from. */
export function showLevel(frame) {
	const most = frame.levels ? frame.levels.surface.most : 0;

	$("levels").hidden = most === 0;
	if (most === 0)
		return;
	$("level").max = most;
	$("level").value = frame.levels.at;
	$("level-is").textContent = frame.levels.at + " of " + most;
}
