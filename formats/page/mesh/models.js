/* models.js -- frames with what is computed of them, and those in files beside the page, which come when they are asked
 * for. */
import { takeBeside } from "../stream/data.js";
import { parseStream } from "../stream/stream.js";
import { addLevels } from "./levels.js";
import { addPacked } from "./packed.js";

/* The frames of a stream's bytes. */
export async function readFrames(bytes) {
	const frames = await parseStream(bytes);

	frames.forEach(addPacked);
	frames.forEach(addLevels);
	return frames;
}

/* Fills the frames of a model that is beside the page, where that has not been done. */
export async function bring({ beside, group }, frames) {
	if (beside)
		(await readFrames(await takeBeside(beside))).forEach((frame, i) =>
			Object.assign(frames[group + i], frame, { beside: null, group }));
}
