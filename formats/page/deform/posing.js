/* posing.js -- handles to drag, and the line of commands below them. */
import { library } from "../library/compile.js";
import { regionColor, regionName } from "../draw/colors.js";
import { Poser, canSolve, posedBy, solve } from "./poser.js";
import { HANDLE, poseOf } from "./handles.js";
import { columnOf, fileOf, ownRegion, streamOf } from "../stream/stream.js";
import { copy } from "../stream/text.js";

const $ = (id) => document.getElementById(id);
const FAR = 60; /* degrees beyond which mr-decode warns */

export class Posing {
	constructor(app) {
		Object.assign(this, { app, canSolve, solve });
		this.handle = null;
		this.moved = false; /* whether what is drawn is the deformer's */
		this.listen();
	}

	listen() {
		const { gizmo } = this.app.stage;

		Object.assign(gizmo, {
			began: () => {
				this.pose.remember();
				this.dragged = true;
				this.hint();
			},
			moved: (to) => this.drag(to),
			ended: () => {
				this.pose.settle();
				this.show();
			},
		});
		for (const mode of ["move", "turn", "scale"])
			$(mode).addEventListener("change", () => {
				gizmo.mode(mode);
				this.hint();
			});
		$("undo").addEventListener("click", () => this.act(() => this.pose.undo()));
		$("redo").addEventListener("click", () => this.act(() => this.pose.redo()));
		$("reset").addEventListener("click", () => this.act(() => this.pose.set([])));
		$("copy").addEventListener("click", () => copy($("line")));
	}

	/* Makes what the frame can be posed by, where that is another than before. */
	async load(frame, centre) {
		const columns = posedBy(frame);

		if (!this.suits(frame, centre))
			await this.begin(frame, columns, centre);
		const start = columns && (columnOf(frame, "handles", "transform") || columns.region ||
			columns.response);
		if (start !== this.start && this.deformer) {
			this.pose = await poseOf(frame, columns.region || ownRegion(frame, "mesh"));
			this.handle = this.pose.numbers.length && !frame.film ? this.pose.numbers[0] : null;
			this.apply();
		}
		this.start = start;
		const name = fileOf(frame), made = frame.solved ? "sh " + name + ".sh " + name + ".mrs && " : "";
		$("whole").textContent = made + "mr-cat " + streamOf(frame) + " | … | mr-export posed.ply";
		$("pose").hidden = !this.pose || this.pose.numbers.length === 0;
	}

	/* Whether what it was made for is of this frame. */
	suits(frame, centre) {
		const columns = posedBy(frame);

		return Boolean(columns && this.deformer && centre === this.centre && this.deformer.isOf(columns));
	}

	/* Layers that are drawn anew are posed again, unless the frame is another. */
	drawAgain(frame, centre) {
		this.moved = this.moved && this.suits(frame, centre);
		this.draw();
	}

	async begin(frame, columns, centre) {
		cancelAnimationFrame(this.asked);
		this.asked = 0;
		if (this.deformer && !this.deformer.columns.region) /* what was solved for, its frame keeps */
			this.deformer.end();
		this.moved = false;
		this.start = this.next = this.pose = this.handle = this.deformer = null;
		this.centre = centre;
		if (columns)
			this.deformer = columns.region ? frame.solved : library.had(await new Poser(columns).prepare());
		this.show();
	}

	/* Brings everything to the pose as it is. */
	apply() {
		const maps = this.pose.maps();

		if (this.moved || maps.some((map) => map.some((x, i) => x !== (i % 5 ? 0 : 1))))
			this.deform(maps);
		this.show();
	}

	/* Poses by these maps in the next picture: the hand may be faster. */
	deform(maps) {
		this.next = maps;
		this.moved = true;
		$("poseline").setAttribute("aria-busy", "true");
		this.ask();
	}

	ask() {
		this.asked = this.asked || requestAnimationFrame(() => this.turn());
	}

	turn() {
		this.asked = 0;
		if (this.next && this.moved)
			this.deformer.pose(this.next, this.centre);
		this.next = null;
		this.draw();
		$("poseline").removeAttribute("aria-busy");
	}

	act(change) {
		change();
		this.apply();
	}

	drag(to) {
		this.pose.drag(this.handle, to);
		this.deform(this.pose.maps());
		this.showLine();
	}

	/* Where the vertices of a layer are, around the centre, as posed; null: where the stream has them. */
	placesOf(name) {
		return (this.moved && this.deformer && this.deformer.places[name]) || null;
	}

	/* The layers to be seen. */
	draw() {
		for (const [name, drawn] of this.app.stage.layers)
			if (this.placesOf(name))
				drawn.move(this.placesOf(name));
		this.app.stage.draw();
	}

	/* Chooses the handle that a picked vertex is of. */
	async take(frame, { name, vertex }) {
		const region = this.pose && ownRegion(frame, name);

		if (region)
			this.choose((await region.values())[vertex] - HANDLE);
	}

	choose(handle) {
		if (!this.pose || !this.pose.numbers.includes(handle))
			return false;
		this.handle = handle;
		this.show();
		return true;
	}

	release() {
		this.handle = null;
		this.show();
	}

	show() {
		const { gizmo } = this.app.stage, there = this.pose && this.handle !== null;

		gizmo.show(there ? this.pose.grip(this.handle) : null, this.centre);
		this.hint();
		this.showLine();
		if (!this.pose)
			return;
		$("handles").replaceChildren(...this.pose.numbers.map((h) => this.chip(h)));
		$("modes").hidden = !there;
		$("undo").disabled = this.pose.past.length === 0;
		$("redo").disabled = this.pose.future.length === 0;
		$("reset").disabled = this.pose.line() === "";
	}

	/* The hint at the gizmo, until the first drag. */
	hint() {
		$("hint").hidden = this.dragged || !this.app.stage.gizmo.there;
		$("hint").textContent = "drag to " + document.querySelector("input[name=mode]:checked").id;
	}

	chip(handle) {
		const chip = document.createElement("button"), swatch = document.createElement("i");

		swatch.style.background = "rgb(" + regionColor(handle + HANDLE).join(",") + ")";
		chip.append(swatch, regionName(handle + HANDLE));
		chip.setAttribute("aria-pressed", handle === this.handle);
		chip.addEventListener("click", () => (handle === this.handle ? this.release() : this.choose(handle)));
		return chip;
	}

	showLine() {
		const degrees = this.pose ? this.pose.degrees() : 0, line = this.pose ? this.pose.line() : "";

		$("line").textContent = line;
		$("poseline").hidden = line === "";
		$("far").hidden = degrees <= FAR * (1 + 1e-9);
		$("degrees").textContent = degrees.toFixed(0);
	}
}
