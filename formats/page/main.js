/* main.js -- begins: reads the page's data, and connects its controls. */
import { App } from "./app.js";
import { takeBytes, takeLibrary, takePictures } from "./stream/data.js";
import { begin as loadLibrary } from "./library/compile.js";
import { Film } from "./film.js";
import { listen } from "./keys.js";
import { listModels } from "./models.js";
import { readFrames } from "./mesh/models.js";
import { connectSave } from "./save.js";
import { canDraw } from "./draw/stage.js";

const CLICK = 6; /* pixels that a click may move */
const $ = (id) => document.getElementById(id);

/* A press and release at about one place is a click; else it turned the model. */
function onClick(canvas, act) {
	let down = null;

	canvas.addEventListener("pointerdown", (e) => {
		document.activeElement.blur(); /* keys are the page's again */
		down = e.isPrimary && e.button === 0 ? e : null;
	});
	canvas.addEventListener("pointerup", (e) => {
		if (down && e.pointerId === down.pointerId &&
			Math.hypot(e.clientX - down.clientX, e.clientY - down.clientY) < CLICK)
			act(e.clientX, e.clientY);
		down = null;
	});
}

/* Two numbers of which the first is less. */
function readRange() {
	const low = $("low").valueAsNumber, high = $("high").valueAsNumber;

	return low < high ? { low, high } : null;
}

function connect(app) {
	const view = () => $("view").value.split(",").map(Number);

	$("level").addEventListener("input", () => app.change({ level: $("level").valueAsNumber }));
	$("color").addEventListener("change", () => app.change({ color: $("color").value, range: null }));
	for (const end of ["low", "high"])
		$(end).addEventListener("change", () => app.change({ range: readRange() }));
	$("fit-range").addEventListener("click", () => app.change({ range: null }));
	for (const shade of document.querySelectorAll("input[name=shade]"))
		shade.addEventListener("change", () => app.change({ flat: $("flat").checked }));
	$("wire").addEventListener("change", () => app.change({ wire: $("wire").checked }));
	$("ground").addEventListener("change", () => app.change({ ground: $("ground").checked }));
	$("view").addEventListener("change", () => app.fit(view()));
	$("fit").addEventListener("click", () => app.fit());
	$("up").addEventListener("change", () => {
		app.stage.up($("up").value);
		app.fit(view());
	});
	connectSave(app);
	onClick($("canvas"), (x, y) => app.painter.tool || app.pick(x, y));
	listen(() => app.forget(), (handle) => app.posing.choose(handle), app.painter);
}

function fail(error) {
	$("message").textContent = error.message;
}

/* Coarse first: the finest level, where there are some, comes with a later picture. */
async function drawFirst(app, film) {
	app.choice.level = app.frames[0].levels ? 0 : null;
	await film.turn(0);
	if (app.choice.level === 0) {
		document.body.setAttribute("aria-busy", "true");
		await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
		performance.mark("coarse");
		await app.change({ level: null });
		app.fit();
	}
	requestAnimationFrame(() => setTimeout(() => performance.mark("complete")));
}

async function begin() {
	if (!canDraw())
		throw new Error("This browser cannot draw the model: WebGL is missing or switched off.");
	await loadLibrary(takeLibrary()).catch(() => {
		throw new Error("This browser is too old for the page: it has no WebAssembly with vectors.");
	});
	const frames = await readFrames(takeBytes());
	$("side").hidden = false;
	const app = window.mrView = new App(frames, takePictures()); /* for the console, and the tests */
	const film = new Film(frames.length, (frame) => {
		$("model").value = frames[frame].group;
		return app.change({ frame }).catch(fail);
	});
	await listModels(frames, (frame) => film.go(frame));
	await drawFirst(app, film);
	connect(app);
}

begin().catch(fail);
