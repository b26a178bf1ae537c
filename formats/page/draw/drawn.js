/* drawn.js -- one layer as three.js draws it: a surface with its edges, or points as small balls, and the vertex that
 * was picked. */
import * as THREE from "three/build/three.module.js";
import { PLAIN } from "./colors.js";
import { bodies, materialsFor, wornMaterial } from "./materials.js";
import { Solid } from "../mesh/solid.js";
import { edgesOf, spacingOf } from "../mesh/surface.js";

const WHITE = [255, 255, 255];

const attribute = (array, size, normalized) => new THREE.BufferAttribute(array, size, normalized);

/* What is drawn of a layer; `position` and `triangles` are those of the stream, around the centre.  before: what was
 * drawn of it in another frame, or undefined. */
export class Drawn {
	constructor(position, triangles, normal, extent, before) {
		const again = before && before.materials.surface === Boolean(triangles);

		this.materials = again ? before.materials : materialsFor(Boolean(triangles));
		this.position = position;
		this.triangles = triangles;
		this.extent = extent;
		this.group = new THREE.Group();
		this.geometry = new THREE.BufferGeometry();
		if (triangles)
			this.beSurface();
		else
			this.bePoints(normal);
		this.beMark();
	}

	beSurface() {
		this.solid = new Solid(this.position, this.triangles);
		this.body = new THREE.Mesh(this.geometry, this.materials.body);
		this.body.castShadow = true;
		this.group.add(this.body);
		this.shape(this.solid);
		this.source = this.triangles;
	}

	/* So large that they about cover the surface. */
	bePoints(normal) {
		const n = this.position.length / 3;

		this.materials.body.uniforms.size.value = 2.2 * spacingOf(this.position);
		this.shape({ position: this.position, normal: normal ? Float32Array.from(normal) :
			new Float32Array(3 * n) });
		this.source = Uint32Array.from({ length: n }, (_, v) => v);
		this.group.add(new THREE.Points(this.geometry, this.materials.body));
	}

	beMark() {
		const geometry = new THREE.BufferGeometry();

		geometry.setAttribute("position", attribute(new Float32Array(3), 3));
		this.mark = new THREE.Points(geometry, this.materials.mark);
		this.mark.frustumCulled = false;
		this.mark.visible = false;
		this.mark.renderOrder = 1;
		this.group.add(this.mark);
	}

	shape({ position, normal }) {
		this.geometry.setAttribute("position", attribute(position, 3));
		this.geometry.setAttribute("normal", attribute(normal, 3));
		this.geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 2 * this.extent);
	}

	/* The same vertices at other places. */
	move(position) {
		this.position.set(position);
		this.solid.move(this.position);
		for (const name of ["position", "normal"])
			this.geometry.attributes[name].needsUpdate = true;
		this.geometry.boundingSphere.radius = Infinity; /* always in view: it may go anywhere */
		if (this.edges)
			this.edges.geometry.attributes.position.needsUpdate = true;
		if (this.mark.visible)
			this.pointTo(this.marked);
	}

	/* Three bytes a drawn vertex: those of its row. */
	colorBy(rows, rowOf) {
		const out = new Uint8Array(3 * this.source.length);

		for (let k = 0; k < this.source.length; k++)
			for (let c = 0, row = 3 * rowOf(k); c < 3; c++)
				out[3 * k + c] = rows[row + c];
		this.geometry.setAttribute(this.solid ? "color" : "tint", attribute(out, 3, true));
	}

	/* colors: three bytes a vertex, or a face where perFace; null: plain. */
	paint(colors, perFace) {
		const { source } = this, rowOf = perFace ? (k) => Math.floor(k / 3) : (k) => source[k];

		this.undress();
		this.colorBy(colors || PLAIN, colors ? rowOf : () => 0);
	}

	/* Gives vertices another colour. */
	repaint(vertices, color) {
		const { color: ofSurface, tint } = this.geometry.attributes, colors = ofSurface || tint;

		for (const k of this.solid ? this.solid.corners(vertices) : vertices)
			colors.array.set(color, 3 * k);
		colors.needsUpdate = true;
	}

	undress() {
		this.geometry.clearGroups();
		this.geometry.setIndex(null);
		this.geometry.deleteAttribute("uv");
		if (this.body)
			this.body.material = this.materials.body;
	}

	/* Dresses a surface (pictures.js): faces of one look are drawn together. */
	wear({ looks, faces, places }) {
		const order = Uint32Array.from(faces.keys()).sort((a, b) => faces[a] - faces[b] || a - b), groups = [];

		this.undress();
		this.colorBy(looks.flatMap(({ texture, color }) => (texture ? WHITE : color)), (k) =>
			faces[Math.floor(k / 3)]);
		this.geometry.setAttribute("uv", attribute(places, 2));
		this.geometry.setIndex(attribute(Uint32Array.from({ length: 3 * order.length }, (_, k) =>
			3 * order[Math.floor(k / 3)] + k % 3), 1));
		order.forEach((f, i) => {
			if (groups.length === 0 || groups[groups.length - 1].look !== faces[f])
				groups.push({ look: faces[f], start: 3 * i });
		});
		groups.forEach(({ start }, i) => this.geometry.addGroup(start,
			(i + 1 < groups.length ? groups[i + 1].start : 3 * order.length) - start, i));
		this.body.material = groups.map(({ look }) => wornMaterial(this.materials, looks[look].texture));
	}

	look(flat, wire) {
		if (!this.solid)
			return;
		for (const body of bodies(this.materials)) {
			body.polygonOffset = wire; /* so that faces do not hide their edges */
			if (body.flatShading !== flat) {
				body.flatShading = flat;
				body.needsUpdate = true;
			}
		}
		if (wire && !this.edges)
			this.beEdges();
		if (this.edges)
			this.edges.visible = wire;
	}

	beEdges() {
		const geometry = new THREE.BufferGeometry();

		geometry.setAttribute("position", attribute(this.position, 3));
		geometry.setIndex(attribute(edgesOf(this.triangles), 1));
		geometry.boundingSphere = this.geometry.boundingSphere;
		this.edges = new THREE.LineSegments(geometry, this.materials.edge);
		this.group.add(this.edges);
	}

	/* Marks a vertex; null: none. */
	pointTo(vertex) {
		this.mark.visible = vertex !== null;
		this.marked = vertex;
		if (vertex === null)
			return;
		this.mark.geometry.attributes.position.array.set(this.position.subarray(3 * vertex, 3 * vertex + 3));
		this.mark.geometry.attributes.position.needsUpdate = true;
	}

	/* Pixels that a unit has at distance 1. */
	scale(pixels) {
		this.materials.mark.uniforms.scale.value = pixels;
		if (!this.solid)
			this.materials.body.uniforms.scale.value = pixels;
	}

	/* Frees what the graphics card has of it, but for materials that it shares with `after`. */
	dispose(after) {
		if (this.solid)
			this.solid.free();
		for (const child of this.group.children)
			child.geometry.dispose();
		if (!after || after.materials !== this.materials)
			for (const material of [...bodies(this.materials), this.materials.edge, this.materials.mark])
				material.dispose();
	}
}
