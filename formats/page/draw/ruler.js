/*
 * ruler.js -- in a corner of the stage: which way the axes go, and how long a round number of the model's units is where the
 * middle of the view is.
 */
const SIDE = 34; /* pixels of an axis */
const LONGEST = 120; /* pixels of the bar */
const AXES = [["x", "#d0342c"], ["y", "#2e8b3d"], ["z", "#2f6fd0"]];
const $ = (id) => document.getElementById(id);

function draw(kind, attributes, parent, words) {
	const made = document.createElementNS("http://www.w3.org/2000/svg", kind);

	for (const [name, value] of Object.entries(attributes))
		made.setAttribute(name, value);
	made.textContent = words || "";
	parent.append(made);
}

/* The largest of 1, 2 and 5 times a power of ten that is no more than this. */
export function roundDown(length) {
	const power = 10 ** Math.floor(Math.log10(length)), times = [5, 2, 1].find((n) => n * power <= length * (1 + 1e-9));

	return Number(((times || 1) * power).toPrecision(1));
}

/* The axes from the back to the front. */
function drawAxes(stage) {
	const view = stage.camera.matrixWorldInverse.elements;
	const axes = AXES.map(([name, color], i) => ({ name, color, right: view[4 * i], top: view[4 * i + 1], near: view[4 * i + 2] }));

	$("axes").replaceChildren();
	for (const { name, color, right, top } of axes.sort((a, b) => a.near - b.near)) {
		draw("line", { x1: 0, y1: 0, x2: SIDE * right, y2: -SIDE * top, stroke: color }, $("axes"));
		draw("text", { x: (SIDE + 9) * right, y: -(SIDE + 9) * top, fill: color }, $("axes"), name);
	}
}

/* What stands for a number: 0.002, 50, 1e+21. */
function wordsOf(length) {
	return length >= 1e-4 && length < 1e6 ? String(length) : length.toExponential();
}

/* Brings axes and bar to what the stage has drawn. */
export function showRuler(stage) {
	if ($("ruler").hidden)
		return;
	const length = roundDown(LONGEST * stage.unitsPerPixel());

	drawAxes(stage);
	$("bar-of-scale").style.width = length / stage.unitsPerPixel() + "px";
	$("length").textContent = Number.isFinite(length) ? wordsOf(length) : "";
}
