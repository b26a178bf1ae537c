/*
 * poseline.js -- poses as the line of commands that makes them, `mr-pose ... | mr-decode`, and such a line as poses.  A pose is
 * { handle, translate, rotate: axis and degrees, scale, center: or null, for the middle of the handle as posed so far }.
 */
import { plain } from "../stream/text.js";

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const SHORT = { "-H": "--handle", "-t": "--translate", "-r": "--rotate", "-s": "--scale", "-c": "--center" };

const fail = (sentence) => {
	throw new Error(sentence);
};
const refuse = (word) => fail("“" + plain(word).slice(0, 40) + "” is nothing that the page takes: it takes mr-pose … | mr-decode, as it writes them.");

/* So many numbers with commas between them. */
function numbers(text, ...counts) {
	const parts = text.split(","), values = parts.map(Number);

	return counts.includes(parts.length) && parts.every((p) => NUMBER.test(p)) && values.every(Number.isFinite) ? values : refuse(text);
}

const READ = {
	"--handle": (text) => (/^\d{1,5}$/.test(text) ? Number(text) : refuse(text)),
	"--translate": (text) => numbers(text, 3),
	"--rotate": (text) => (numbers(text, 4).slice(0, 3).some((x) => x !== 0) ? numbers(text, 4) : refuse(text)),
	"--scale": (text) => (numbers(text, 1, 3).length === 1 ? [0, 0, 0].fill(Number(text)) : numbers(text, 3)),
	"--center": (text) => numbers(text, 3),
};

/* The words behind a command as options with their values, by these names. */
function options(words, names) {
	const found = {};

	for (let i = 0; i < words.length; i += 2) {
		const name = SHORT[words[i]] || words[i];
		if (!names.includes(name) || i + 1 === words.length)
			refuse(words[i]);
		found[name.slice(2)] = words[i + 1];
	}
	return found;
}

export const rest = (handle) => ({ handle, translate: [0, 0, 0], rotate: [0, 0, 1, 0], scale: [1, 1, 1], center: null });

function poseOf(words, handles) {
	const pose = rest(0);

	for (const [name, text] of Object.entries(options(words, Object.keys(READ))))
		pose[name] = READ["--" + name](text);
	return handles.includes(pose.handle) ? pose : fail("No vertex is in handle " + pose.handle + "; handles in use: " + handles.join(", ") + ".");
}

/* The level of mr-decode, of a displaced surface of so many; null: there is none. */
function levelOf(words, most) {
	const { level } = options(words, most === null ? [] : ["--level"]);

	if (level === undefined)
		return most;
	return /^\d{1,2}$/.test(level) && Number(level) <= most ? Number(level) : fail("“" + plain(level).slice(0, 40) + "” is not one of the levels 0 to " + most + ".");
}

/*
 * The poses of a line, and as their `level` that of mr-decode, or null; handles: the numbers of those that there are; most: the finest
 * level of the displaced surface, or null.  Throws an Error with a sentence.
 */
export function parseLine(text, handles, most) {
	const poses = Object.assign([], { level: null });

	for (const part of text.trim() ? text.split("|") : []) {
		const [command, ...words] = part.trim().split(/\s+/);
		if (command === "mr-decode")
			poses.level = levelOf(words, most);
		else if (command === "mr-pose")
			poses.push(poseOf(words, handles));
		else
			refuse(command);
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
