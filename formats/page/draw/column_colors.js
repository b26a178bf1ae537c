/* column_colors.js -- a column's values as colours, and what a legend says of them. */
import { kindColor, numbersToColors, regionColor } from "./colors.js";

/* How a column colours, as in mr-render: bytes are colours, whole numbers kinds, the rest numbers. */
export function kindOf(column) {
	if (column.type === "b" && column.components >= 3)
		return "own";
	if (column.type === "u" && column.components === 1)
		return column.name === "region" ? "region" : "kind";
	return "number";
}

/* A row as one number: its only value, or the length of several. */
export function numberAt(column, values, row) {
	const n = column.components;
	let sum = 0;

	if (n === 1)
		return values[row];
	for (let c = 0; c < n; c++)
		sum += values[n * row + c] ** 2;
	return Math.sqrt(sum);
}

function numbersOf(column, values) {
	if (column.components === 1)
		return values;
	return Float64Array.from({ length: column.rows }, (_, i) => numberAt(column, values, i));
}

/* The least and the greatest finite number; the same both ways from 0 where both signs are there. */
export function rangeOf(column, values) {
	const numbers = numbersOf(column, values);
	let low = Infinity, high = -Infinity;

	for (let i = 0; i < numbers.length; i++)
		if (Number.isFinite(numbers[i])) {
			low = Math.min(low, numbers[i]);
			high = Math.max(high, numbers[i]);
		}
	if (low > high)
		return { low: 0, high: 0 };
	return low < 0 && high > 0 ? { low: -Math.max(-low, high), high: Math.max(-low, high) } : { low, high };
}

/* Kinds that are there, in order. */
export function kindsOf(values) {
	return [...new Set(values)].sort((a, b) => a - b);
}

function kindsToColors(values, colorOf) {
	const out = new Uint8Array(3 * values.length), known = new Map();

	for (let i = 0; i < values.length; i++) {
		if (!known.has(values[i]))
			known.set(values[i], colorOf(values[i]));
		out.set(known.get(values[i]), 3 * i);
	}
	return out;
}

function ownColors(column, values) {
	const out = new Uint8Array(3 * column.rows), n = column.components;

	for (let i = 0; i < column.rows; i++)
		for (let c = 0; c < 3; c++)
			out[3 * i + c] = values[n * i + c];
	return out;
}

/* Three bytes a row. */
export function paint(column, values, range) {
	switch (kindOf(column)) {
	case "own":
		return ownColors(column, values);
	case "region":
		return kindsToColors(values, regionColor);
	case "kind":
		return kindsToColors(values, kindColor);
	default:
		return numbersToColors(numbersOf(column, values), range);
	}
}
