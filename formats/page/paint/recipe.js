/*
 * recipe.js -- from the history of a stream to commands: a script that makes the model again and gives it the painted
 * regions.  A history is foreign: it is taken word by word, only tools of mr may stand in it, and every word is quoted
 * anew, so that no line of it can be run as anything else.
 */

/* The tools that make or change a frame, and their options without a value. */
export const FLAGS = {
	"mr-cat": ["-z", "--pack", "-u", "--unpack", "--merge", "--append"],
	"mr-crop": [],
	"mr-decode": ["--no-check"],
	"mr-encode": [],
	"mr-equalize": [],
	"mr-fit": [],
	"mr-import": ["--points", "--repair"],
	"mr-make": ["--open", "--texcoords"],
	"mr-map": [],
	"mr-normals": ["--keep", "--flip"],
	"mr-pose": [],
	"mr-remesh": ["--no-project"],
	"mr-sample": [],
	"mr-select": ["--reset"],
	"mr-shrinkwrap": ["--ignore-normals", "--template"],
	"mr-simplify": ["--creases", "--smooth"],
	"mr-smooth": ["--plain"],
	"mr-solve": ["--unsymmetric", "--apart", "--flatten", "--basis", "--verify"],
	"mr-split": [],
	"mr-subdivide": ["--limit"],
	"mr-transform": ["-c", "--center", "-U", "--unit"],
};

const EDIT = ["mr-select", "mr-solve", "mr-encode", "mr-pose", "mr-decode"];
const FILES = ["-o", "--output", "-i", "--input", "--stats", "-w", "--write"]; /* beside the pipe: they could write over something */
const WORD = /^(?:'([^']*)'|([-_=+:,./%@A-Za-z0-9]+))(?: |$)/;

/* A word as a shell takes it. */
export function quote(word) {
	return /^[-_=+:,./%@A-Za-z0-9]+$/.test(word) ? word : "'" + word.replace(/'/g, "'\\''") + "'";
}

/* The words of a command line, as histories quote them; null where they are not. */
function wordsOf(line) {
	const words = [];

	for (let rest = line; rest;) {
		const found = WORD.exec(rest);
		if (!found)
			return null;
		words.push(found[1] === undefined ? found[2] : found[1]);
		rest = rest.slice(found[0].length);
	}
	return words;
}

/* The options in a word, and whether the next word is the value of the last. */
function optionsIn(word, flags) {
	if (word.startsWith("--"))
		return { names: [word.split("=")[0]], next: !word.includes("=") && !flags.includes(word) };
	const letters = Array.from(word.slice(1), (letter) => "-" + letter), last = letters.findIndex((name) => !flags.includes(name));
	return { names: last < 0 ? letters : letters.slice(0, last + 1), next: last >= 0 && last === letters.length - 1 };
}

/* { tool, options, operands } of a line of a history; null where it is none of a tool that is known.  What mr-solve-mpi has
 * done mr-solve does, too. */
function stepOf(line) {
	const found = /^mr [^ :]+: (mr-[a-z]+?)(?:-mpi)?(?: (.*))?$/.exec(line);
	const flags = found && Object.hasOwnProperty.call(FLAGS, found[1]) ? FLAGS[found[1]] : null, words = flags && wordsOf(found[2] || "");

	if (!words)
		return null;
	const step = { tool: found[1], options: [], operands: [] };
	for (let i = 0; i < words.length; i++) {
		if (!words[i].startsWith("-") || words[i] === "-") {
			step.operands.push(words[i]);
			continue;
		}
		const { names, next } = optionsIn(words[i], flags);
		if (names.some((name) => FILES.includes(name)))
			return null;
		step.options.push(words[i]);
		if (next && i + 1 < words.length)
			step.options.push(words[++i]);
	}
	return step;
}

/* The steps of a history that goes from a file, or a shape, through one pipe: { steps }, or { why } it does not. */
export function stepsOf(history) {
	const steps = history.map(stepOf);

	if (steps.length === 0)
		return { why: "the stream has no history" };
	if (steps.includes(null))
		return { why: "line " + (steps.indexOf(null) + 1) + " of the history is no command that can be repeated" };
	if (steps[0].tool !== "mr-import" && steps[0].tool !== "mr-make")
		return { why: "the history begins with " + steps[0].tool };
	if (steps.some((s) => s.tool === "mr-cat" && (s.operands.length > 1 || s.options.includes("--merge") || s.options.includes("--append"))))
		return { why: "the history joins streams" };
	return { steps };
}

const commandOf = (tool, words) => [tool, ...words.map(quote)].join(" ");

/*
 * The edit at the end of the history is another one now: its steps go, but for what else the solver and the encoder were
 * told.
 */
function parted(steps) {
	let n = steps.length;

	while (n > 1 && EDIT.includes(steps[n - 1].tool))
		n--;
	const posed = steps.slice(n).some((s) => s.tool === "mr-pose");
	const optionsOf = (tool) => steps.slice(n).filter((s) => s.tool === tool).map((s) => s.options).pop() || [];
	return { kept: steps.slice(0, n), posed, solve: optionsOf("mr-solve"), encode: optionsOf("mr-encode") };
}

/* What follows the painted regions: the basis of their handles, and details on it. */
function basis(work, solve, encode) {
	if (!work.handles || !work.base)
		return [];
	const solving = commandOf("mr-solve", solve.includes("--basis") ? solve : [...solve, "--basis"]);
	return work.layer === "mesh" && encode ? [solving, commandOf("mr-encode", encode)] : [solving];
}

function select(work, file) {
	return "mr-select" + (work.option ? " -l " + work.layer : "") + " --from " + file;
}

/* The first command, which reads the file that the script is called with, if any. */
function beginning({ tool, options, operands }) {
	return tool === "mr-make" ? commandOf(tool, [...options, ...operands]) : commandOf(tool, options) + ' "$@"';
}

/* Of commands the first, where no other brings the model, reads it. */
const reading = (commands, file) => [commands[0] + " " + file, ...commands.slice(1)];

/* How the script is called: of a shape by itself, of files, which the history may name, else of a stream. */
function usage(name, first, why) {
	if (!first)
		return ["# usage: sh " + name + ".sh STREAM.mrs, since " + why];
	if (first.tool === "mr-make")
		return ["# usage: sh " + name + ".sh"];
	const files = first.operands.map(quote).join(" ");
	return ["# usage: sh " + name + ".sh [FILE...]", ...(files ? ["[ $# -gt 0 ] || set -- " + files] : [])];
}

/*
 * work: { name, layer, option: whether mr-select needs -l, base: whether the frame has one, encoded, still: and base is where it was then, handles, text, several:
 * whether the stream has other models, decode: the command that makes the layer, or an empty text, pose: the line of the page's pose, where it is of these regions }.
 */
export function script(work, history) {
	const { steps, why } = stepsOf(history), { kept, posed, solve, encode } = parted(steps || []), [first, ...others] = kept;
	const encodes = steps ? !kept.some((s) => s.tool === "mr-encode") : !work.encoded, pose = work.pose && !posed ? work.pose.split(" | ") : [];
	const made = first ? [beginning(first), ...others.map((s) => commandOf(s.tool, s.options))] : [];
	const chosen = [...(work.decode ? [work.decode] : []), select(work, '"$regions"') + (work.several ? " -k" : "")];
	const pipe = [...made, ...(first ? chosen : reading(chosen, '"$@"')), ...basis(work, solve, encodes ? encode : null), ...pose];

	return [
		"#!/bin/sh",
		"# Makes " + work.name + "-painted.mrs: the model with the regions that were painted in its page" + (pose.length ? ", posed as there." : "."),
		...usage(work.name, first, why),
		"set -e",
		"regions=$(mktemp)",
		"trap 'rm -f \"$regions\"' EXIT",
		"cat >\"$regions\" <<'END'",
		work.text + "END",
		pipe.join(" |\n\t") + " -o " + work.name + "-painted.mrs",
		"",
	].join("\n");
}

/* The line that makes a stream with a basis of the painted handles, of the stream and the regions as files, and a page of it. */
export function basisLine(work) {
	const made = work.decode ? [work.decode] : [], chosen = select(work, work.name + ".regions");
	const pipe = reading([...made, ...(work.base ? [] : ["mr-smooth", "mr-remesh"]), chosen], work.name + ".mrs");

	const out = work.name + "-painted";

	return [...pipe, ...basis({ ...work, base: true }, [], work.encoded && work.base && !work.still ? null : [])].join(" | ") + " -o " + out + ".mrs && mr-view -i " + out + ".mrs " + out + ".html";
}
