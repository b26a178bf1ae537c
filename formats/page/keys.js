/* keys.js -- the keyboard: each key does what a control of the page does. */
import { paintKey } from "./paint/paint_side.js";
import { stepModel } from "./models.js";

const $ = (id) => document.getElementById(id);

function cycle(select) {
	select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
	select.dispatchEvent(new Event("change"));
}

/* A step of the slider of levels. */
function stepLevel(by) {
	if ($("levels").hidden)
		return;
	$("level").stepUp(by);
	$("level").dispatchEvent(new Event("input"));
}

const KEYS = {
	" ": () => $("play").click(),
	ArrowLeft: () => $("before").click(),
	ArrowRight: () => $("after").click(),
	PageUp: () => stepLevel(1),
	PageDown: () => stepLevel(-1),
	c: () => cycle($("color")),
	s: () => document.querySelector("input[name=shade]:not(:checked)").click(),
	e: () => $("wire").click(),
	g: () => $("ground").click(),
	v: () => cycle($("view")),
	f: () => $("fit").click(),
	n: (shift) => stepModel(shift ? -1 : 1),
	m: () => $("move").click(),
	t: () => $("turn").click(),
	x: () => $("scale").click(),
};

/* Typing, and choosing by keys, is the control's own; a slider and a choice have no use for letters. */
function isTyping({ target, key }) {
	return target.matches("select, input:not([type=checkbox], [type=radio], [type=range])") ||
		(target.matches("[type=radio]") && key.startsWith("Arrow")) ||
			(target.matches("[type=range]") && key.length > 1);
}

/* Keys that are not for the page: of the browser, of what is typed into, the space that presses a button. */
function isOthers(event) {
	return event.altKey || isTyping(event) || (event.key === " " && event.target.matches("button, summary, input"));
}

/* With control Z, and Y or shift Z: undo and redo, of what is painted while a tool paints, else of what is dragged. */
function goBack(event, key, painter) {
	if (key !== "z" && key !== "y")
		return false;
	if (paintKey(painter, event.shiftKey ? "y" : key))
		return true;
	if (!$("pose").hidden)
		$(key === "y" || event.shiftKey ? "redo" : "undo").click();
	return !$("pose").hidden;
}

/* The handle of a digit, or the layer where there is no handle. */
function chooseNumber(key, choose) {
	const layer = document.querySelectorAll("#layers input")[key - 1], chosen = /^\d$/.test(key) &&
		choose(Number(key));

	if (!chosen && layer)
		layer.click();
	return chosen || Boolean(layer);
}

/* forget(): Escape; choose(handle): whether there is such a handle; painter: what the keys of painting are for. */
export function listen(forget, choose, painter) {
	/* Whether the key does anything. */
	const act = (event, key) => {
		if (paintKey(painter, key) || chooseNumber(key, choose))
			return true;
		const does = key === "Escape" ? forget : KEYS[key];
		if (does)
			does(event.shiftKey);
		return Boolean(does);
	};

	addEventListener("keydown", (event) => {
		const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;

		if (!isOthers(event) && (event.ctrlKey || event.metaKey ? goBack(event, key, painter) :
			act(event, key)))
			event.preventDefault();
	});
}
