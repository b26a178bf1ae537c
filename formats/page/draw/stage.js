/* stage.js -- the canvas: a camera, light that comes with it, and the layers, in one panel or one for each. */
import * as THREE from "three/build/three.module.js";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Gizmo } from "./gizmo.js";
import { element } from "../stream/text.js";

const ANGLE = 30; /* degrees, of the height of a panel */
const LOW = 440; /* pixels of a window in which nothing is to lie over the model: of a phone on its side */

/* Whether the browser can draw at all. */
export function canDraw() {
	const canvas = document.createElement("canvas");

	return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
}

/* Columns of a grid of n panels that are as little stretched as can be. */
function columnsFor(n, width, height) {
	let best = 1, most = 0;

	for (let columns = 1; columns <= n; columns++) {
		const side = Math.min(width / columns, height / Math.ceil(n / columns));
		if (side > most) {
			most = side;
			best = columns;
		}
	}
	return best;
}

/* Light that comes with the camera. */
export function lightUp(scene, camera) {
	const lamp = new THREE.DirectionalLight(0xffffff, 0.56), sky = new THREE.HemisphereLight(0xffffff, 0xb8b4ac, 0.46);

	lamp.position.set(-0.3, 0.5, 0.9);
	camera.add(lamp);
	camera.add(lamp.target);
	scene.add(sky, camera);
}

export class Stage {
	/* labels, foot: lie over the canvas; smooth: whether edges are, which costs four times the pixels. */
	constructor(canvas, { labels, foot }, smooth) {
		this.canvas = canvas;
		this.labels = labels;
		this.foot = foot;
		this.renderer = new THREE.WebGLRenderer({ canvas, antialias: smooth, alpha: true });
		this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
		this.renderer.autoClear = false;
		this.scene = new THREE.Scene();
		this.camera = new THREE.PerspectiveCamera(ANGLE, 1, 1, 10);
		lightUp(this.scene, this.camera);
		this.gizmo = new Gizmo(this);
		this.up("y");
		this.layers = []; /* [name, drawn], those to be seen */
		this.cells = [{ title: "", layers: [] }]; /* what each panel has */
		this.paints = false;
		this.radius = 1;
		const observer = new ResizeObserver(() => this.resize());
		observer.observe(canvas);
		observer.observe(foot);
	}

	/* Which axis is upwards. */
	up(axis) {
		const from = this.controls ? this.controls.target.clone() : new THREE.Vector3();

		if (this.controls)
			this.controls.dispose();
		this.axis = axis;
		this.camera.up.set(axis === "x" ? 1 : 0, axis === "y" ? 1 : 0, axis === "z" ? 1 : 0);
		this.controls = new OrbitControls(this.camera, this.canvas);
		this.controls.enableKeys = false;
		this.controls.target.copy(from);
		this.controls.addEventListener("change", () => this.ask());
	}

	/* Where the eye stands, for a model with y upwards that looks along z. */
	direction(x, y, z) {
		return this.axis === "y" ? new THREE.Vector3(x, y, z) : this.axis === "z" ? new THREE.Vector3(x, -z, y) : new THREE.Vector3(y, z, x);
	}

	/* Shows all of a box from a direction; without one from where the eye is. */
	fit(box, from) {
		const low = new THREE.Vector3(...box.low), high = new THREE.Vector3(...box.high);
		const to = from ? this.direction(...from) : this.camera.position.clone().sub(this.controls.target);

		this.radius = low.distanceTo(high) / 2 || 1;
		const half = ANGLE / 2 * Math.PI / 180, across = Math.atan(Math.tan(half) * Math.min(this.aspect(), 1));
		this.controls.target.copy(low.add(high).multiplyScalar(0.5));
		this.camera.position.copy(this.controls.target).add(to.setLength(this.radius / Math.sin(across)));
		this.controls.update();
		this.ask();
	}

	/* Whether handles can be dragged: not while the left button paints. */
	offer(paints = this.paints) {
		this.paints = paints;
		this.gizmo.offer(this.cells.length === 1 && !paints);
	}

	/* Puts layers, [name, drawn], on the stage; beside: each in a panel of its own. */
	show(layers, beside) {
		this.layers = layers;
		this.cells = beside && layers.length > 1 ? layers.map((layer) => ({ title: layer[0], layers: [layer] })) : [{ title: "", layers }];
		this.offer();
		this.label();
		this.ask();
	}

	/* The panels: place in the canvas, from its top left corner, and what is there; several, and one in a low window, end above the foot. */
	panels() {
		const box = this.canvas.getBoundingClientRect(), n = this.cells.length;
		const width = this.canvas.clientWidth, whole = this.canvas.clientHeight;
		const height = n > 1 || whole < LOW ? Math.max(this.foot.getBoundingClientRect().top - box.top, 1) : whole;
		const columns = columnsFor(n, width, height), w = width / columns, h = height / Math.ceil(n / columns);

		return this.cells.map((cell, i) => ({ ...cell, x: i % columns * w, y: Math.floor(i / columns) * h, width: w, height: h }));
	}

	/* Where in the window the panel is in which handles are dragged. */
	place() {
		const box = this.canvas.getBoundingClientRect(), [panel] = this.panels();

		return { left: box.left + panel.x, top: box.top + panel.y, width: panel.width, height: panel.height };
	}

	aspect() {
		const panel = this.panels()[0];

		return panel.width / panel.height || 1;
	}

	label() {
		this.labels.replaceChildren();
		for (const panel of this.panels().filter((p) => p.title)) {
			const label = element("span", panel.title);
			label.style.left = panel.x + "px";
			label.style.top = panel.y + "px";
			label.style.maxWidth = panel.width + "px";
			this.labels.append(label);
		}
	}

	resize() {
		this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
		this.label();
		this.draw();
	}

	/* Draws at the next occasion. */
	ask() {
		if (!this.asked)
			this.asked = requestAnimationFrame(() => this.draw());
	}

	/* The camera as a panel has it. */
	aim() {
		const far = this.camera.position.distanceTo(this.controls.target);

		this.camera.aspect = this.aspect();
		this.camera.near = Math.max(far - 4 * this.radius, far / 500);
		this.camera.far = far + 4 * this.radius;
		this.camera.updateProjectionMatrix();
		this.camera.updateMatrixWorld();
	}

	draw() {
		const ratio = this.renderer.getPixelRatio(), height = this.canvas.clientHeight;

		cancelAnimationFrame(this.asked);
		this.asked = 0;
		this.aim();
		this.renderer.setScissorTest(false);
		this.renderer.clear();
		this.renderer.setScissorTest(true);
		for (const panel of this.panels()) {
			const place = [panel.x, height - panel.y - panel.height, panel.width, panel.height];
			this.renderer.setViewport(...place);
			this.renderer.setScissor(...place);
			for (const [, drawn] of panel.layers) {
				drawn.scale(panel.height * ratio / 2 / Math.tan(ANGLE / 2 * Math.PI / 180));
				this.scene.add(drawn.group);
			}
			this.renderer.render(this.scene, this.camera);
			for (const [, drawn] of panel.layers)
				this.scene.remove(drawn.group);
		}
	}

	/*
	 * The panel at a place of the window: its layers, its place in the window, and what the camera has there; null
	 * outside.
	 */
	viewAt(clientX, clientY) {
		const box = this.canvas.getBoundingClientRect(), x = clientX - box.left, y = clientY - box.top;
		const panel = this.panels().find((p) => x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height);

		if (!panel)
			return null;
		this.aim();
		const projection = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
		return {
			...panel,
			left: box.left + panel.x,
			top: box.top + panel.y,
			m: projection.elements,
			eye: this.camera.position.toArray(),
			near: this.camera.near,
			far: this.camera.position.distanceTo(this.controls.target),
		};
	}

	/* The direction, of length 1, from the eye to a place of a view, from its top left corner. */
	along(view, x, y) {
		const at = new THREE.Vector3(x / view.width * 2 - 1, 1 - y / view.height * 2, 0.5);

		return at.unproject(this.camera).sub(this.camera.position).normalize().toArray();
	}

	/* Pixels of a view that a length has which is perpendicular to it, at a depth. */
	pixels(view, length, depth) {
		return length / depth * view.height / 2 / Math.tan(ANGLE / 2 * Math.PI / 180);
	}

	/*
	 * What a pick needs to know of a place of the window: the layers there, the ray, and for points the projection
	 * with the place in it; null outside.
	 */
	rayAt(clientX, clientY) {
		const panel = this.viewAt(clientX, clientY);

		if (!panel)
			return null;
		const right = (clientX - panel.left) / panel.width * 2 - 1, top = 1 - (clientY - panel.top) / panel.height * 2;
		return {
			layers: panel.layers,
			from: panel.eye,
			along: this.along(panel, clientX - panel.left, clientY - panel.top),
			projection: panel.m,
			right,
			top,
			aspect: this.camera.aspect,
			pixel: 2 / panel.height,
		};
	}
}
