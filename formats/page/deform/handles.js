/* handles.js -- the handles of a frame, at rest or as the stream has posed them, and the commands that it lacks to have them dragged. */
import { Pose } from "./pose.js";
import { columnOf, ownRegion, streamOf } from "../stream/stream.js";
import { boxOf } from "../mesh/surface.js";

export const HANDLE = 2; /* the region of handle 0 */

/* Sums over the vertices of each handle; the lowest region that is not free. */
function handlesOf(region, position) {
	const sums = [], centroids = [];
	let lowest = Infinity;

	for (let v = 0; v < region.length; v++) {
		if (region[v] !== 1)
			lowest = Math.min(lowest, region[v]);
		if (region[v] < HANDLE)
			continue;
		const sum = sums[region[v] - HANDLE] = sums[region[v] - HANDLE] || [0, 0, 0, 0];
		for (let c = 0; c < 3; c++)
			sum[c] += position[3 * v + c];
		sum[3]++;
	}
	sums.forEach(([x, y, z, n], h) => {
		centroids[h] = [x / n, y / n, z / n];
	});
	return { centroids, whole: lowest >= HANDLE && lowest < Infinity ? lowest - HANDLE : null };
}

/* Rows of numbers: those of a column, none where there is no such column. */
async function rowsOf(frame, name) {
	const column = columnOf(frame, "handles", name), n = column ? column.components : 1;
	const values = column ? await column.values() : [];

	return Array.from({ length: values.length / n }, (_, i) => Array.from(values.subarray(n * i, n * i + n)));
}

/* The layer whose regions are the handles: mr-pose goes by mesh where that has any. */
const handled = (frame) => (ownRegion(frame, "mesh") ? "mesh" : "control");

export async function poseOf(frame) {
	const layer = handled(frame), region = await ownRegion(frame, layer).values(), position = await columnOf(frame, layer, "position").values();
	const { centroids, whole } = handlesOf(region, position), box = boxOf(position);
	const start = { maps: await rowsOf(frame, "transform"), turns: await rowsOf(frame, "turn") };

	return new Pose(centroids, start, Math.hypot(...box.low.map((x, c) => box.high[c] - x)), whole);
}

/* The commands that a page with handles lacks, or an empty text. */
export async function lacking(frame) {
	const has = (layer, name) => columnOf(frame, layer, name);
	const layer = handled(frame), region = ownRegion(frame, layer);

	if (!region || !(await region.values()).some((r) => r >= HANDLE))
		return "";
	if (layer === "control")
		return frame.levels ? "mr-solve --basis " + streamOf(frame) + " | mr-view page.html" : "";
	return [has("base", "position") ? "" : "mr-smooth | mr-remesh", "mr-solve --basis", has("base", "position") && has("mesh", "detail_height") ? "" : "mr-encode", "mr-view page.html"]
		.filter(Boolean).join(" | ").replace(/^(\S+( --basis)?)/, "$1 " + streamOf(frame));
}
