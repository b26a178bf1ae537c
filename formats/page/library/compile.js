/* compile.js -- the library of the page, once it is compiled. */
import code from "library.wasm";
import { Library } from "./library.js";

export let library;

/* Before anything asks for it. */
export async function begin() {
	library = new Library((await WebAssembly.instantiate(code)).instance.exports);
}
