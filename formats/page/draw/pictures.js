/* pictures.js -- the pictures of the page, decoded when they are asked for, and what a layer looks like that wears
 * them: pictures and colours of its faces. */
import * as THREE from "three/build/three.module.js";
import { PLAIN } from "./colors.js";

const MOST = 8192; /* pixels a side, where the graphics card takes more */

/* As many as the graphics card has to have of a picture that repeats: a power of two. */
const powerOf = (n, most) => Math.min(2 ** Math.ceil(Math.log2(n)), most);

/* The same over white, where it is transparent. */
function paper(bitmap, most) {
	const canvas = document.createElement("canvas"), context = canvas.getContext("2d");

	canvas.width = powerOf(bitmap.width, most);
	canvas.height = powerOf(bitmap.height, most);
	context.fillStyle = "white";
	context.fillRect(0, 0, canvas.width, canvas.height);
	context.imageSmoothingQuality = "high";
	context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
	return canvas;
}

export class Pictures {
	/* blocks: the bytes of each. */
	constructor(blocks, renderer) {
		this.blocks = blocks;
		this.renderer = renderer;
		this.made = []; /* a promise of each that was asked for */
	}

	/* A promise of the texture; null where the browser does not read it. */
	texture(i) {
		this.made[i] = this.made[i] || this.make(this.blocks[i]).catch(() => null);
		return this.made[i];
	}

	async make(bytes) {
		const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: "none" });
		const texture = new THREE.CanvasTexture(paper(bitmap,
			Math.min(this.renderer.capabilities.maxTextureSize, MOST)));

		bitmap.close();
		texture.bytes = bytes;
		texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
		texture.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
		return texture;
	}
}

/* Looks of a layer, { texture, color }, the first of them plain; and which of them a material has: Map. */
async function looksOf(wears, pictures) {
	const looks = [{ texture: null, color: PLAIN }], of = new Map();

	if (wears.texture !== null)
		looks.push({ texture: await pictures.texture(wears.texture), color: PLAIN });
	for (const [material, { color, picture }] of wears.materials) {
		of.set(material, looks.length);
		looks.push({ texture: picture === null ? null : await pictures.texture(picture), color: color ||
			PLAIN });
	}
	return { looks, of };
}

/* u and v of each corner, NaN where there are none. */
function placesOf(column, values, t) {
	if (!column)
		return new Float32Array(2 * t.length).fill(NaN);
	if (column.components === 6)
		return Float32Array.from(values);
	const out = new Float32Array(2 * t.length);
	for (let k = 0; k < t.length; k++) {
		out[2 * k] = values[2 * t[k]];
		out[2 * k + 1] = values[2 * t[k] + 1];
	}
	return out;
}

/* Whether the face at corner k has a place in the picture; where it has none its corners are put to 0. */
function placed(places, k) {
	let there = true;

	for (let i = 2 * k; i < 2 * k + 6; i++)
		there = there && Number.isFinite(places[i]);
	if (!there)
		places.fill(0, 2 * k, 2 * k + 6);
	return there;
}

/* What a layer wears: the looks, which of them each face has, and the place of each corner.  A face without a place in
 * its picture has the colour of its material. */
export async function costumeOf(layer, pictures) {
	const { looks, of } = await looksOf(layer.wears, pictures), t = await layer.triangles.values();
	const places = placesOf(layer.texcoord, layer.texcoord && await layer.texcoord.values(), t),
		faces = new Uint32Array(t.length / 3);
	const material = layer.wears.texture === null && layer.material ? await layer.material.values() : null,
		bare = looks.map(() => 0);

	for (let f = 0; f < faces.length; f++) {
		const look = material ? of.get(material[f]) || 0 : 1;
		faces[f] = placed(places, 3 * f) || !looks[look].texture ? look : bare[look] ||
			(bare[look] = looks.push({ texture: null, color: looks[look].color }) - 1);
	}
	return { looks, faces, places };
}
