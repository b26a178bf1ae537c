/*
 * poseline.js -- poses as the line of commands that makes them, `mr-pose ... | mr-decode`, and such a line as poses.  A pose is
 * { handle, translate, rotate: axis and degrees, scale, center: or null, for the middle of the handle as posed so far }.
 */
import { plain } from "../stream/text.js";

const OPTIONS = { H: "handle", t: "translate", r: "rotate", s: "scale", c: "center", F: "frames", S: "script", o: "output", q: "quiet", v: "verbose" };
const FLAGS = new Set(["quiet", "verbose", "no-check"]);
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const SPLIT = /\s*(?:(\|)|((?:[^\s|'"\\$`;&<>()]|\\[^\n]|'[^']*'|"[^"\\$`]*")+))/y;

const fail = (sentence) => {
	throw new Error(sentence);
};
const short = (word) => (word.length > 40 ? word.slice(0, 40) + "…" : word);

/* One word as the shell has it, without its quotes. */
function unquoted(word) {
	return word.replace(/\\(.)|'([^']*)'|"([^"]*)"/g, (_, ...inner) => inner.slice(0, 3).find((x) => x !== undefined));
}

/* Commands as words. */
function split(text) {
	const line = text.replace(/\\\r?\n/g, " ").replace(/\|\s*\n/g, "| ").replace(/^\s*\$\s/, "").trim(), commands = [[]];

	if (plain(line) !== line)
		fail("There are control characters or ends of lines in the line: one line of commands is taken.");
	for (SPLIT.lastIndex = 0; SPLIT.lastIndex < line.length;) {
		const at = SPLIT.lastIndex, found = SPLIT.exec(line);
		if (!found)
			fail("“" + short(line.slice(at).trim()) + "” is nothing that the page takes: a line of mr-pose commands with | between them is.");
		if (found[1])
			commands.push([]);
		else
			commands[commands.length - 1].push(unquoted(found[2]));
	}
	return commands;
}

/* The number of numbers is one of these. */
function numbers(text, what, ...counts) {
	const parts = text.split(","), values = parts.map(Number);

	if (!counts.includes(parts.length) || !parts.every((p) => NUMBER.test(p)) || !values.every(Number.isFinite))
		fail("“" + short(text) + "” is not " + what + ".");
	return values;
}

const READ = {
	handle: (pose, text) => {
		pose.handle = /^\d{1,5}$/.test(text) && Number(text) <= 65535 ? Number(text) : fail("“" + short(text) + "” is not the number of a handle.");
	},
	translate: (pose, text) => {
		pose.translate = numbers(text, "three numbers with commas between them", 3);
	},
	rotate: (pose, text) => {
		pose.rotate = numbers(text, "an axis and an angle, ax,ay,az,degrees", 4);
		if (!pose.rotate.slice(0, 3).some((x) => x !== 0))
			fail("The axis “" + short(text) + "” has no direction.");
	},
	scale: (pose, text) => {
		const s = numbers(text, "one factor, nor three with commas between them", 1, 3);
		pose.scale = s.length === 1 ? [s[0], s[0], s[0]] : s;
	},
	center: (pose, text) => {
		pose.center = numbers(text, "three numbers with commas between them", 3);
	},
	output: () => {},
	frames: () => fail("The page shows one pose: --frames makes a sequence in the pipe, mr-pose … | mr-decode | mr-view film.html."),
	script: () => fail("The page reads no file: --script makes a sequence in the pipe, mr-pose … | mr-decode | mr-view film.html."),
};

/* A word's option: its name and its value, where that is in the same word; null: a file's name. */
function optionOf(word) {
	if (word.startsWith("--")) {
		const [name, ...value] = word.slice(2).split("=");
		return { name, value: value.length ? value.join("=") : null };
	}
	if (!word.startsWith("-") || word === "-")
		return null;
	return { name: OPTIONS[word[1]] || word[1], value: word.length > 2 ? word.slice(2) : null };
}

/* read: what takes each option's value.  Files are the shell's: the page has its model. */
function options(command, words, read, pose) {
	for (let i = 0; i < words.length; i++) {
		const option = optionOf(words[i]);
		if (!option || FLAGS.has(option.name))
			continue;
		const take = Object.prototype.hasOwnProperty.call(read, option.name) ? read[option.name] : null;
		if (!take)
			fail("The page does not do “" + short(command + " " + words[i]) + "”: it is for the pipe.");
		if (option.value === null && ++i === words.length)
			fail("“" + short(words[i - 1]) + "” wants a value behind it.");
		take(pose, option.value === null ? words[i] : option.value);
	}
}

export const rest = (handle) => ({ handle, translate: [0, 0, 0], rotate: [0, 0, 1, 0], scale: [1, 1, 1], center: null });

/* What mr-decode takes, of a displaced surface of so many levels; null: there is none. */
const decodes = (most) => (most === null ? { output: READ.output } : {
	output: READ.output,
	level: (poses, text) => {
		poses.level = /^\d{1,2}$/.test(text) && Number(text) <= most ? Number(text) : fail("“" + short(text) + "” is not one of the levels 0 to " + most + ".");
	},
});

/*
 * The poses of a line, and as their `level` that of mr-decode, or null; handles: the numbers of those that there are; most: the finest
 * level of the displaced surface, or null.  Throws an Error with a sentence.
 */
export function parseLine(text, handles, most) {
	const poses = [];

	poses.level = null;

	if (text.trim() === "")
		return poses;
	for (const [command, ...words] of split(text)) {
		if (command === "mr-decode") {
			poses.level = most;
			options(command, words, decodes(most), poses);
		} else if (command === "mr-pose") {
			const pose = rest(0);
			options(command, words, READ, pose);
			if (!handles.includes(pose.handle))
				fail("No vertex is in handle " + pose.handle + "; handles in use: " + handles.join(", ") + ".");
			poses.push(pose);
		} else {
			fail(command ? "The page does not know “" + short(command) + "”, only mr-pose and mr-decode." : "There is no command beside |.");
		}
	}
	return poses;
}

const isRest = (pose) => pose.translate.every((x) => x === 0) && pose.rotate[3] === 0 && pose.scale.every((x) => x === 1);

function commandOf(pose) {
	const [sx, sy, sz] = pose.scale, words = ["mr-pose -H " + pose.handle];

	if (pose.scale.some((x) => x !== 1))
		words.push("--scale " + (sx === sy && sy === sz ? sx : pose.scale.join(",")));
	if (pose.rotate[3] !== 0)
		words.push("--rotate " + pose.rotate.join(","));
	if (pose.translate.some((x) => x !== 0))
		words.push("--translate " + pose.translate.join(","));
	if (pose.center)
		words.push("--center " + pose.center.join(","));
	return words.join(" ");
}

/* The line that makes the poses, on a level other than the finest if there is one; empty where all is at rest. */
export function lineOf(poses, level) {
	const commands = poses.filter((pose) => !isRest(pose)).map(commandOf);

	return commands.length ? [...commands, level === null ? "mr-decode" : "mr-decode --level " + level].join(" | ") : "";
}
