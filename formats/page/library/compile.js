/* compile.js -- the library of the page, compiled once for it and its workers. */
import code from "library.wasm";
import { Library } from "./library.js";

export let module, library;

/* Before anything asks for it. */
export async function begin() {
	module = await WebAssembly.compile(code);
	library = await Library.load(module);
}
