/* stage.js -- the canvas: a camera, light that comes with it, and the layers. */
import * as THREE from "three/build/three.module.js";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Gizmo } from "./gizmo.js";
import { Ground } from "./ground.js";

const ANGLE = 30; /* degrees, of the height of the picture */

/* Whether the browser can draw at all. */
export function canDraw() {
	const canvas = document.createElement("canvas");

	return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
}

/* Light that comes with the camera. */
function lightUp(scene, camera) {
	const lamp = new THREE.DirectionalLight(0xffffff, 0.56),
		sky = new THREE.HemisphereLight(0xffffff, 0xb8b4ac, 0.46);

	lamp.position.set(-0.3, 0.5, 0.9);
	camera.add(lamp);
	camera.add(lamp.target);
	scene.add(sky, camera);
}

export class Stage {
	constructor(canvas) {
		this.canvas = canvas;
		this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
		this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
		this.scene = new THREE.Scene();
		this.camera = new THREE.PerspectiveCamera(ANGLE, 1, 1, 10);
		lightUp(this.scene, this.camera);
		this.gizmo = new Gizmo(this);
		this.up("y");
		this.layers = []; /* [name, drawn], those to be seen */
		this.radius = 1;
		new ResizeObserver(() => this.resize()).observe(canvas);
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
		return this.axis === "y" ? new THREE.Vector3(x, y, z) : this.axis === "z" ?
			new THREE.Vector3(x, -z, y) : new THREE.Vector3(y, z, x);
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

	/* Lays the ground below a box; none: no ground. */
	lay(box) {
		if (box && !this.ground)
			this.ground = new Ground(this);
		if (this.ground)
			this.ground.group.visible = Boolean(box);
		if (box)
			this.ground.lie(box, this.direction(0, 1, 0), this.direction(0.4, 1, 0.2));
	}

	/* Puts layers, [name, drawn], on the stage. */
	show(layers) {
		for (const [, drawn] of this.layers)
			this.scene.remove(drawn.group);
		for (const [, drawn] of layers)
			this.scene.add(drawn.group);
		this.layers = layers;
		this.ask();
	}

	/* Where in the window the picture is. */
	place() {
		return this.canvas.getBoundingClientRect();
	}

	aspect() {
		const { width, height } = this.place();

		return width / height || 1;
	}

	resize() {
		this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
		this.draw();
	}

	/* Draws at the next occasion. */
	ask() {
		if (!this.asked)
			this.asked = requestAnimationFrame(() => this.draw());
	}

	/* The camera as the picture has it. */
	aim() {
		const far = this.camera.position.distanceTo(this.controls.target);

		this.camera.aspect = this.aspect();
		this.camera.near = Math.max(far - 4 * this.radius, far / 500);
		this.camera.far = far + 4 * this.radius;
		this.camera.updateProjectionMatrix();
		this.camera.updateMatrixWorld();
	}

	draw() {
		const height = this.canvas.clientHeight * this.renderer.getPixelRatio(),
			pixels = height / 2 / Math.tan(ANGLE / 2 * Math.PI / 180);

		cancelAnimationFrame(this.asked);
		this.asked = 0;
		this.aim();
		for (const [, drawn] of this.layers)
			drawn.scale(pixels);
		this.renderer.render(this.scene, this.camera);
		this.gizmo.label(document.getElementById("hint"));
	}

	/* The ray through a place of the window, and for points the projection with the place in it; null where that is
	 * not in the picture. */
	rayAt(clientX, clientY) {
		const { left, top, width, height } = this.place(), right = (clientX - left) / width * 2 - 1,
			above = 1 - (clientY - top) / height * 2;

		if (!(right >= -1 && right < 1 && above > -1 && above <= 1))
			return null;
		this.aim();
		const { position, projectionMatrix, matrixWorldInverse, aspect } = this.camera;
		const at = new THREE.Vector3(right, above, 0.5).unproject(this.camera);
		return {
			from: position.toArray(),
			along: at.sub(position).normalize().toArray(),
			projection: new THREE.Matrix4().multiplyMatrices(projectionMatrix, matrixWorldInverse).elements,
			right,
			top: above,
			aspect,
			height,
			far: position.distanceTo(this.controls.target),
		};
	}

	/* Pixels that a length has which is perpendicular to a ray, as far as what the eye looks at. */
	pixels({ height, far }, length) {
		return length / far * height / 2 / Math.tan(ANGLE / 2 * Math.PI / 180);
	}
}
