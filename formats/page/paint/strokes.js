/* strokes.js -- painting by mouse, pen or finger: a brush over the surface, a click on a connected part.  Meanwhile the
 * right button or two fingers turn the model, and so does a stroke that begins beside it. */
import * as THREE from "three/build/three.module.js";
import { hitAt } from "../draw/pick.js";

const $ = (id) => document.getElementById(id);

/* The points in a ball. */
function ball(p, place, radius) {
	const out = [];

	for (let i = 0; i < p.length; i += 3)
		if ((p[i] - place[0]) ** 2 + (p[i + 1] - place[1]) ** 2 + (p[i + 2] - place[2]) ** 2 <= radius * radius)
			out.push(i / 3);
	return out;
}

export class Strokes {
	constructor(painter, stage) {
		this.painter = painter;
		this.stage = stage;
		this.on = false;
		this.stroke = null; /* { id, last } */
		const canvas = stage.canvas;
		canvas.addEventListener("pointerdown", (e) => this.down(e));
		canvas.addEventListener("pointermove", (e) => this.move(e));
		canvas.addEventListener("pointerup", (e) => this.up(e));
		canvas.addEventListener("pointercancel", () => this.cancel());
		canvas.addEventListener("pointerleave", () => ($("ring").hidden = true));
	}

	/* Whether the left button paints. */
	heed(on) {
		this.on = on;
		this.cancel();
		this.lead(!on);
		this.stage.gizmo.offer(!on);
		$("ring").hidden = true;
		this.stage.canvas.classList.toggle("paints", on);
	}

	/* Whether the left button, or one finger, turns the model. */
	lead(turns) {
		const { controls } = this.stage, paints = this.on;

		controls.mouseButtons.LEFT = turns ? THREE.MOUSE.ROTATE : -1;
		controls.mouseButtons.RIGHT = paints ? THREE.MOUSE.ROTATE : THREE.MOUSE.PAN;
		controls.touches.ONE = turns ? THREE.TOUCH.ROTATE : -1;
		controls.touches.TWO = paints ? THREE.TOUCH.DOLLY_ROTATE : THREE.TOUCH.DOLLY_PAN;
	}

	/* What of the layer is under a place of the window; null: nothing. */
	hit(clientX, clientY) {
		const ray = this.stage.rayAt(clientX, clientY), { drawn } = this.painter;

		return ray && drawn ? hitAt(ray, [["", drawn]]) : null;
	}

	down(e) {
		if (!this.on)
			return;
		if (this.stroke || !e.isPrimary || e.button !== 0) {
			this.cancel();
			return;
		}
		const found = this.hit(e.clientX, e.clientY), { tool } = this.painter;

		this.lead(!found);
		if (!found)
			return;
		this.stage.canvas.setPointerCapture(e.pointerId);
		if (tool === "brush") {
			this.painter.work.regions.begin();
			this.stroke = { id: e.pointerId, last: [e.clientX, e.clientY] };
			this.brush(e.clientX, e.clientY);
		} else if (found.face !== null)
			this.painter.part(found.vertex);
	}

	move(e) {
		if (this.on && this.painter.tool === "brush")
			this.drawRing(e.clientX, e.clientY);
		if (!this.stroke || e.pointerId !== this.stroke.id)
			return;
		this.brushTo(e.clientX, e.clientY);
	}

	/* Discs close enough to each other that the stroke has no notches. */
	brushTo(x, y) {
		const [x0, y0] = this.stroke.last, ray = this.stage.rayAt(x, y);
		const step = Math.max(ray ? this.stage.pixels(ray, this.painter.radius) / 3 : 0, 2);
		const n = Math.ceil(Math.hypot(x - x0, y - y0) / step);

		for (let i = 1; i <= n; i++)
			this.brush(x0 + (x - x0) * i / n, y0 + (y - y0) * i / n);
		this.stroke.last = [x, y];
	}

	brush(x, y) {
		const { painter } = this, found = this.hit(x, y);

		if (!found)
			return;
		const { position, solid } = painter.drawn;
		const disc = solid ? solid.disc(found.face, found.at, painter.radius) :
			ball(position, found.at, painter.radius);
		const changed = painter.work.regions.set(disc, painter.region);
		if (changed.length)
			painter.changed(changed);
	}

	up(e) {
		const { painter, stroke } = this;

		this.lead(!this.on);
		if (!stroke || e.pointerId !== stroke.id)
			return;
		this.stroke = null;
		painter.done(painter.work.regions.end());
	}

	/* As if the stroke had not begun: a second finger came, or another tool or model. */
	cancel() {
		const { work } = this.painter;

		if (!this.stroke)
			return;
		this.stroke = null;
		work.regions.cancel();
		this.painter.done(true);
	}

	/* A circle about as large as the brush is there. */
	drawRing(clientX, clientY) {
		const box = $("stage").getBoundingClientRect(), ray = this.stage.rayAt(clientX, clientY),
			ring = $("ring");

		ring.hidden = !ray || !this.painter.drawn;
		if (ring.hidden)
			return;
		const size = 2 * this.stage.pixels(ray, this.painter.radius);
		ring.style.width = ring.style.height = size + "px";
		ring.style.left = clientX - box.left - size / 2 + "px";
		ring.style.top = clientY - box.top - size / 2 + "px";
	}
}
