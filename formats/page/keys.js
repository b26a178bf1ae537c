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
};

/* Typing, and choosing by keys, is the control's own. */
function isTyping(target) {
	return target.matches("select, input:not([type=checkbox])");
}

export function listen(forget) {
	addEventListener("keydown", (event) => {
		const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
		const layer = document.querySelectorAll("#layers input")[Number(key) - 1];

		if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target))
			return;
		if (key === " " && event.target.matches("button, summary, input"))
			return;
		if (key === "Escape")
			forget();
		else if (layer)
			layer.click();
		else if (KEYS[key])
			KEYS[key]();
		else
			return;
		event.preventDefault();
	});
}
