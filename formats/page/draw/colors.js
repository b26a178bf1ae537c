/* colors.js -- colours for numbers and for kinds: those of mr-render. */

/* Even steps of viridis (van der Walt, Smith 2015), and of RdBu, blue first (Brewer 2002). */
const SEQUENTIAL = [68, 1, 84, 71, 44, 122, 59, 81, 139, 44, 113, 142, 33, 144, 141, 39, 173, 129, 92, 200, 99, 170, 220, 50, 253, 231, 37];
const DIVERGING = [33, 102, 172, 67, 147, 195, 146, 197, 222, 209, 229, 240, 247, 247, 247, 253, 219, 199, 244, 165, 130, 214, 96, 77, 178, 24, 43];
const KINDS = [[82, 168, 96], [238, 146, 58], [150, 112, 190], [226, 190, 62], [214, 92, 92], [70, 178, 178], [205, 120, 170], [150, 118, 92], [110, 140, 60], [92, 112, 200]];
export const PLAIN = [212, 204, 193];
const NOTHING = [170, 168, 164];
const NONE = 0xffffffff;

/* 256 steps between the colours of a table, as bytes. */
function steps(table) {
	const out = new Uint8Array(3 * 256), last = table.length / 3 - 1;

	for (let i = 0; i < 256; i++) {
		const x = i / 255 * last, k = Math.min(Math.floor(x), last - 1);
		for (let c = 0; c < 3; c++)
			out[3 * i + c] = Math.round(table[3 * k + c] + (table[3 * k + 3 + c] - table[3 * k + c]) * (x - k));
	}
	return out;
}

const MAPS = { sequential: steps(SEQUENTIAL), diverging: steps(DIVERGING) };

/* The map for a range: where both signs are in it, white is 0 only where the range is even. */
export function mapOf(range) {
	return MAPS[range.low < 0 && range.high > 0 ? "diverging" : "sequential"];
}

/* A colour of its own for each kind; further ones are the same, paler. */
export function kindColor(kind) {
	const round = Math.floor(kind / KINDS.length) % 4;

	return kind === NONE ? NOTHING : KINDS[kind % KINDS.length].map((c) => Math.round(c + (235 - c) * 0.2 * round));
}

/* Fixed grey, free blue, handles as kinds. */
export function regionColor(region) {
	return region === 0 ? [190, 186, 180] : region === 1 ? [92, 146, 214] : kindColor(region - 2);
}

export function regionName(region) {
	return region === 0 ? "fixed" : region === 1 ? "free" : "handle " + (region - 2);
}

/* Bytes of three a number by the map; what is not finite is grey. */
export function numbersToColors(numbers, range) {
	const map = mapOf(range), out = new Uint8Array(3 * numbers.length);
	const scale = range.high > range.low ? 255 / (range.high - range.low) : 0;

	for (let i = 0; i < numbers.length; i++) {
		const x = (numbers[i] - range.low) * scale;
		const known = Number.isFinite(numbers[i]), k = 3 * Math.round(x > 0 ? Math.min(x, 255) : 0);
		for (let c = 0; c < 3; c++)
			out[3 * i + c] = known ? map[k + c] : NOTHING[c];
	}
	return out;
}
