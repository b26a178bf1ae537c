/*
 * sharp.js -- regions of vertices with sharp borders: a place of a triangle has the region that most of it belongs to, by
 * the corners' weights there, so that a border runs through the middles of edges and no colour is mixed of two.
 */
const SLOTS = 12;

/* Every corner weighs in the slot of its region alone. */
const VERTEX = `
attribute float slot;
varying vec4 vSlots[3];
#include <common>`;
const VERTEX_MAIN = `
for (int i = 0; i < 3; i++)
	vSlots[i] = 1.0 - step(0.5, abs(vec4(0.0, 1.0, 2.0, 3.0) + 4.0 * float(i) - slot));
#include <begin_vertex>`;

const FRAGMENT = `
uniform float sharp;
uniform vec3 slotColors[12];
varying vec4 vSlots[3];
void weigh(float weight, vec3 color, inout vec2 most, inout vec3 first, inout vec3 second) {
	if (weight > most.x) {
		most = vec2(weight, most.x);
		second = first;
		first = color;
	} else if (weight > most.y) {
		most.y = weight;
		second = color;
	}
}
#include <common>`;

/* A pixel wide the two that weigh most are mixed, so that borders have no steps. */
const FRAGMENT_MAIN = `
#include <color_fragment>
if (sharp > 0.5) {
	vec2 most = vec2(-1.0);
	vec3 first = vec3(0.0), second = vec3(0.0);
${Array.from({ length: SLOTS }, (_, i) => `	weigh(vSlots[${i >> 2}].${"xyzw"[i & 3]}, slotColors[${i}], most, first, second);`).join("\n")}
	float lead = most.x - most.y;
	diffuseColor.rgb = mix(second, first, clamp(0.5 + lead / max(fwidth(lead), 1e-6), 0.5, 1.0));
}`;

/* Uniforms of one material: whether it is sharp, and the colours of the slots. */
export function sharpness() {
	return { sharp: { value: 0 }, slotColors: { value: new Float32Array(3 * SLOTS) } };
}

/* Teaches the shader of a surface's material. */
export function sharpen(shader, uniforms) {
	Object.assign(shader.uniforms, uniforms);
	shader.vertexShader = shader.vertexShader.replace("#include <common>", VERTEX).replace("#include <begin_vertex>", VERTEX_MAIN);
	shader.fragmentShader = shader.fragmentShader.replace("#include <common>", FRAGMENT).replace("#include <color_fragment>", FRAGMENT_MAIN);
}

/* Which region has which slot: as they come. */
export class Slots {
	/* colors: of the material; colorOf(region): three bytes. */
	constructor(colors, colorOf) {
		this.colors = colors;
		this.colorOf = colorOf;
		this.slot = new Map();
	}

	/* -1: there are too many regions. */
	of(region) {
		const there = this.slot.get(region);

		if (there !== undefined || this.slot.size === SLOTS)
			return there === undefined ? -1 : there;
		const slot = this.slot.size;
		this.colors.set(this.colorOf(region).map((x) => x / 255), 3 * slot);
		this.slot.set(region, slot);
		return slot;
	}

	/* Gives drawn vertices their slots: the first stand for themselves, others for their source; null: too many regions. */
	all(values, source, count) {
		const out = new Uint8Array(count);

		for (let v = 0; v < values.length; v++) {
			const slot = v > 0 && values[v] === values[v - 1] ? out[v - 1] : this.of(values[v]);
			if (slot < 0)
				return null;
			out[v] = slot;
		}
		this.copy(out, values.length, source);
		return out;
	}

	/* The vertices behind the first n as their sources. */
	copy(slots, n, source) {
		for (let i = n; i < slots.length; i++)
			slots[i] = slots[source[i]];
	}
}
