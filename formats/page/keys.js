/* keys.js -- the keyboard: each key does what a control of the page does. */
const $ = (id) => document.getElementById(id);

function cycle(select) {
	select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
	select.dispatchEvent(new Event("change"));
}

const KEYS = {
	" ": () => $("play").click(),
	ArrowLeft: () => $("before").click(),
	ArrowRight: () => $("after").click(),
	b: () => $("besides").hidden || $("beside").click(),
	c: () => cycle($("color")),
	s: () => document.querySelector("input[name=shade]:not(:checked)").click(),
	e: () => $("wire").click(),
	v: () => cycle($("view")),
	f: () => $("fit").click(),
	m: () => $("move").click(),
	t: () => $("turn").click(),
	x: () => $("scale").click(),
};

/* Typing, and choosing by keys, is the control's own. */
function isTyping({ target, key }) {
	return target.matches("select, textarea, input:not([type=checkbox], [type=radio])") || (target.matches("[type=radio]") && key.startsWith("Arrow"));
}

/* Undo and redo, of what is dragged. */
function goBack(event, key) {
	const button = $(key === "y" || event.shiftKey ? "redo" : "undo");

	if (event.altKey || (key !== "z" && key !== "y") || $("pose").hidden || isTyping(event))
		return;
	button.click();
	event.preventDefault();
}

/* The handle of a digit, or the layer: where there is no handle, and with shift. */
function chooseNumber(event, choose) {
	const digit = /^Digit\d$/.test(event.code) ? Number(event.code.slice(5)) : /^\d$/.test(event.key) ? Number(event.key) : NaN;
	const layer = document.querySelectorAll("#layers input")[digit - 1];

	if (!event.shiftKey && choose(digit))
		return true;
	if (layer)
		layer.click();
	return Boolean(layer);
}

/* forget(): Escape; choose(handle): whether there is such a handle. */
export function listen(forget, choose) {
	/* Whether the key does anything. */
	const act = (event, key) => {
		if (chooseNumber(event, choose))
			return true;
		const does = key === "Escape" ? forget : KEYS[key];
		if (does)
			does();
		return Boolean(does);
	};

	addEventListener("keydown", (event) => {
		const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;

		if (event.ctrlKey || event.metaKey)
			goBack(event, key);
		else if (!event.altKey && !isTyping(event) && !(key === " " && event.target.matches("button, summary, input")) && act(event, key))
			event.preventDefault();
	});
}
