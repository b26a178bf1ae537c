/* models.js -- the choice between the models of the page, each of which is shown at its first frame. */
import { linesOf, titleOf } from "./stream/stream.js";
import { element } from "./stream/text.js";

const $ = (id) => document.getElementById(id);

/* Names of models; of those with one title by what was done to them. */
async function namesOf(models) {
	const histories = await Promise.all(models.map((frame) => linesOf(frame, "", "history"))),
		titles = models.map(titleOf);

	return titles.map((title, i) => {
		const alike = histories.filter((_, k) => titles[k] === title), lines = histories[i];
		const tool = (lines[lines.length - 1] || "").match(/mr-(\w+)/);
		if (alike.length < 2 || !tool)
			return title;
		return title + ": " + (lines.some((line) => line.includes("mr-pose")) ? "bent" :
			lines.length === Math.min(...alike.map((other) => other.length)) ? "original" : tool[1]);
	});
}

/* go(i): shows frame i. */
export async function listModels(frames, go) {
	const models = frames.filter((frame, i) => frame.group === i);

	$("models").hidden = models.length < 2;
	$("model").replaceChildren(...(await namesOf(models)).map((name, i) => Object.assign(element("option", name),
		{ value: models[i].group })));
	$("model").addEventListener("change", () => go(Number($("model").value)));
}

/* The model before or behind the one that is shown. */
export function stepModel(by) {
	const { options } = $("model");

	$("model").selectedIndex = ($("model").selectedIndex + by + options.length) % options.length;
	$("model").dispatchEvent(new Event("change"));
}
