/* load.js -- unpacks the page's program and runs it: as text it would be half of a small page. */
(async () => {
	const element = document.getElementById("program"), message = document.getElementById("message");

	if (typeof DecompressionStream === "undefined") {
		message.textContent = "This browser is too old for the page: it has no DecompressionStream.";
		return;
	}
	const packed = Uint8Array.from(atob(element.textContent), (c) => c.charCodeAt(0));
	const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
	const script = document.createElement("script");
	script.textContent = await new Response(stream).text();
	element.remove();
	document.body.append(script);
	script.remove();
})();
