/* side.js -- the side of the page: what is in the frame, switches for it, the legend of the colours. */
import { kindColor, mapOf, regionColor, regionName } from "./draw/colors.js";
import { titleOf } from "./stream/stream.js";
import { count, element, plain } from "./stream/text.js";

const MOST = 24; /* kinds that a legend lists */
const $ = (id) => document.getElementById(id);

function sizeOf(layer) {
	return layer.triangles ? count(layer.triangles.rows) + " faces" : count(layer.position.rows) + " points";
}

function layerSwitch(layer, shown, change) {
	const label = document.createElement("label"), box = document.createElement("input");

	box.type = "checkbox";
	box.checked = shown;
	box.addEventListener("change", () => change(layer.name, box.checked));
	label.append(box, element("bdi", layer.name), element("span", sizeOf(layer), "size"));
	label.title = count(layer.position.rows) + " vertices";
	return label;
}

/* A switch for each layer. */
export function listLayers(layers, visible, change) {
	$("layers").replaceChildren(...layers.map((layer) => layerSwitch(layer, visible.has(layer.name), change)));
}

/* Edges and smoothness are of surfaces. */
export function offerShading(layers) {
	$("shading").hidden = !layers.some((l) => l.triangles);
}

/* The columns that there are to colour by; the first choice is none. */
export function listColors(names, chosen) {
	const options = ["", ...names].map((name) => {
		const option = element("option", name.trim() || "plain");
		option.value = name;
		return option;
	});

	$("color").replaceChildren(...options);
	$("color").value = chosen;
}

function drawBar(range) {
	const picture = new ImageData(256, 1), map = mapOf(range);

	for (let i = 0; i < 256; i++)
		picture.data.set([map[3 * i], map[3 * i + 1], map[3 * i + 2], 255], 4 * i);
	$("bar").getContext("2d").putImageData(picture, 0, 0);
}

function kindItem(color, name) {
	const item = document.createElement("li"), swatch = document.createElement("i");

	swatch.style.background = "rgb(" + color.join(",") + ")";
	item.append(swatch, element("bdi", name));
	return item;
}

function kindItems(legend) {
	const regions = legend.kind === "region";
	const items = legend.kinds.slice(0, MOST).map((kind) =>
		kindItem((regions ? regionColor : kindColor)(kind), regions ? regionName(kind) : legend.names[kind] ||
			String(kind)));

	if (legend.kinds.length > MOST)
		items.push(element("li", "and " + count(legend.kinds.length - MOST) + " more"));
	return items;
}

/* legend: { kind, range, kinds, names }, or null. */
export function showLegend(legend) {
	const numbers = legend && legend.kind === "number";

	$("legend").hidden = !legend || legend.kind === "own";
	$("bar").hidden = $("range").hidden = !numbers;
	$("kinds").replaceChildren(...(legend && !numbers && legend.kind !== "own" ? kindItems(legend) : []));
	if (!numbers)
		return;
	drawBar(legend.range);
	$("low").value = Number(legend.range.low.toPrecision(5));
	$("high").value = Number(legend.range.high.toPrecision(5));
}

/* A finding, as lib/base/finding.c writes it, in words. */
function sayFinding(line) {
	const [tool, kind, layer, n, of, , , vertex, , , , what] = line.split("\t");
	const many = n > 0 ? " (" + n + (of > 0 ? " of " + of : "") + ")" : "";

	return tool + ": " + (layer ? layer + " " : "") + kind + many + (vertex ? ", vertex " + vertex : "") +
		(what ? ": " + what : "");
}

export function showName(frame, history, findings) {
	$("name").textContent = document.title = plain(frame.title || titleOf(frame));
	$("caption").textContent = plain(frame.caption || "");
	$("found").hidden = findings.length === 0;
	$("findings").replaceChildren(...findings.map((line) => element("div", sayFinding(line))));
	$("past").hidden = history.length === 0;
	$("history").replaceChildren(...history.map((line) => element("div", line)));
}
