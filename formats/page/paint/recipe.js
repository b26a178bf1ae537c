/*
 * recipe.js -- from the history of a stream to commands: a script that makes the model again and gives it the painted
 * regions.  A history is foreign.  Its lines are read by the tools' own tables of options, and written anew: known
 * options alone, values of their kinds, each word quoted.  What names a file, writes or reads one is the script's own.
 */
import { OPTIONS } from "tool-options";

const EDIT = ["mr-select", "mr-solve", "mr-encode", "mr-pose", "mr-decode"];
const WORD = /^(?:'([^']*)'|([-_=+:,./%@A-Za-z0-9]+))(?: |$)/;
const NUMBERS = /^[-+.,0-9eE ]+$/;
const VALUES = {
	real: NUMBERS, count: /^[0-9]+$/, length: /^[-+.0-9eE]+%?$/, vector: NUMBERS, range: NUMBERS, size: /^[0-9]+x[0-9]+$/,
};

/* A word as a shell takes it. */
export function quote(word) {
	return /^[-_=+:,./%@A-Za-z0-9]+$/.test(word) ? word : "'" + word.replace(/'/g, "'\\''") + "'";
}

/* Foreign text in a comment: one line of plain characters. */
const remark = (text) => "# " + text.replace(/[^ -~]+/g, "?").slice(0, 500);

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

/* The option of a tool that has this letter or name, of its own table before that of all; and whether it is of that. */
function optionOf(tool, given) {
	for (const table of [tool, ""])
		for (const [letter, name, kind, metavar] of OPTIONS[table])
			if (given === name || given === letter)
				return { name, kind, metavar, shared: table === "" && name !== "--layer" };
	throw new Error(tool + " has no option " + given);
}

/* Whether a value is one that the option takes, and no file's name. */
function isValue({ name, kind, metavar }, value) {
	if (kind === "choice")
		return metavar.split("|").includes(value);
	if (VALUES[kind])
		return VALUES[kind].test(value);
	if (name === "--layer" || metavar === "LAYER")
		return /^[a-z][a-z0-9_]*$/.test(value);
	return !/FILE|PICTURE|NAME|DIR/.test(metavar) || (metavar.endsWith("|NUMBERS") && NUMBERS.test(value));
}

/* [option, value] of each option in a word, a value taken from `more` where the word has none. */
function optionsIn(tool, word, more) {
	const [, long, , attached] = /^(--[^=]*)(=(.*))?$/.exec(word) || [], found = [];
	const valueOf = (option, own) => {
		const value = own === undefined ? more.shift() : own;
		if (value === undefined || (!option.shared && !isValue(option, value)))
			throw new Error(tool + " " + option.name + " " + (value || "") + " cannot be repeated");
		return value;
	};
	const takes = (option) => option.metavar !== "";

	if (long) {
		const option = optionOf(tool, long);
		return [[option, takes(option) ? valueOf(option, attached) : null]];
	}
	for (let rest = word.slice(1); rest;) {
		const option = optionOf(tool, "-" + rest[0]);
		rest = rest.slice(1);
		found.push([option, takes(option) ? valueOf(option, rest || undefined) : null]);
		if (takes(option))
			break;
	}
	return found;
}

/* Fills in the options and operands of a step; throws where it cannot be repeated. */
function readWords(step, words) {
	if (!words || !Object.hasOwnProperty.call(OPTIONS, step.tool))
		throw new Error("it is no command of a tool that is known");
	while (words.length > 0) {
		const word = words.shift();
		if (!word.startsWith("-") || word === "-") {
			step.operands.push(word);
			continue;
		}
		for (const [option, value] of optionsIn(step.tool, word, words))
			(option.shared ? step.dropped : step.options).push(option.name, ...(value === null ? [] : [value]));
	}
}

/* { tool, options, operands, dropped, why: it cannot be repeated } of a line of a history.  What mr-solve-mpi has done
 * mr-solve does, too. */
function stepAt(line, i) {
	const [, tool, rest] = /^mr [^ :]+: (mr-[a-z]+?)(?:-mpi)?(?: (.*))?$/.exec(line) || [];
	const step = { tool, options: [], operands: [], dropped: [] };

	try {
		readWords(step, wordsOf(rest || ""));
		return step;
	} catch (error) {
		return { ...step, options: [], why: "line " + (i + 1) + " of its history is left out: " + error.message };
	}
}

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

/* Whether steps begin at a file, or a shape, and go through one pipe; else why they do not. */
function faultOf(steps) {
	const [first] = steps, joins = ["--merge", "--append"], bad = steps.find((s) => s.why);

	if (!first)
		return "the stream has no history";
	if (bad)
		return bad.why;
	if (first.tool === "mr-make" ? !/^[a-z]+$/.test(first.operands.join(" ")) : first.tool !== "mr-import")
		return "the history begins with " + first.tool;
	return steps.some((s) => s.tool === "mr-cat" && (s.operands.length > 1 || s.options.some((o) => joins.includes(o)))) ?
		"the history joins streams" : "";
}

const commandOf = (tool, words) => [tool, ...words.map(quote)].join(" ");

/* What follows the painted regions: the basis of their handles, and details on it. */
function basis(work, solve, encode) {
	if (!work.handles || !work.base)
		return [];
	const solving = commandOf("mr-solve", solve.includes("--basis") ? solve : [...solve, "--basis"]);
	return work.layer === "mesh" && encode ? [solving, commandOf("mr-encode", encode)] : [solving];
}

function select(work, file) {
	return "mr-select" + (work.option ? " -l " + quote(work.layer) : "") + " --from " + file;
}

/* The first command, which reads the file that the script is called with, if any. */
function beginning({ tool, options, operands }) {
	return tool === "mr-make" ? commandOf(tool, [...options, ...operands]) : commandOf(tool, options) + ' "$@"';
}

/* Of commands the first, where no other brings the model, reads it. */
const reading = (commands, file) => [commands[0] + " " + file, ...commands.slice(1)];

/* How the script is called: of a shape by itself, else with files; and where its commands come from. */
function usage(name, first, kept, why) {
	const shape = Boolean(first) && first.tool === "mr-make";
	const call = "usage: sh " + name + ".sh" + (shape ? "" : first ? " FILE..." : " STREAM.mrs");
	const asks = shape ? [] : ["[ $# -gt 0 ] || { echo '" + call + "' >&2; exit 2; }"];

	if (!first)
		return ["# " + call, remark("It reads the stream, since " + why + "."), ...asks];
	const dropped = kept.filter((s) => s.dropped.length > 0)
		.map((s) => remark("Left out of " + s.tool + ": " + s.dropped.join(" ")));
	const named = shape ? [] : [remark("The history reads " + first.operands.join(" "))];
	return ["# " + call, "# The commands before mr-select come from the history of the stream in the page.",
		...named, ...dropped, ...asks];
}

/*
 * work: { name, layer, option: whether mr-select needs -l, base: whether the frame has one, encoded, still: and base is
 * where it was then, handles, text, several: whether the stream has other models, decode: the command that makes the
 * layer, or an empty text, pose: the line of the page's pose, where it is of these regions }.
 */
export function script(work, history) {
	const { kept, posed, solve, encode } = parted(history.map(stepAt)), why = faultOf(kept);
	const [first, ...others] = why ? [] : kept, encodes = !why ? !kept.some((s) => s.tool === "mr-encode") : !work.encoded;
	const pose = work.pose && !posed ? work.pose.split(" | ") : [];
	const made = first ? [beginning(first), ...others.map((s) => commandOf(s.tool, s.options))] : [];
	const chosen = [...(work.decode ? [work.decode] : []), select(work, '"$regions"') + (work.several ? " -k" : "")];
	if (work.text.split("\n").includes("END"))
		throw new Error("The regions cannot stand in a script: save them as a file.");
	const last = [...basis(work, solve, encodes ? encode : null), ...pose];
	const pipe = [...made, ...(first ? chosen : reading(chosen, '"$@"')), ...last];

	return [
		"#!/bin/sh",
		"# Makes " + work.name + "-painted.mrs: the model with the regions that were painted in its page" +
			(pose.length ? ", posed as there." : "."),
		...usage(work.name, first, kept, why),
		"set -e",
		"regions=$(mktemp)",
		"trap 'rm -f \"$regions\"' EXIT",
		"cat >\"$regions\" <<'END'",
		work.text + "END",
		pipe.join(" |\n\t") + " -o " + work.name + "-painted.mrs",
		"",
	].join("\n");
}

/* The line that makes a stream with a basis of the painted handles, of the stream and the regions as files, and a page. */
export function basisLine(work) {
	const made = work.decode ? [work.decode] : [], chosen = select(work, work.name + ".regions");
	const pipe = reading([...made, ...(work.base ? [] : ["mr-smooth", "mr-remesh"]), chosen], work.name + ".mrs");

	const out = work.name + "-painted";
	const last = basis({ ...work, base: true }, [], work.encoded && work.base && !work.still ? null : []);

	return [...pipe, ...last].join(" | ") + " -o " + out + ".mrs && mr-view -i " + out + ".mrs " + out + ".html";
}
