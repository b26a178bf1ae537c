/* app.js -- the page at work: what the user has chosen, and the stage and side brought to it.  All changes go through
 * change(), and a picture that is overtaken by another change is not waited for. */
import { colour } from "./coloring.js";
import { Drawn } from "./draw/drawn.js";
import { Pictures } from "./draw/pictures.js";
import { firstLayer, layersOf } from "./stream/layers.js";
import { setLevel, showLevel } from "./mesh/levels.js";
import { bring } from "./mesh/models.js";
import { hitAt } from "./draw/pick.js";
import { rowsOf, tell } from "./picked.js";
import { Painter } from "./paint/painter.js";
import { Posing } from "./deform/posing.js";
import { listLayers, offerShading, showName } from "./side.js";
import { Stage } from "./draw/stage.js";
import { linesOf } from "./stream/stream.js";
import { boxOf, centred, centreOf } from "./mesh/surface.js";

const $ = (id) => document.getElementById(id);
const QUARTER = [0.5, 0.35, 1];

export class App {
	/* pictures: the bytes of each. */
	constructor(frames, pictures) {
		this.frames = frames;
		this.stage = new Stage($("canvas"));
		this.pictures = new Pictures(pictures, this.stage.renderer);
		this.choice = { frame: 0, visible: null, level: null, flat: false, wire: false, ground: false,
			color: null, range: null };
		this.drawn = new Map(); /* layer: { position, triangles, drawn } */
		this.group = null; /* the key frame that camera and centre are of */
		this.color = ""; /* the column of the colours; none */
		this.picked = null;
		this.telling = 0;
		this.painter = new Painter(this);
		this.posing = new Posing(this);
	}

	/* Takes other choices, and is done when the page shows them, or later ones. */
	change(choice) {
		Object.assign(this.choice, choice);
		this.asked = true;
		this.working = this.working || this.work();
		return this.working;
	}

	async work() {
		document.body.setAttribute("aria-busy", "true");
		try {
			while (this.asked) {
				this.asked = false;
				await this.refresh();
			}
		} finally {
			this.working = null;
			document.body.removeAttribute("aria-busy");
		}
	}

	async refresh() {
		const frame = this.frames[this.choice.frame];

		await bring(frame, this.frames);
		setLevel(frame, this.choice.level);
		this.painter.dress(frame);
		const layers = layersOf(frame);
		showLevel(frame);
		showName(frame, await linesOf(frame, "", "history"), await linesOf(frame, "", "findings"));
		const visible = await this.visible(frame, layers), seen = layers.filter((l) => visible.has(l.name));
		listLayers(layers, visible, (name, on) => this.turn(name, on));
		offerShading(seen);
		await this.load(frame, seen.length ? seen : layers);
		const side = { frame, layers: seen, drawn: this.drawn };
		this.color = await colour(side, this.choice, this.pictures);
		for (const { name } of seen)
			this.drawn.get(name).drawn.look(this.choice.flat, this.choice.wire);
		this.stage.lay(this.choice.ground && this.box());
		this.stage.show(seen.map((l) => [l.name, this.drawn.get(l.name).drawn]));
		this.posing.drawAgain(frame, this.centre);
		$("message").textContent = this.nothing(layers, seen);
		this.shown = { frame, seen };
		await this.posing.load(frame, this.centre);
		await this.painter.meet(frame, layers, visible);
		await this.tellPicked();
	}

	/* The layers that are switched on; at first, and of another model that has none of them, the one that comes
	 * first. */
	async visible(frame, layers) {
		const { visible } = this.choice, there = visible && layers.some((l) => visible.has(l.name));

		if (layers.length && !there && (!visible || this.group !== frame.group))
			this.choice.visible = new Set([await firstLayer(frame, layers)]);
		return this.choice.visible || new Set();
	}

	nothing(layers, seen) {
		if (layers.length === 0)
			return "This frame has neither a surface nor points.";
		if (seen.length === 0)
			return "No layer is switched on.";
		return seen.every((l) => l.position.rows === 0) ? "There is no vertex in this layer." : "";
	}

	turn(name, on) {
		const visible = new Set(this.choice.visible);

		if (on)
			visible.add(name);
		else
			visible.delete(name);
		return this.change({ visible });
	}

	/* Makes what is drawn of layers that are new or other than before; of another key frame all is made anew. */
	async load(frame, layers) {
		const fresh = this.group !== frame.group, first = this.group === null;

		if (fresh && layers.length) {
			this.group = frame.group;
			this.choice.range = null;
			this.picked = null;
			this.centre = centreOf(boxOf(await layers[0].position.values()) ||
				{ low: [0, 0, 0], high: [0, 0, 0] });
			this.clear();
		}
		for (const layer of layers)
			await this.make(layer);
		if (fresh && layers.length)
			this.fit(first ? QUARTER : undefined);
	}

	clear() {
		for (const { drawn } of this.drawn.values())
			drawn.dispose();
		this.drawn.clear();
	}

	async make(layer) {
		const old = this.drawn.get(layer.name);

		if (old && old.position === layer.position && old.triangles === layer.triangles)
			return;
		const values = await layer.position.values(), position = centred(values, this.centre),
			box = boxOf(position);
		const extent = box ? Math.hypot(...box.low.map((x, c) => box.high[c] - x)) : 0;
		const triangles = layer.triangles && layer.triangles.rows ? await layer.triangles.values() : null;
		const normal = !triangles && layer.normal ? await layer.normal.values() : null;
		const drawn = new Drawn(position, triangles, normal, extent, old && old.drawn);
		if (old)
			old.drawn.dispose(drawn);
		this.drawn.set(layer.name, { position: layer.position, triangles: layer.triangles, box, drawn });
	}

	/* Of the layers that are switched on. */
	boxes() {
		const visible = this.choice.visible || new Set();

		return [...this.drawn].filter(([name]) => visible.has(name)).map(([, d]) => d.box).filter(Boolean);
	}

	/* The box of all layers shown; null if none is. */
	box() {
		const boxes = this.boxes();

		return boxes.length ? {
			low: boxes[0].low.map((_, c) => Math.min(...boxes.map((b) => b.low[c]))),
			high: boxes[0].high.map((_, c) => Math.max(...boxes.map((b) => b.high[c]))),
		} : null;
	}

	/* All that is seen in view. */
	fit(from) {
		if (this.box())
			this.stage.fit(this.box(), from);
	}

	/* The vertex under a place of the window. */
	async pick(clientX, clientY) {
		const ray = this.stage.rayAt(clientX, clientY);

		if (this.stage.gizmo.busy)
			return;
		this.picked = ray && hitAt(ray, this.stage.layers);
		if (this.picked)
			await this.posing.take(this.shown.frame, this.picked);
		await this.tellPicked();
	}

	forget() {
		this.picked = null;
		this.posing.release();
		return this.tellPicked();
	}

	/* Marks a vertex of a layer; null: none. */
	mark(layer, picked) {
		for (const [name, { drawn }] of this.drawn)
			drawn.pointTo(layer && name === layer.name ? picked.vertex : null);
		this.stage.ask();
	}

	/* Marks what was picked, as long as it is there, and says what it is, unless something else is picked
	 * meanwhile. */
	async tellPicked() {
		const picked = this.picked, turn = ++this.telling, { frame, seen } = this.shown;
		const layer = picked && seen.find((l) => l.name === picked.name && l.position.rows > picked.vertex);
		const there = layer && (picked.face === null ||
			(layer.triangles && layer.triangles.rows > picked.face));

		this.mark(there ? layer : null, picked);
		$("picked").setAttribute("aria-busy", "true");
		const rows = there ? await rowsOf(frame, layer, picked, this.centre,
			this.drawn.get(layer.name).drawn.extent, this.color, this.posing.placesOf(layer.name)) : [];
		if (turn !== this.telling)
			return;
		tell($("picked"), rows);
		$("picked").removeAttribute("aria-busy");
	}
}
