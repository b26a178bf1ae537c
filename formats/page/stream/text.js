/* text.js -- names and numbers for people.  A name is foreign: it is only ever text, and keeps to its place in a
 * line. */

/* Controls, and what turns the direction of the text around, are shown as signs. */
const UNSEEN = /[\u0000-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/g;

export function plain(name) {
	return name.replace(UNSEEN, "\ufffd");
}

/* A new element with a foreign text in it. */
export function element(kind, name, className) {
	const made = document.createElement(kind);

	made.textContent = plain(name);
	if (className)
		made.className = className;
	return made;
}

/* 1234567 as 1,234,567. */
export function count(n) {
	return n.toLocaleString("en");
}

/* A number of 24 bits, without digits that it does not have. */
export function number(x) {
	return Number.isFinite(x) ? String(Number(x.toPrecision(8))) : String(x);
}

/* Coordinates of a model of this extent, to the same number of decimals. */
export function place(coordinates, extent) {
	const decimals = extent > 0 ? Math.min(Math.max(7 - Math.floor(Math.log10(extent)), 0), 30) : 8;

	return coordinates.map((x) => String(Number(x.toFixed(decimals)))).join("  ");
}

/* Copies what an element says; the clipboard is not there for every page from the disk: then what is selected is
 * copied. */
export async function copy(of) {
	const button = of.parentElement.querySelector("button"), text = of.textContent;

	if (!navigator.clipboard || !await navigator.clipboard.writeText(text).then(() => true, () => false)) {
		getSelection().selectAllChildren(of);
		document.execCommand("copy");
	}
	button.classList.add("copied");
	setTimeout(() => button.classList.remove("copied"), 1200);
}

/* A file of these parts. */
export function save(name, ...parts) {
	const link = document.createElement("a");

	link.href = URL.createObjectURL(new Blob(parts));
	link.download = name;
	link.click();
	setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
