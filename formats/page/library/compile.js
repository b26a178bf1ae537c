/* compile.js -- the library of the page, once it is compiled. */
import { Library } from "./library.js";

export let library;

/* Before anything asks for it; bytes: of its code, packed. */
export async function begin(bytes) {
	const code = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));

	library = new Library((await WebAssembly.instantiate(await new Response(code).arrayBuffer())).instance.exports);
}
