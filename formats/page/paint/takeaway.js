/* takeaway.js -- painted regions out of the page and into it: as a file, as text, and as a script that makes them again. */
import { HANDLE } from "./regions.js";
import { basisLine, script } from "./recipe.js";
import { read, write } from "./selection_file.js";
import { columnOf, linesOf, fileOf } from "../stream/stream.js";
import { count } from "../stream/text.js";

const LARGEST = 1e8; /* characters of a file */
const $ = (id) => document.getElementById(id);

function save(name, text) {
	const link = document.createElement("a");

	link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
	link.download = name;
	link.click();
	setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/* To the clipboard, by the old way where a browser keeps the new one from files. */
async function copy(text) {
	try {
		await navigator.clipboard.writeText(text);
	} catch (error) {
		$("text").select();
		if (!document.execCommand("copy"))
			throw new Error("The browser does not let the page copy: take the text from the field.");
	}
}

/* What makes the layer, where the page makes it of control mesh and heights. */
function decodeLine({ levels }, layer) {
	return levels && levels.surface.layer === layer ? "mr-decode --from control --level " + levels.at : "";
}

export class TakeAway {
	constructor(painter) {
		this.painter = painter;
		this.on("save-regions", async () => save((await this.work()).name + ".regions", await this.text()));
		this.on("copy-regions", async () => this.give(await this.text()));
		this.on("save-script", async () => save((await this.work()).name + ".sh", await this.script()));
		this.on("copy-script", async () => this.give(await this.script()));
		this.on("copy-basis", async () => {
			$("take").open = true;
			return this.give($("basis-line").textContent);
		});
		this.on("apply", () => this.apply($("text").value));
		this.on("open-regions", () => $("file").click());
		$("file").addEventListener("change", () => this.say(() => this.open()));
		$("take").addEventListener("toggle", () => this.show());
	}

	on(id, act) {
		$(id).addEventListener("click", () => this.say(act));
	}

	/* Does it, and says what came of it. */
	async say(act) {
		$("take-said").textContent = "";
		$("take").setAttribute("aria-busy", "true");
		try {
			$("take-said").textContent = (await act()) || "";
		} catch (error) {
			$("take-said").textContent = error.message;
		}
		$("take").removeAttribute("aria-busy");
	}

	/* The text as one to copy, and copied. */
	async give(text) {
		$("text").value = text;
		await copy(text);
		return "Copied: what stands above.";
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

	async apply(text) {
		const { painter } = this, { work } = painter, { vertices, regions } = read(text, await this.model());

		if (work !== painter.work || work.regions.change)
			return "";
		const changed = work.regions.replace(vertices, regions);
		work.painted = true;
		await painter.done(changed);
		return count(vertices.length) + " vertices have their regions, " + count(changed.length) + " of them other ones than before.";
	}

	async open() {
		const file = $("file").files[0];

		$("file").value = "";
		if (!file)
			return "";
		if (file.size > LARGEST)
			throw new Error("The file has " + count(file.size) + " bytes: it is no file of regions.");
		return this.apply(await file.text());
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
