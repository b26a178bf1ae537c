/* save.js -- files out of the page: a picture of what is seen, and the surfaces as a GLB (glTF 2.0). */
import { PLAIN } from "./draw/colors.js";
import { TEXTURE } from "./stream/layers.js";
import { fileOf } from "./stream/stream.js";
import { save } from "./stream/text.js";

const $ = (id) => document.getElementById(id);
const WHITE = [255, 255, 255];
const FLOAT = 5126, WHOLE = 5125; /* types of glTF */

/* Colours are linear there (IEC 61966-2-1). */
const linear = (byte) => (byte > 10 ? ((byte / 255 + 0.055) / 1.055) ** 2.4 : byte / 255 / 12.92);

/* The corners of a surface that differ, one of each vertex where they are alike, and which of them each corner is. */
function distinct({ triangles, position }, attributes) {
	const newest = new Int32Array(position.length / 3).fill(-1), before = [], corners = [];
	const alike = (a, b) => attributes.every(({ array, itemSize: n }) =>
		array.subarray(n * a, n * a + n).every((x, c) => x === array[n * b + c]));
	const index = Uint32Array.from(triangles, (v, k) => {
		let at = newest[v];
		while (at >= 0 && !alike(corners[at], k))
			at = before[at];
		if (at < 0) {
			at = corners.push(k) - 1;
			before.push(newest[v]);
			newest[v] = at;
		}
		return at;
	});

	return { corners, index };
}

class Glb {
	constructor() {
		this.json = { asset: { version: "2.0", generator: "mr-view" }, scene: 0, scenes: [{ nodes: [] }] };
		this.parts = [];
		this.size = 0;
	}

	put(list, what) {
		this.json[list] = this.json[list] || [];
		return this.json[list].push(what) - 1;
	}

	view(bytes) {
		const { byteLength } = bytes, byteOffset = this.size;

		this.parts.push(bytes, new Uint8Array(-byteLength & 3));
		this.size += byteLength + (-byteLength & 3);
		return this.put("bufferViews", { buffer: 0, byteOffset, byteLength });
	}

	/* n floats a row, or whole numbers; more: the rest of it. */
	accessor(values, n, more) {
		return this.put("accessors", { bufferView: this.view(values), componentType: n ? FLOAT : WHOLE,
			type: n ? "VEC" + n : "SCALAR", count: values.length / (n || 1), ...more });
	}

	/* The attribute at these corners. */
	attribute({ array, itemSize: n }, corners, of = (x) => x) {
		const values = Float32Array.from({ length: n * corners.length }, (_, i) =>
			of(array[n * corners[Math.floor(i / n)] + i % n], i % n));
		const ends = (end, from) => Array.from({ length: n }, (_, c) =>
			values.reduce((most, x, i) => (i % n === c ? end(most, x) : most), from));

		return this.accessor(values, n, { min: ends(Math.min, Infinity), max: ends(Math.max, -Infinity) });
	}

	material(map, color) {
		const pbrMetallicRoughness = { baseColorFactor: [...color.map(linear), 1], metallicFactor: 0 };

		if (map) {
			const image = this.put("images", { bufferView: this.view(map.bytes),
				mimeType: map.bytes[0] === 0xff ? "image/jpeg" : "image/png" });
			pbrMetallicRoughness.baseColorTexture = { index: this.put("textures", { source: image }) };
		}
		return this.put("materials", { doubleSided: true, pbrMetallicRoughness });
	}

	/* colored: whether it has a colour for each corner; else it has those of its looks, or is plain. */
	layer(name, drawn, centre, colored) {
		const { position, normal, color, uv } = drawn.geometry.attributes, order = drawn.geometry.index;
		const all = { POSITION: position, NORMAL: normal, ...(colored && { COLOR_0: color }),
			...(uv && { TEXCOORD_0: uv }) };
		const { corners, index } = distinct(drawn, Object.values(all)),
			how = { COLOR_0: linear, TEXCOORD_0: (x, c) => (c ? 1 - x : x) };
		const attributes = Object.fromEntries(Object.entries(all).map(([key, of]) =>
			[key, this.attribute(of, corners, how[key])]));
		const primitives = (order ? drawn.geometry.groups : [{}]).map(({ start, count }, g) => {
			if (!order)
				return { attributes, indices: this.accessor(index),
					material: this.material(null, colored ? WHITE : PLAIN) };
			const part = order.array.subarray(start, start + count), first = 3 * part[0];
			return { attributes, indices: this.accessor(part.map((k) => index[k])),
				material: this.material(drawn.body.material[g].map,
					Array.from(color.array.subarray(first, first + 3))) };
		});
		const mesh = this.put("meshes", { name, primitives });
		this.json.scenes[0].nodes.push(this.put("nodes", { name, mesh, translation: centre }));
	}

	/* The pieces of the file. */
	pieces() {
		this.put("buffers", { byteLength: this.size });
		const json = new TextEncoder().encode(JSON.stringify(this.json)), blanks = " ".repeat(-json.length & 3),
			size = json.length + blanks.length;
		return [Uint32Array.of(0x46546c67, 2, 28 + size + this.size, size, 0x4e4f534a), json, blanks,
			Uint32Array.of(this.size, 0x4e4942), ...this.parts];
	}
}

/* The surfaces that are seen, as they are posed, in their colours, unless these are those of regions. */
function glbOf(app) {
	const glb = new Glb(), colored = !["", "region", TEXTURE].includes(app.color);

	for (const [name, drawn] of app.stage.layers.filter(([, { solid }]) => solid))
		glb.layer(name, drawn, app.centre, colored);
	return glb.pieces();
}

/* Without what handles are dragged by. */
function picture(app) {
	const { gizmo } = app.stage, there = gizmo.offered;

	gizmo.offer(false);
	app.stage.draw();
	$("canvas").toBlob((blob) => save(fileOf(app.shown.frame) + ".png", blob));
	gizmo.offer(there);
}

export function connectSave(app) {
	$("save-picture").addEventListener("click", () => picture(app));
	$("save-glb").addEventListener("click", () => save(fileOf(app.shown.frame) + ".glb", ...glbOf(app)));
	$("full").addEventListener("click", () => (document.fullscreenElement ? document.exitFullscreen() :
		document.documentElement.requestFullscreen()));
}
