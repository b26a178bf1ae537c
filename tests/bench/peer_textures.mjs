// meshoptimizer's simplifyWithAttributes on the meshes of a GLB; usage: node peer_textures.mjs FOLDER IN.glb OUT.glb RATIO [FLAG...]
// FOLDER is where the package meshoptimizer is.  Texture coordinates weigh 1, as its documentation has it for values up to 1;
// no vertex is locked, and the error has no limit.  Prints the triangles that are left.
import fs from "fs";
import path from "path";
import { pathToFileURL } from "url";

const [folder, from, to, ratio, ...flags] = process.argv.slice(2);
const { MeshoptSimplifier: simplifier } = await import(pathToFileURL(path.resolve(folder, "meshopt_simplifier.js")));
const ARRAYS = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3 };
const file = fs.readFileSync(from), length = file.readUInt32LE(12);
const gltf = JSON.parse(file.subarray(20, 20 + length)), parts = [file.subarray(28 + length)];
let bytes = parts[0].length, left = 0;

function read(number) { // an accessor's numbers
	const a = gltf.accessors[number], view = gltf.bufferViews[a.bufferView], width = WIDTHS[a.type];
	const Kind = ARRAYS[a.componentType], row = width * Kind.BYTES_PER_ELEMENT, values = new Kind(a.count * width);
	const begin = (view.byteOffset ?? 0) + (a.byteOffset ?? 0);
	for (let k = 0; k < a.count; k++) {
		const at = begin + k * (view.byteStride ?? row);
		values.set(new Kind(new Uint8Array(parts[0].subarray(at, at + row)).buffer), k * width);
	}
	return values;
}

await simplifier.ready;
for (const mesh of gltf.meshes)
	for (const p of mesh.primitives) {
		const position = read(p.attributes.POSITION), triangles = Uint32Array.from(read(p.indices));
		const coordinates = p.attributes.TEXCOORD_0 === undefined
			? new Float32Array(position.length / 3 * 2) : read(p.attributes.TEXCOORD_0);
		const most = Math.round(triangles.length / 3 * ratio) * 3;
		const [result] = simplifier.simplifyWithAttributes(triangles, position, 3, coordinates, 2, [1, 1], null, most, 1e9, flags);
		parts.push(Buffer.from(Uint32Array.from(result).buffer));
		gltf.bufferViews.push({ buffer: 0, byteOffset: bytes, byteLength: result.length * 4 });
		p.indices = gltf.accessors.push({
			bufferView: gltf.bufferViews.length - 1, componentType: 5125, count: result.length, type: "SCALAR",
		}) - 1;
		bytes += result.length * 4;
		left += result.length / 3;
	}
gltf.buffers[0].byteLength = bytes;
const text = JSON.stringify(gltf), json = Buffer.from(text.padEnd(text.length + 3 - (Buffer.byteLength(text) + 3) % 4));
const head = Buffer.alloc(20), between = Buffer.alloc(8);
[0x46546c67, 2, 28 + json.length + bytes, json.length, 0x4e4f534a].forEach((word, k) => head.writeUInt32LE(word, 4 * k));
[bytes, 0x4e4942].forEach((word, k) => between.writeUInt32LE(word, 4 * k));
fs.writeFileSync(to, Buffer.concat([head, json, between, ...parts]));
console.log(left);
