/* drawn.js -- one layer as three.js draws it: a surface with its edges, or points as small balls, and the vertex that was picked. */
import * as THREE from "three/build/three.module.js";
import { PLAIN, regionColor } from "./colors.js";
import { bodies, materialsFor, wornMaterial } from "./materials.js";
import { apart, gather } from "../mesh/seams.js";
import { Solid } from "../mesh/solid.js";
import { edgesOf, spacingOf } from "../mesh/surface.js";

const attribute = (array, size, normalized) => new THREE.BufferAttribute(array, size, normalized);

/* Three bytes a drawn vertex: of the row it stands for, or plain. */
function spread(colors, source, count) {
	const out = new Uint8Array(3 * count);

	for (let i = 0; i < count; i++) {
		const row = 3 * (source ? source[i] : i);
		for (let c = 0; c < 3; c++)
			out[3 * i + c] = colors ? colors[row + c] : PLAIN[c];
	}
	return out;
}

/*
 * What is drawn of a layer; `position` and `triangles` are those of the stream, around the centre.  before: what was
 * drawn of it in another frame, or undefined.
 */
export class Drawn {
	constructor(position, triangles, normal, extent, before) {
		const again = before && before.materials.surface === Boolean(triangles);

		this.materials = again ? before.materials : materialsFor(Boolean(triangles));
		this.position = position;
		this.triangles = triangles;
		this.extent = extent;
		this.group = new THREE.Group();
		this.geometry = new THREE.BufferGeometry();
		this.parts = null; /* how vertices are parted (seams.js); null: they are those of the surface */
		if (triangles)
			this.beSurface();
		else
			this.bePoints(normal);
		this.beMark();
	}

	beSurface() {
		this.solid = new Solid(this.position, this.triangles);
		this.body = new THREE.Mesh(this.geometry, this.materials.body);
		this.group.add(this.body);
		this.shape(this.solid);
	}

	/* So large that they about cover the surface. */
	bePoints(normal) {
		const n = this.position.length / 3;

		this.materials.body.uniforms.size.value = 2.2 * spacingOf(this.position);
		this.shape({ position: this.position, normal: normal ? Float32Array.from(normal) : new Float32Array(3 * n), index: null, source: null });
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

	shape(arrays) {
		this.source = arrays.source;
		this.count = arrays.position.length / 3;
		this.geometry.setAttribute("position", attribute(arrays.position, 3));
		this.geometry.setAttribute("normal", attribute(arrays.normal, 3));
		for (const name of ["color", "tint", "uv"])
			this.geometry.deleteAttribute(name);
		this.geometry.clearGroups();
		if (this.body)
			this.body.material = this.materials.body;
		this.geometry.setIndex(arrays.index ? attribute(arrays.index, 1) : null);
		this.geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 2 * this.extent);
	}

	/* The same vertices at other places. */
	move(position) {
		this.position.set(position);
		this.solid.move(this.position);
		this.solid.shade(this.position);
		const arrays = this.parts ? gather(this.solid, this.parts) : this.solid;
		for (const name of ["position", "normal"]) {
			const { array } = this.geometry.attributes[name];
			if (array !== arrays[name])
				array.set(arrays[name]);
			this.geometry.attributes[name].needsUpdate = true;
		}
		this.geometry.boundingSphere.radius = Infinity; /* always in view: it may go anywhere */
		if (this.edges)
			this.edges.geometry.attributes.position.needsUpdate = true;
		if (this.mark.visible)
			this.pointTo(this.marked);
	}

	/* colors: three bytes a vertex, or a face where perFace; null: plain. */
	paint(colors, perFace) {
		this.part(perFace);
		this.geometry.setAttribute(this.solid ? "color" : "tint", attribute(spread(colors, this.source, this.count), 3, true));
	}

	part(perFace) {
		if (!this.solid || (perFace ? this.parts && !this.worn : !this.parts))
			return;
		this.worn = false;
		this.parts = perFace ? apart(this.solid) : null;
		this.shape(perFace ? { ...this.parts, ...gather(this.solid, this.parts) } : this.solid);
	}

	/* Dresses a surface (pictures.js): faces of one look stand together. */
	wear({ looks, faces, places }) {
		const order = Uint32Array.from(faces.keys()).sort((a, b) => faces[a] - faces[b] || a - b), n = 3 * faces.length;
		const color = new Uint8Array(3 * n), uv = new Float32Array(2 * n), groups = [];

		this.worn = true;
		this.parts = apart(this.solid, order);
		this.shape({ ...this.parts, ...gather(this.solid, this.parts) });
		order.forEach((f, i) => {
			const look = faces[f], { texture, color: plain } = looks[look];
			for (let k = 3 * i; k < 3 * i + 3; k++)
				color.set(texture ? [255, 255, 255] : plain, 3 * k);
			uv.set(places.subarray(6 * f, 6 * f + 6), 6 * i);
			if (groups.length === 0 || groups[groups.length - 1].look !== look)
				groups.push({ look, start: 3 * i });
		});
		this.geometry.setAttribute("color", attribute(color, 3, true));
		this.geometry.setAttribute("uv", attribute(uv, 2));
		groups.forEach(({ start }, i) => this.geometry.addGroup(start, (i + 1 < groups.length ? groups[i + 1].start : n) - start, i));
		this.body.material = groups.map(({ look }) => wornMaterial(this.materials, looks[look].texture));
	}

	/* Paints other regions at some vertices of what was painted by regions. */
	repaintRegions(values, vertices) {
		const { color, tint } = this.geometry.attributes, changed = color || tint;

		for (const v of vertices)
			changed.array.set(regionColor(values[v]), 3 * v);
		for (let i = values.length; this.source && i < this.source.length; i++)
			changed.array.set(regionColor(values[this.source[i]]), 3 * i);
		changed.needsUpdate = true;
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
