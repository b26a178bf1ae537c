/* takeaway.js -- painted regions out of the page: as a file, and as a script that makes them again. */
import { HANDLE } from "./regions.js";
import { basisLine, script } from "./recipe.js";
import { write } from "./selection_file.js";
import { copy } from "../stream/text.js";
import { columnOf, linesOf, fileOf } from "../stream/stream.js";

const $ = (id) => document.getElementById(id);

function save(name, text) {
	const link = document.createElement("a");

	link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
	link.download = name;
	link.click();
	setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/* What makes the layer, where the page makes it of control mesh and heights. */
function decodeLine({ levels }, layer) {
	return levels && levels.surface.layer === layer ? "mr-decode --from control --level " + levels.at : "";
}

export class TakeAway {
	constructor(painter) {
		this.painter = painter;
		$("save-regions").addEventListener("click", async () => save((await this.work()).name + ".regions", await this.text()));
		$("save-script").addEventListener("click", async () => save((await this.work()).name + ".sh", await this.script()));
		$("copy-basis").addEventListener("click", () => copy($("basis-line")));
	}

	/* What is taken away: what is painted on the layer in view, or what the stream came with. */
	get taken() {
		const { work, given } = this.painter;

		return work.painted || work.column.origin ? work : given;
	}

	async model({ name, rows, triangles } = this.painter.work) {
		const { painter } = this, seen = name === painter.work.name;

		return { layer: name, vertices: rows, triangles: seen ? await painter.triangles() : triangles ? await triangles.values() : null };
	}

	async text() {
		return write(await this.model(this.taken), this.taken.regions.values);
	}

	/* Whether the regions are those of the stream. */
	async unchanged() {
		const { column, regions } = this.taken, own = column.origin && await column.origin.values();

		return Boolean(own) && regions.values.every((r, v) => r === own[v]);
	}

	/* The line of the page's pose, where it is of these regions and begins at rest; or an empty text. */
	async pose(frame) {
		const { pose } = this.painter.app.posing;

		return pose && !columnOf(frame, "handles", "transform") && await this.unchanged() ? pose.line() : "";
	}

	/* What a script needs to know of the frame. */
	async work() {
		const { frame } = this.painter.app.shown, { name, regions } = this.taken;
		const encoded = columnOf(frame, "base", "encoded"); /* a copy of the positions, where base is as it was then */
		const first = ["mesh", "control", "points"].find((l) => columnOf(frame, l, "position"));

		return {
			name: fileOf(frame),
			layer: name,
			option: name !== first,
			decode: decodeLine(frame, name),
			base: Boolean(columnOf(frame, "base", "position")) || name === "control",
			encoded: ["detail_height", "detail_offset"].some((c) => columnOf(frame, "mesh", c)),
			still: Boolean(encoded) && encoded.of === columnOf(frame, "base", "position"),
			pose: await this.pose(frame),
			handles: [...regions.counts].some(([r, n]) => r >= HANDLE && n > 0),
			several: this.painter.app.frames.some((f) => f.group !== frame.group),
		};
	}

	async script() {
		const history = await linesOf(this.painter.app.shown.frame, "", "history");

		return script({ ...await this.work(), text: await this.text() }, history);
	}

	/* The line for a basis, where there are handles to drag and the page has none for them. */
	async show() {
		const { painter } = this;

		if (!painter.work)
			return;
		const work = await this.work(), free = painter.work.regions.counts.get(1) > 0;
		$("basis").hidden = !work.handles || !painter.work.painted || work.layer === "points" || await this.unchanged();
		$("basis-why").textContent = (free ? "" : "No vertex is free: paint what is to follow the handles. ") +
			"To drag the painted handles: save the regions, and where they and the page's stream, " + work.name + ".mrs, are, run the line below. It makes a page that has their basis.";
		$("basis-line").textContent = basisLine(work);
	}
}
