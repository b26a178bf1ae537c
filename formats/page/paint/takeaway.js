/* takeaway.js -- painted regions out of the page: as a file for mr-select, and as a script that gives them to the
 * page's stream.  Of the stream, only its file's name gets into the script: see fileOf. */
import { HANDLE } from "./regions.js";
import { write } from "./selection_file.js";
import { columnOf, fileOf } from "../stream/stream.js";
import { save } from "../stream/text.js";

const $ = (id) => document.getElementById(id);

function hasHandles(layer, regions) {
	return layer !== "points" && [...regions.counts].some(([r, n]) => r >= HANDLE && n > 0);
}

/* The commands from the stream to the one with the regions and, where these have handles, a basis. */
function commandsOf({ name: layer, regions }, frame, several) {
	const has = (column) => Boolean(columnOf(frame, ...column.split(".")));
	const { surface, at } = frame.levels || {}, first = ["mesh", "control", "points"].find((l) =>
		has(l + ".position"));
	const handles = hasHandles(layer, regions), onMesh = handles && layer === "mesh";

	return [
		surface && surface.layer === layer && "mr-decode --from control --level " + at,
		onMesh && !has("base.position") && "mr-smooth | mr-remesh",
		"mr-select" + (layer === first ? "" : " -l " + layer) + " --from \"$regions\"" + (several ? " -k" : ""),
		handles && "mr-solve --basis",
		onMesh && !has("mesh.detail_height") && "mr-encode",
	].filter(Boolean).join(" | ").replace(/( \||$)/, " \"$@\"$1").split(" | ");
}

function script(name, text, commands) {
	return [
		"#!/bin/sh",
		"# Makes " + name +
			"-painted.mrs: the stream of a page with the regions that were painted there; and its page.",
		"# usage: sh " + name + ".sh STREAM.mrs",
		"[ $# -gt 0 ] || { echo 'usage: sh " + name + ".sh STREAM.mrs' >&2; exit 2; }",
		"set -e",
		"regions=$(mktemp)",
		"trap 'rm -f \"$regions\"' EXIT",
		"cat >\"$regions\" <<'END'",
		text + "END",
		commands.join(" |\n\t") + " -o " + name + "-painted.mrs",
		"mr-view -i " + name + "-painted.mrs " + name + "-painted.html",
		"",
	].join("\n");
}

export class TakeAway {
	constructor(painter) {
		this.painter = painter;
		$("save-regions").addEventListener("click", async () =>
			save(this.name + ".regions", await this.text()));
		$("save-script").addEventListener("click", async () => save(this.name + ".sh", await this.script()));
	}

	get name() {
		return fileOf(this.painter.app.shown.frame);
	}

	async text() {
		const { name, rows, triangles, regions } = this.painter.work, t = triangles && await triangles.values();

		return write({ layer: name, vertices: rows, triangles: t }, regions.values);
	}

	async script() {
		const { frame } = this.painter.app.shown, several = this.painter.app.frames.some((f) =>
			f.group !== frame.group);

		return script(this.name, await this.text(), commandsOf(this.painter.work, frame, several));
	}
}
