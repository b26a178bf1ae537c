/*
 * strip.js -- a small picture of each model of the page: a click shows its first frame.  Pictures are made one by one while
 * the page has nothing else to do, and only those that are in view.
 */
import { firstLayer, layersOf } from "./stream/layers.js";
import { titleOf } from "./stream/stream.js";
import { element } from "./stream/text.js";
import { Thumbnails } from "./draw/thumbnail.js";

const $ = (id) => document.getElementById(id);

/* Until the browser is idle. */
function idle() {
	return new Promise((done) => (window.requestIdleCallback ? requestIdleCallback(done, { timeout: 500 }) : setTimeout(done, 50)));
}

/* The model before or behind the one that is shown. */
export function stepModel(by) {
	const buttons = [...$("strip").querySelectorAll("button")], at = buttons.findIndex((b) => b.getAttribute("aria-current"));

	if (buttons.length)
		buttons[(at + by + buttons.length) % buttons.length].click();
}

export class Strip {
	/* go(i): shows frame i. */
	constructor(app, go) {
		const models = app.frames.map((_, i) => i).filter((i) => app.frames[i].group === i);

		this.app = app;
		this.buttons = new Map(); /* by the number of the first frame */
		this.wanted = new Set(); /* in view, without a picture */
		if (models.length < 2)
			return;
		for (const i of models)
			this.buttons.set(i, this.button(i, go));
		$("strip").replaceChildren(...this.buttons.values());
		$("strip").hidden = false;
		document.body.classList.add("many");
		this.thumbnails = new Thumbnails(app.stage);
		this.watch();
		$("up").addEventListener("change", () => this.watch());
	}

	button(i, go) {
		const made = document.createElement("button"), canvas = document.createElement("canvas"), name = titleOf(this.app.frames[i]);

		made.append(canvas, element("bdi", name));
		made.title = made.lastChild.textContent;
		made.value = i;
		made.addEventListener("click", () => go(i));
		return made;
	}

	/* Marks the model of this frame, and brings its picture into view. */
	mark(frame) {
		const button = this.buttons.get(this.app.frames[frame].group);

		if (!button || button.getAttribute("aria-current"))
			return;
		for (const other of this.buttons.values())
			other.removeAttribute("aria-current");
		button.setAttribute("aria-current", "true");
		button.scrollIntoView({ block: "nearest", inline: "nearest" });
	}

	/* Asks for the pictures that are in view, now and later; those that are there are made anew. */
	watch() {
		if (this.watcher)
			this.watcher.disconnect();
		this.watcher = new IntersectionObserver((seen) => seen.filter((s) => s.isIntersecting).forEach((s) => this.want(s.target)), { root: $("strip"), rootMargin: "200px" });
		for (const button of this.buttons.values())
			this.watcher.observe(button);
	}

	want(button) {
		this.watcher.unobserve(button);
		this.wanted.add(button);
		this.drawing = this.drawing || this.draw();
	}

	async draw() {
		while (this.wanted.size) {
			const [button] = this.wanted;
			this.wanted.delete(button);
			await this.app.working;
			await idle();
			await this.drawOne(this.app.frames[button.value], button.firstChild);
		}
		this.drawing = null;
	}

	/* A model without a layer has a name alone. */
	async drawOne(frame, canvas) {
		const layers = layersOf(frame);

		if (layers.length === 0)
			return;
		const name = await firstLayer(frame, layers);
		await this.thumbnails.draw(layers.find((l) => l.name === name), canvas);
	}
}
