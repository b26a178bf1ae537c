/* thumbnail.js -- a layer as a small picture, drawn by the stage's renderer beside what is shown. */
import * as THREE from "three/build/three.module.js";
import { PLAIN } from "./colors.js";
import { lightUp } from "./stage.js";
import { boxOf, centred, centreOf } from "../mesh/surface.js";

const WIDTH = 192, HEIGHT = 144; /* pixels of a picture */
const SAMPLES = 2; /* a side of a pixel */
const ANGLE = 30, FROM = [0.5, 0.35, 1];

function geometryOf(position, triangles) {
	const geometry = new THREE.BufferGeometry();

	geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
	if (triangles)
		geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
	return geometry;
}

/* Of the ball around the origin that holds all; 1 of a single point. */
function radiusOf(position) {
	let most = 0;

	for (let i = 0; i < position.length; i += 3)
		most = Math.max(most, position[i] ** 2 + position[i + 1] ** 2 + position[i + 2] ** 2);
	return Math.sqrt(most) || 1;
}

/* The rows of a picture, the lowest first as the graphics card has them, to those of a canvas. */
function upright(bytes, width, height) {
	const picture = new ImageData(width, height);

	for (let y = 0; y < height; y++)
		picture.data.set(bytes.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
	return picture;
}

export class Thumbnails {
	constructor(stage) {
		const color = new THREE.Color(...PLAIN.map((c) => c / 255));

		this.stage = stage;
		this.scene = new THREE.Scene();
		this.camera = new THREE.PerspectiveCamera(ANGLE, WIDTH / HEIGHT, 1, 10);
		lightUp(this.scene, this.camera);
		this.surface = new THREE.MeshPhongMaterial({ color, specular: 0x121212, shininess: 24, side: THREE.DoubleSide, flatShading: true });
		this.points = new THREE.PointsMaterial({ color, size: 2 * SAMPLES / stage.renderer.getPixelRatio(), sizeAttenuation: false }); /* of the picture's pixels, not the window's */
		this.target = new THREE.WebGLRenderTarget(SAMPLES * WIDTH, SAMPLES * HEIGHT);
		this.large = document.createElement("canvas");
		this.large.width = this.target.width;
		this.large.height = this.target.height;
	}

	async draw(layer, canvas) {
		const values = await layer.position.values(), box = boxOf(values);
		const triangles = layer.triangles && layer.triangles.rows ? await layer.triangles.values() : null;

		if (!box)
			return;
		const position = centred(values, centreOf(box)), geometry = geometryOf(position, triangles);
		const model = triangles ? new THREE.Mesh(geometry, this.surface) : new THREE.Points(geometry, this.points);
		this.aim(1.05 * radiusOf(position));
		this.scene.add(model);
		this.render();
		this.scene.remove(model);
		geometry.dispose();
		this.show(canvas);
	}

	/* At all of a ball around the origin. */
	aim(radius) {
		const far = radius / Math.sin(ANGLE / 2 * Math.PI / 180);

		this.camera.up.copy(this.stage.camera.up);
		this.camera.position.copy(this.stage.direction(...FROM).setLength(far));
		this.camera.lookAt(0, 0, 0);
		this.camera.near = far - 2 * radius;
		this.camera.far = far + 2 * radius;
		this.camera.updateProjectionMatrix();
	}

	render() {
		const { renderer } = this.stage, { width, height } = this.target, bytes = new Uint8Array(4 * width * height);

		renderer.setRenderTarget(this.target);
		renderer.clear();
		renderer.render(this.scene, this.camera);
		renderer.readRenderTargetPixels(this.target, 0, 0, width, height, bytes);
		renderer.setRenderTarget(null);
		this.large.getContext("2d").putImageData(upright(bytes, width, height), 0, 0);
	}

	show(canvas) {
		const context = Object.assign(canvas, { width: WIDTH, height: HEIGHT }).getContext("2d");

		context.imageSmoothingQuality = "high";
		context.drawImage(this.large, 0, 0, WIDTH, HEIGHT);
	}
}
