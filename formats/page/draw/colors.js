/* colors.js -- colours for numbers and for kinds: those of mr-render. */
import { library } from "../library/compile.js";

export const PLAIN = [212, 204, 193];
const NOTHING = 0xffffffff; /* the kind of what has none */

const bytesOf = (color) => [color & 255, color >> 8 & 255, color >> 16 & 255];

/* A colour of its own for each kind; fixed grey, free blue, handles as kinds. */
export const kindColor = (kind) => bytesOf(library.run.color_kind(kind));
export const regionColor = (region) => bytesOf(library.run.color_region(region));

/* 256 steps, as bytes, for a range: where both signs are in it, white is 0 only where the range is even. */
export function mapOf({ low, high }) {
	return Uint8Array.from(Array.from({ length: 256 }, (_, i) =>
		bytesOf(library.run.color_number(i / 255, low < 0 && high > 0))).flat());
}

export function regionName(region) {
	return region === 0 ? "fixed" : region === 1 ? "free" : "handle " + (region - 2);
}

/* Bytes of three a number by the map; what is not finite is grey. */
export function numbersToColors(numbers, range) {
	const map = mapOf(range), out = new Uint8Array(3 * numbers.length);
	const nothing = kindColor(NOTHING), scale = range.high > range.low ? 255 / (range.high - range.low) : 0;

	for (let i = 0; i < numbers.length; i++) {
		const x = (numbers[i] - range.low) * scale;
		const known = Number.isFinite(numbers[i]), k = 3 * Math.round(x > 0 ? Math.min(x, 255) : 0);
		for (let c = 0; c < 3; c++)
			out[3 * i + c] = known ? map[k + c] : nothing[c];
	}
	return out;
}
