/* data.js -- the bytes that stand in the page, in base64, as elements of the classes "stream" and "picture". */

/* What one element says, in bytes. */
function decode(text) {
	if (Uint8Array.fromBase64)
		return Uint8Array.fromBase64(text);
	return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

function join(parts) {
	const bytes = new Uint8Array(parts.reduce((n, p) => n + p.length, 0));
	let at = 0;

	for (const part of parts) {
		bytes.set(part, at);
		at += part.length;
	}
	return bytes;
}

/* The bytes of elements, which are taken out of the page. */
function take(which) {
	return [...document.querySelectorAll(which)].map((block) => {
		block.remove();
		return decode(block.textContent);
	});
}

export const takePictures = () => take("script.picture");
export const takeLibrary = () => take("#library")[0];

/* The stream. */
export const takeBytes = () => join(take("script.stream"));

/* The bytes of a model in a file beside the page: a script that calls mrPart with them, in base64. */
export async function takeBeside(file) {
	const parts = [], script = document.createElement("script");

	window.mrPart = (text) => parts.push(decode(text));
	await new Promise((done, fail) => {
		script.onload = done;
		script.onerror = () => fail(new Error("The file of this model is not beside the page: " + file));
		script.src = "./" + file;
		document.head.append(script);
	}).finally(() => script.remove());
	return join(parts);
}
