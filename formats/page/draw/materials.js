/* materials.js -- what layers are drawn with: lit surfaces, with a picture on them or none, edges, points as small
 * balls. */
import * as THREE from "three/build/three.module.js";

const POINT_VERTEX = `
uniform float size, scale, least, most;
attribute vec3 tint;
varying vec3 vTint, vNormal;
void main() {
	vec4 at = modelViewMatrix * vec4(position, 1.0);
	vTint = tint;
	vNormal = normalMatrix * normal;
	gl_Position = projectionMatrix * at;
	gl_PointSize = clamp(size * scale / -at.z, least, most);
}`;

/* A ball where nothing is known of the surface, else a disc that is lit as the surface there is. */
const POINT_FRAGMENT = `
varying vec3 vTint, vNormal;
void main() {
	vec2 at = 2.0 * gl_PointCoord - 1.0;
	float out2 = dot(at, at);
	if (out2 > 1.0)
		discard;
	vec3 n = dot(vNormal, vNormal) > 0.0 ? normalize(vNormal) : vec3(at.x, -at.y, sqrt(1.0 - out2));
	n = n.z < 0.0 ? -n : n;
	gl_FragColor = vec4(vTint * (0.45 + 0.6 * max(dot(n, normalize(vec3(-0.3, 0.5, 0.9))), 0.0)), 1.0);
}`;

const MARK_FRAGMENT = `
void main() {
	float out2 = dot(2.0 * gl_PointCoord - 1.0, 2.0 * gl_PointCoord - 1.0);
	if (out2 > 1.0)
		discard;
	gl_FragColor = out2 > 0.45 ? vec4(1.0) : vec4(0.85, 0.1, 0.15, 1.0);
}`;

function pointMaterial(fragmentShader, uniforms, more) {
	return new THREE.ShaderMaterial({
		vertexShader: POINT_VERTEX,
		fragmentShader,
		uniforms: { scale: { value: 1 }, ...Object.fromEntries(Object.entries(uniforms).map(([k, value]) =>
			[k, { value }])) },
		...more,
	});
}

/* Shaded by the light of the eye; the inside is bluish, as in mr-render.  map: the picture on it, or null. */
function surfaceMaterial(map) {
	const material = new THREE.MeshPhongMaterial({
		map,
		vertexColors: THREE.VertexColors,
		specular: 0x121212,
		shininess: 24,
		side: THREE.DoubleSide,
		polygonOffsetFactor: 1,
		polygonOffsetUnits: 1,
	});

	material.extensions = { derivatives: true };
	material.onBeforeCompile = (shader) => {
		shader.fragmentShader = shader.fragmentShader.replace("#include <color_fragment>",
			"#include <color_fragment>\nif (!gl_FrontFacing) diffuseColor.rgb *= vec3(0.66, 0.78, 0.98);");
	};
	return material;
}

function edgeMaterial() {
	return new THREE.LineBasicMaterial({ color: 0x1a2230, transparent: true, opacity: 0.2, depthWrite: false });
}

/* What a layer is drawn with, which serves its later frames as well: a shader is compiled once. */
export function materialsFor(surface) {
	return {
		surface,
		body: surface ? surfaceMaterial(null) : pointMaterial(POINT_FRAGMENT, { size: 1, least: 2, most: 24 }),
		worn: new Map(), /* by the texture: the body's, with that */
		edge: edgeMaterial(),
		mark: pointMaterial(MARK_FRAGMENT, { size: 1, least: 13, most: 13 },
			{ depthTest: false, transparent: true }),
	};
}

/* All that bodies are made of. */
export const bodies = (materials) => [materials.body, ...materials.worn.values()];

/* The body's, with a picture, or none (null). */
export function wornMaterial({ worn, body }, texture) {
	if (texture && !worn.has(texture))
		worn.set(texture, surfaceMaterial(texture));
	return texture ? worn.get(texture) : body;
}
