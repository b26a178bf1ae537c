/* models.js -- the choice between the models of the page, each of which is shown at its first frame. */
import { titleOf } from "./stream/stream.js";
import { element } from "./stream/text.js";

const $ = (id) => document.getElementById(id);

/* go(i): shows frame i. */
export function listModels(frames, go) {
	const models = frames.map((_, i) => i).filter((i) => frames[i].group === i);

	$("models").hidden = models.length < 2;
	$("model").replaceChildren(...models.map((i) => Object.assign(element("option", titleOf(frames[i])),
		{ value: i })));
	$("model").addEventListener("change", () => go(Number($("model").value)));
}

/* The model before or behind the one that is shown. */
export function stepModel(by) {
	const { options } = $("model");

	$("model").selectedIndex = ($("model").selectedIndex + by + options.length) % options.length;
	$("model").dispatchEvent(new Event("change"));
}
