/* gizmo.js -- what a handle is dragged by: the arrows, rings and boxes of three.js, at one place of the stage. */
import * as THREE from "three/build/three.module.js";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";

const LEAST = 0.01; /* of a scale: less is flat, or inside out, by an accident of the hand */
const SIZE = 0.6; /* about a sixth of the picture's height to either side */
const MODES = { move: "translate", turn: "rotate", scale: "scale" };

/* A rotation as a vector along its axis, as long as its angle, at most half a circle. */
function logarithm({ x, y, z, w }) {
	const axis = new THREE.Vector3(x, y, z).multiplyScalar(w < 0 ? -2 : 2);

	return axis.setLength(2 * Math.atan2(axis.length() / 2, Math.abs(w)));
}

/* three.js turns arrows and boxes to the eye: here they point along their axes. */
function straighten(gizmo) {
	const update = gizmo.updateMatrixWorld;

	gizmo.updateMatrixWorld = function () {
		const eye = this.eye.clone(), turn = this.worldQuaternion;
		if (this.mode === "translate")
			this.eye.set(...eye.toArray().map(Math.abs));
		else if (this.mode === "scale")
			this.eye.fromArray(eye.clone().applyQuaternion(turn.clone().inverse()).toArray().map(Math.abs))
				.applyQuaternion(turn);
		update.call(this);
		this.eye.copy(eye);
	};
}

export class Gizmo {
	constructor(stage) {
		this.stage = stage;
		this.at = new THREE.Object3D();
		this.controls = new TransformControls(stage.camera, {
			addEventListener: (...what) => stage.canvas.addEventListener(...what),
			removeEventListener: (...what) => stage.canvas.removeEventListener(...what),
			getBoundingClientRect: () => stage.place(),
		});
		straighten(this.controls.children[0]);
		this.controls.setSize(SIZE);
		this.mode("turn");
		stage.scene.add(this.at, this.controls);
		this.controls.addEventListener("change", () => stage.ask());
		this.controls.addEventListener("dragging-changed", ({ value }) => {
			stage.controls.enabled = !value;
			if (this.grip)
				(value ? this.began : this.ended)();
		});
		this.controls.addEventListener("objectChange", () => this.moved(this.read()));
	}

	/* Whether the pointer is at it, so that a click is not meant for the model. */
	get busy() {
		return this.controls.dragging || this.controls.axis !== null;
	}

	mode(name) {
		this.controls.setMode(MODES[name]);
	}

	/* Stands where the grip (pose.js) is, less the stage's centre; null: nowhere. */
	show(grip, centre) {
		this.grip = grip;
		this.centre = centre;
		if (grip) {
			this.at.position.fromArray(grip.centre.map((x, c) => x + grip.translate[c] - centre[c]));
			this.at.quaternion.setFromAxisAngle(grip.turn.clone().normalize(), grip.turn.length());
			this.at.scale.fromArray(grip.scale);
		}
		this.offer(this.offered !== false);
	}

	/* Whether handles can be dragged: not while the left button paints. */
	offer(on) {
		this.offered = on;
		if (on && this.grip)
			this.controls.attach(this.at);
		else
			this.controls.detach();
		this.controls.enabled = on;
		this.stage.ask();
	}

	get there() {
		return Boolean(this.grip) && this.controls.enabled;
	}

	/* Puts a label below the rings. */
	label({ style }) {
		const { x, y } = this.at.position.clone().project(this.stage.camera);

		style.left = 50 * (1 + x) + "%";
		style.top = 50 * (1 - y) + 22 + "%";
	}

	/* Where it has been dragged: { translate, turn, scale }. */
	read() {
		const place = this.at.position.toArray();

		return {
			translate: place.map((x, c) => x + this.centre[c] - this.grip.centre[c]),
			turn: logarithm(this.at.quaternion),
			scale: this.at.scale.toArray().map((x) => Math.max(x, LEAST)),
		};
	}
}
