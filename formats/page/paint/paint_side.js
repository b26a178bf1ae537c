/* paint_side.js -- the part of the side for painting: tools, regions with the numbers of their vertices, what can be
 * done. */
import { regionColor, regionName } from "../draw/colors.js";
import { HANDLE } from "./regions.js";
import { count } from "../stream/text.js";

const HANDLES = 9;
const MOST = 24; /* regions that are listed */
const $ = (id) => document.getElementById(id);

/* Fixed, free, handles 1 to 9, and others that are there. */
function regionsOf(work) {
	const always = [0, 1, ...Array.from({ length: HANDLES }, (_, i) => HANDLE + 1 + i)];
	const others = [...work.regions.counts].filter(([r, n]) => n > 0 && !always.includes(r)).map(([r]) => r);

	return [...always, ...others].sort((a, b) => a - b).slice(0, MOST);
}

function regionButton(region, painter) {
	const button = document.createElement("button"), swatch = document.createElement("i");

	swatch.style.background = "rgb(" + regionColor(region).join(",") + ")";
	button.append(swatch, document.createElement("span"), document.createElement("small"));
	button.children[1].textContent = regionName(region);
	button.dataset.region = region;
	button.addEventListener("click", () => painter.take(region));
	return button;
}

/* A button for each region; they are made anew only where there are others. */
function listRegions(painter) {
	const regions = regionsOf(painter.work), there = [...$("regions").children];

	if (there.length !== regions.length || there.some((b, i) => Number(b.dataset.region) !== regions[i]))
		$("regions").replaceChildren(...regions.map((r) => regionButton(r, painter)));
	for (const button of $("regions").children) {
		const region = Number(button.dataset.region), n = painter.work.regions.counts.get(region) || 0;
		button.setAttribute("aria-pressed", region === painter.region);
		button.lastChild.textContent = n ? count(n) : "";
	}
}

function showSize(painter) {
	$("size").value = painter.size;
	$("size-is").textContent = Number((100 * painter.share).toPrecision(2)) + " %";
	$("size-is").title = "Radius: " + Number(painter.radius.toPrecision(3)) + ", " + $("size-is").textContent +
		" of the diagonal";
}

function showButtons(painter) {
	const { regions } = painter.work;

	$("paint-undo").disabled = regions.past.length === 0;
	$("paint-redo").disabled = regions.future.length === 0;
	$("clear").disabled = painter.region === 0;
	$("wanted").hidden = painter.app.posing.canSolve(painter.app.shown.frame, painter.work);
	$("drag").disabled = !$("wanted").hidden;
	document.querySelector("#tools [value=part]").hidden = !painter.layer.triangles;
}

/* Brings the side to what is painted, and with what. */
export function showPaint(painter) {
	const paints = painter.tool !== null;

	$("paint").hidden = !painter.work;
	for (const button of document.querySelectorAll("#tools button"))
		button.setAttribute("aria-pressed", button.value === painter.tool);
	$("painting").hidden = !paints;
	$("take").hidden = !painter.work || !painter.work.painted;
	if (!painter.work)
		return;
	$("size-row").hidden = painter.tool !== "brush";
	listRegions(painter);
	showSize(painter);
	showButtons(painter);
}

export function connectPaint(painter) {
	for (const button of document.querySelectorAll("#tools button"))
		button.addEventListener("click", () =>
			painter.choose(painter.tool === button.value ? null : button.value));
	for (const what of ["clear", "fill"])
		$(what).addEventListener("click", () => painter.edit(what));
	$("paint-undo").addEventListener("click", () => painter.back(false));
	$("paint-redo").addEventListener("click", () => painter.back(true));
	$("drag").addEventListener("click", () => painter.drag());
	$("size").addEventListener("input", () => painter.resize(Number($("size").value)));
}

const TOOLS = { p: "brush", k: "part" };

const KEYS = {
	z: (painter) => painter.back(false),
	y: (painter) => painter.back(true),
	Escape: (painter) => painter.leave(),
	d: () => $("drag").click(),
	x: (painter) => painter.take(0),
	0: (painter) => painter.take(1),
	"[": (painter) => painter.resize(painter.size - 5),
	"]": (painter) => painter.resize(painter.size + 5),
	...Object.fromEntries(Array.from({ length: HANDLES }, (_, i) =>
		[i + 1, (painter) => painter.take(HANDLE + i + 1)])),
};

/* Does what a key is for here; false: nothing.  While no tool paints, those of the tools are all. */
export function paintKey(painter, key) {
	const tool = TOOLS[key] && document.querySelector("#tools [value=" + TOOLS[key] + "]");
	const act = painter.tool !== null && KEYS[key];

	if (!painter.work || (!act && !(tool && !tool.hidden)))
		return false;
	if (act)
		act(painter);
	else
		painter.choose(tool.value);
	return true;
}
