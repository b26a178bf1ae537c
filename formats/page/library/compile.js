/* compile.js -- the library, compiled once for the page and its workers. */
import code from "library.wasm";
import { Library } from "./library.js";

let compiled, loaded;

export function compile() {
	compiled = compiled || WebAssembly.compile(code);
	return compiled;
}

/* That of the page. */
export function library() {
	loaded = loaded || compile().then(Library.load);
	return loaded;
}
