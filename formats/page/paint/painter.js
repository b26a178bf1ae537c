/* painter.js -- the regions that are painted: of which layer, with which tool, in which region.  A painted column
 * stands in its frames for the stream's, so that colours, legend and cards know no other. */
import { Regions, FIXED, HANDLE } from "./regions.js";
import { regionColor } from "../draw/colors.js";
import { connectPaint, showPaint } from "./paint_side.js";
import { columnOf, ownRegion } from "../stream/stream.js";
import { Strokes } from "./strokes.js";
import { TakeAway } from "./takeaway.js";
import { partOf } from "../mesh/topology.js";

const $ = (id) => document.getElementById(id);
const LAYERS = ["mesh", "control", "points"]; /* those of mr-select, in its order */
const LEAST = 0.002, MOST = 0.5; /* radius of the brush, of the diagonal */

/* The radius that the slider's 0 to 100 stand for, of the diagonal. */
const radiusOf = (size) => LEAST * (MOST / LEAST) ** (size / 100);

/* A column as the stream has them, whose values may change: then so does its version. */
function columnFor(layer, regions) {
	return {
		layer, name: "region", element: "v", type: "u", components: 1, rows: regions.values.length, version: 0,
		values: async () => regions.values,
	};
}

export class Painter {
	constructor(app) {
		this.app = app;
		this.works = []; /* what was painted, or could be, of models of this page */
		this.work = null; /* that of the frame: { name, rows, triangles, group, column, regions, painted } */
		this.tool = null;
		this.region = HANDLE + 1;
		this.size = 50;
		this.strokes = new Strokes(this, app.stage);
		this.takeAway = new TakeAway(this);
		connectPaint(this);
	}

	/* Whether the work is of what the frame has: the same vertices, by their triangles, or points of the same
	 * frames. */
	fits(work, frame) {
		const position = columnOf(frame, work.name, "position"),
			triangles = columnOf(frame, work.name, "triangles");

		return Boolean(position) && position.rows === work.rows && triangles === work.triangles &&
			ownRegion(frame, work.name) === work.column.origin &&
			(triangles || frame.group === work.group);
	}

	/* Puts what was painted into the frame. */
	dress(frame) {
		for (const work of this.works)
			if (work.painted && this.fits(work, frame))
				frame.columns.set(work.name + "\0region", work.column);
	}

	/* Takes up the frame's work: of the layer that is seen of those that have regions, else the first. */
	async meet(frame, layers, visible) {
		const found = LAYERS.map((name) => layers.find((l) => l.name === name)).filter((l) => l &&
			l.position.rows > 0);
		const layer = found.find((l) => visible.has(l.name)) || found[0] || null;
		const work = layer && await this.workOf(frame, layer);

		if (work !== this.work)
			this.strokes.cancel();
		this.work = work;
		this.layer = layer;
		showPaint(this);
	}

	/* The work on a layer, as it was left, or that begins with the regions of the stream. */
	async workOf(frame, { name, position, triangles }) {
		const there = this.works.find((w) => w.name === name && this.fits(w, frame)),
			origin = ownRegion(frame, name);

		if (there)
			return there;
		const regions = new Regions(origin && origin.element === "v" && origin.type === "u" ?
			await origin.values() : null, position.rows);
		const work = { name, rows: position.rows, triangles, group: frame.group, regions,
			column: { ...columnFor(name, regions), origin }, painted: false };
		this.works.push(work);
		return work;
	}

	/* What is drawn of the layer; undefined where it is not seen. */
	get drawn() {
		const there = this.work && this.app.shown.seen.some((l) => l.name === this.work.name) &&
			this.app.drawn.get(this.work.name);

		return there ? there.drawn : undefined;
	}

	/* The radius of the brush, as a share of the diagonal and as a length. */
	get share() {
		return radiusOf(this.size);
	}

	get radius() {
		return this.share * (this.drawn ? this.drawn.extent : 0);
	}

	/* Brings the layer and its regions into view. */
	show() {
		const { visible } = this.app.choice;

		if (!this.work)
			return Promise.resolve();
		this.work.painted = true;
		return this.app.change({ visible: visible.has(this.work.name) ? visible : new Set([this.work.name]),
			color: "region" });
	}

	choose(tool) {
		this.tool = this.work ? tool : null;
		this.strokes.heed(this.tool !== null);
		showPaint(this);
		return this.tool ? this.show() : Promise.resolve();
	}

	/* Drops a stroke that is being made; without one, the tool. */
	leave() {
		return this.strokes.stroke ? this.strokes.cancel() : this.choose(null);
	}

	take(region) {
		this.region = region;
		showPaint(this);
	}

	resize(size) {
		this.size = Math.min(Math.max(size, 0), 100);
		showPaint(this);
	}

	/* Shows at once that these vertices are of the region now. */
	changed(vertices) {
		const { drawn, work } = this;

		work.column.version++;
		if (drawn && this.app.color === "region") {
			drawn.repaint(vertices, regionColor(this.region));
			drawn.painted = null;
		}
		this.app.stage.ask();
		showPaint(this);
	}

	/* Shows it everywhere, when a change is done; changes: whether there is any. */
	done(changes) {
		this.work.column.version++;
		showPaint(this);
		return changes || !this.work.painted ? this.show() : Promise.resolve();
	}

	/* From painting to dragging: the regions, as they are now, become those that handles are of. */
	async drag() {
		const { work, app } = this, own = columnFor(work.name, { values: work.regions.values.slice() });

		$("message").textContent = "Solving…";
		await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
		const solved = await app.posing.solve(app.shown.frame, own);
		$("unsolved").hidden = solved;
		if (solved) {
			work.column.origin = own;
			await this.choose(null);
		}
		await app.change({ color: "region" });
	}

	/* Clear, fill: `what` names it. */
	async edit(what) {
		const { work, region } = this;

		if (work && !work.regions.before && (what !== "clear" || region !== FIXED))
			await this.done(work.regions[what](region));
	}

	/* Takes back the last change, or takes back that. */
	back(forth) {
		if (!this.work || this.work.regions.before)
			return Promise.resolve();
		const { regions } = this.work;
		return this.done(forth ? regions.redo() : regions.undo());
	}

	/* Paints the connected part that has the vertex. */
	part(vertex) {
		const { regions } = this.work, t = this.drawn.triangles;

		regions.begin();
		regions.set(partOf(t, this.work.rows, vertex), this.region);
		return this.done(regions.end());
	}
}
