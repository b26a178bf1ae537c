/* pose.js -- where handles go: a pose of each that was dragged, { handle, translate, rotate: axis and degrees, scale },
 * as mr-pose applies it, lib/edit/handles.c; the line of commands that does the same; the steps back and forth. */
import { Matrix4, Quaternion, Vector3 } from "three/build/three.module.js";

const rest = (handle) => ({ handle, translate: [0, 0, 0], rotate: [0, 0, 1, 0], scale: [1, 1, 1] });

const vector = (x) => new Vector3(...x);

/* About which axis a pose turns, as long as the angle is in radians. */
const turnOf = ({ rotate }) => vector(rotate).setLength(rotate[3] * Math.PI / 180);

/* T x = R S (x - centre) + centre + translate */
function mapOf(pose, centre) {
	const turn = new Quaternion().setFromAxisAngle(vector(pose.rotate).normalize(), pose.rotate[3] * Math.PI / 180);

	return new Matrix4().compose(vector(centre).add(vector(pose.translate)), turn, vector(pose.scale)).multiply(
		new Matrix4().makeTranslation(...centre.map((x) => -x)));
}

/* Maps are three rows of four. */
const matrixOf = (map) => new Matrix4().set(...map, 0, 0, 0, 1);
const rowsOf = (matrix) => matrix.clone().transpose().elements.slice(0, 12);

/* A number of a line: to so many decimals, without a negative zero. */
const rounded = (x, decimals) => Number(x.toFixed(decimals)) || 0;

/* Empty where it is at rest. */
function commandOf({ handle, translate, rotate, scale }) {
	const options = [
		scale.some((x) => x !== 1) && "--scale " + (scale.every((x) => x === scale[0]) ? scale[0] :
			scale.join(",")),
		rotate[3] !== 0 && "--rotate " + rotate.join(","),
		translate.some((x) => x !== 0) && "--translate " + translate.join(","),
	].filter(Boolean);

	return options.length ? ["mr-pose -H " + handle, ...options].join(" ") : "";
}

/* The line that makes the poses; empty where all is at rest. */
function lineOf(poses) {
	const commands = poses.map(commandOf).filter(Boolean);

	return commands.length ? [...commands, "mr-decode"].join(" | ") : "";
}

export class Pose {
	/* centroids: of the handles at rest, by number, holes where a number is not in use; start: maps that the stream
	 * has already; extent: of the model. */
	constructor(centroids, start, extent) {
		this.centroids = centroids;
		this.numbers = Object.keys(centroids).map(Number);
		this.start = start;
		this.decimals = Math.min(Math.max(5 - Math.floor(Math.log10(extent)), 0), 20);
		this.poses = [];
		this.past = [];
		this.future = [];
	}

	poseOf(handle) {
		return this.poses.find((pose) => pose.handle === handle) || rest(handle);
	}

	/* Where a handle is as the stream has posed it, and its middle there. */
	from(handle) {
		const map = this.start[handle] ? matrixOf(this.start[handle]) : new Matrix4();

		return { map, centre: this.numbers.includes(handle) ?
			vector(this.centroids[handle]).applyMatrix4(map).toArray() : null };
	}

	/* The map of each handle. */
	maps() {
		return Array.from({ length: Math.max(this.centroids.length, this.start.length) }, (_, handle) => {
			const { map, centre } = this.from(handle);
			return rowsOf(centre ? mapOf(this.poseOf(handle), centre).multiply(map) : map);
		});
	}

	/* The largest turn, in degrees. */
	degrees() {
		return Math.max(0, ...this.poses.map((pose) => Math.abs(pose.rotate[3])));
	}

	/* Where a pose begins, and what it is: { centre, translate, turn, scale }. */
	grip(handle) {
		const pose = this.poseOf(handle);

		return { centre: this.from(handle).centre, translate: pose.translate, turn: turnOf(pose),
			scale: pose.scale };
	}

	/* Changes it to these, as far as a line tells them. */
	drag(handle, { translate, turn, scale }) {
		const angle = turn.length() * 180 / Math.PI, axis = turn.clone().normalize().toArray();

		this.poses = [...this.poses.filter((pose) => pose.handle !== handle), {
			handle,
			translate: translate.map((x) => rounded(x, this.decimals)),
			rotate: [...(angle > 0 ? axis.map((x) => rounded(x, 6)) : [0, 0, 1]), rounded(angle, 3)],
			scale: scale.map((x) => rounded(x, 5)),
		}];
	}

	/* Keeps what there is now, to come back to: before a change. */
	remember() {
		this.past.push(this.poses);
		this.future = [];
	}

	/* Behind a drag that has led nowhere there is nothing to undo. */
	settle() {
		if (this.past.length && lineOf(this.past[this.past.length - 1]) === lineOf(this.poses))
			this.past.pop();
	}

	/* Other poses, which can be undone. */
	set(poses) {
		this.remember();
		this.poses = poses;
		this.settle();
	}

	step(from, to) {
		if (from.length === 0)
			return;
		to.push(this.poses);
		this.poses = from.pop();
	}

	undo() {
		this.step(this.past, this.future);
	}

	redo() {
		this.step(this.future, this.past);
	}

	line() {
		return lineOf(this.poses);
	}
}
