/*
 * pose.js -- where handles go: poses in the order in which mr-pose applies them, lib/edit/handles.c, and the steps back and
 * forth between them.
 */
import { IDENTITY, add, apply, compose, exponential, norm, sub, times, unit } from "../mesh/rotation.js";
import { lineOf, parseLine, rest } from "./poseline.js";

/* About which axis a pose turns, by how many radians. */
const turnOf = (pose) => times(pose.rotate[3] * Math.PI / 180, unit(pose.rotate.slice(0, 3)));

/* T x = R S (x - centre) + centre + translate */
function mapOf(pose, centre) {
	const r = exponential(turnOf(pose)), [sx, sy, sz] = pose.scale;
	const t = [0, 3, 6].flatMap((i) => [r[i] * sx, r[i + 1] * sy, r[i + 2] * sz, 0]);
	const shift = add(sub(centre, apply(t, centre)), pose.translate);

	return t.map((x, i) => (i % 4 === 3 ? shift[(i - 3) / 4] : x));
}

/* A number of a line: to so many decimals, without a negative zero. */
const rounded = (x, decimals) => Number(x.toFixed(decimals)) || 0;

export class Pose {
	/*
	 * centroids: of the handles at rest, by number, holes where a number is not in use; start: maps that the stream has
	 * already; extent: of the model.
	 */
	constructor(centroids, start, extent) {
		this.centroids = centroids;
		this.numbers = Object.keys(centroids).map(Number);
		this.start = start;
		this.decimals = Math.min(Math.max(5 - Math.floor(Math.log10(extent)), 0), 20);
		this.most = this.level = null; /* the finest level of a displaced surface, and the one that is shown */
		this.poses = [];
		this.past = [];
		this.future = [];
	}

	/* The map of each handle, after all poses but those from `end` on. */
	maps(end) {
		const n = Math.max(this.centroids.length, this.start.length), maps = Array.from({ length: n }, (_, h) => this.start[h] || IDENTITY);

		for (const pose of this.poses.slice(0, end)) {
			const map = maps[pose.handle];
			maps[pose.handle] = compose(mapOf(pose, pose.center || apply(map, this.centroids[pose.handle])), map);
		}
		return maps;
	}

	/* The largest turn, in degrees. */
	degrees() {
		return Math.max(0, ...this.poses.map((pose) => Math.abs(pose.rotate[3])));
	}

	/* The pose that dragging a handle changes: its last one, unless that has a centre of its own. */
	live(handle) {
		const last = this.poses.map((p) => p.handle).lastIndexOf(handle);

		return last >= 0 && !this.poses[last].center ? last : -1;
	}

	/* Where that begins, and what it is: { centre, translate, turn, scale }. */
	grip(handle) {
		const at = this.live(handle), pose = at < 0 ? rest(handle) : this.poses[at];
		const map = this.maps(at < 0 ? undefined : at)[handle];

		return { centre: apply(map, this.centroids[handle]), translate: pose.translate, turn: turnOf(pose), scale: pose.scale };
	}

	/* Changes it to these, as far as a line tells them. */
	drag(handle, { translate, turn, scale }) {
		const at = this.live(handle), angle = norm(turn) * 180 / Math.PI;
		const pose = {
			handle,
			translate: translate.map((x) => rounded(x, this.decimals)),
			rotate: [...(angle > 0 ? unit(turn).map((x) => rounded(x, 6)) : [0, 0, 1]), rounded(angle, 3)],
			scale: scale.map((x) => rounded(x, 5)),
			center: null,
		};

		this.poses = at < 0 ? [...this.poses, pose] : this.poses.map((p, i) => (i === at ? pose : p));
	}

	/* Keeps what there is now, to come back to: before a change. */
	remember() {
		this.past.push(this.poses);
		this.future = [];
	}

	/* Behind a drag that has led nowhere there is nothing to undo. */
	settle() {
		if (this.past.length && lineOf(this.past[this.past.length - 1], null) === lineOf(this.poses, null))
			this.past.pop();
	}

	/* Other poses, which can be undone. */
	set(poses) {
		if (lineOf(poses, null) === lineOf(this.poses, null))
			return;
		this.remember();
		this.poses = poses;
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
		return lineOf(this.poses, this.level === this.most ? null : this.level);
	}

	/* Takes a line, and returns the level that it asks for, or null; throws an Error with a sentence, and then stays as it is. */
	read(line) {
		const poses = parseLine(line, this.numbers, this.most);

		this.set(poses);
		return poses.level;
	}
}
