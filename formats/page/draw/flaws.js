/*
 * flaws.js -- what is marked of surfaces: folded edges, which follow where vertices go, and the faces that intersect, when these
 * rest.  Marks are seen through the model: flaws are small, and often inside.
 */
import * as THREE from "three/build/three.module.js";
import { pointMaterial } from "./materials.js";
import { count } from "../stream/text.js";

const REST = 400; /* milliseconds without a move */
const RED = [226, 38, 44], VIOLET = [150, 70, 226];
const $ = (id) => document.getElementById(id);
const colorOf = (rgb) => new THREE.Color("rgb(" + rgb.join(",") + ")");

const DISC = `
varying vec3 vTint;
void main() {
	float out2 = dot(2.0 * gl_PointCoord - 1.0, 2.0 * gl_PointCoord - 1.0);
	if (out2 > 1.0)
		discard;
	gl_FragColor = vec4(out2 > 0.5 ? vec3(1.0) : vTint, 0.9);
}`;

const materials = {
	line: new THREE.LineBasicMaterial({ color: colorOf(RED), depthTest: false, transparent: true }),
	face: new THREE.MeshBasicMaterial({ color: colorOf(VIOLET), side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 }),
	dot: pointMaterial(DISC, { size: 1, least: 9, most: 9 }, { depthTest: false, transparent: true }),
};

/* The mean of n vertices, next to each other in a list. */
function middlesOf(vertices, n, p) {
	const out = new Float32Array(vertices.length / n * 3);

	vertices.forEach((v, i) => {
		for (let c = 0; c < 3; c++)
			out[3 * Math.floor(i / n) + c] += p[3 * v + c] / n;
	});
	return out;
}

/* The marks of a layer as it is drawn. */
class Marks {
	constructor(drawn, changed) {
		this.drawn = drawn;
		this.changed = changed;
		this.group = new THREE.Group();
		this.lines = this.add(new THREE.LineSegments(new THREE.BufferGeometry(), materials.line));
		this.body = this.add(new THREE.Mesh(new THREE.BufferGeometry(), materials.face));
		this.dots = this.add(new THREE.Points(new THREE.BufferGeometry(), materials.dot));
		this.mark(drawn.solid.crossings());
	}

	add(object) {
		object.frustumCulled = false;
		object.renderOrder = 1;
		this.group.add(object);
		return object;
	}

	/* faces: the corners of those that intersect; null: they are moving. */
	mark(faces) {
		const { position, solid } = this.drawn, ends = solid.folds();
		const places = [middlesOf(ends, 2, position), middlesOf(faces || [], 3, position)], tint = new Uint8Array(places[0].length + places[1].length);

		this.folds = ends.length / 2;
		this.faces = faces;
		for (let i = 0; i < tint.length; i += 3)
			tint.set(i < places[0].length ? RED : VIOLET, i);
		this.give(this.lines, position, ends);
		this.give(this.body, position, faces || new Uint32Array(0));
		this.give(this.dots, Float32Array.from([...places[0], ...places[1]]), null);
		this.dots.geometry.setAttribute("tint", new THREE.BufferAttribute(tint, 3, true));
	}

	give({ geometry }, position, index) {
		geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
		geometry.setIndex(index && new THREE.BufferAttribute(index, 1));
	}

	/* The vertices are elsewhere. */
	follow() {
		this.again(null);
		clearTimeout(this.resting);
		this.resting = setTimeout(() => this.again(this.drawn.solid.crossings()), REST);
	}

	again(faces) {
		this.free();
		this.mark(faces);
		this.changed();
	}

	dispose() {
		clearTimeout(this.resting);
		this.free();
	}

	free() {
		for (const { geometry } of this.group.children)
			geometry.dispose();
	}
}

export class Flaws {
	/* changed(): there is something else to be drawn. */
	constructor(changed) {
		this.marks = [];
		this.changed = changed;
	}

	/* Marks what is seen, if it is to be marked. */
	show({ layers, drawn: all }, on) {
		for (const { drawn } of all.values())
			drawn.setMarks(null);
		this.marks = (on ? layers.filter((l) => l.triangles && l.triangles.rows) : []).map(({ name }) => new Marks(all.get(name).drawn, () => this.tell()));
		this.marks.forEach((marks) => marks.drawn.setMarks(marks));
		this.tell();
	}

	/* How many there are, of all layers that are seen. */
	tell() {
		const folds = this.marks.reduce((n, m) => n + m.folds, 0), faces = this.marks.reduce((n, m) => n + (m.faces ? m.faces.length / 3 : NaN), 0);
		const items = [[RED, count(folds) + (folds === 1 ? " folded edge" : " folded edges")],
			[VIOLET, (Number.isNaN(faces) ? "…" : count(faces)) + (faces === 1 ? " intersecting face" : " intersecting faces")]];

		this.changed();
		$("flaw-list").replaceChildren(...(this.marks.length ? items : []).map(([color, words]) => {
			const item = document.createElement("li"), swatch = document.createElement("i");
			swatch.style.background = "rgb(" + color.join(",") + ")";
			item.append(swatch, words);
			return item;
		}));
	}
}
