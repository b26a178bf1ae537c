/* handles.js -- the handles of a frame, at rest or as the stream has posed them. */
import { Pose } from "./pose.js";
import { columnOf } from "../stream/stream.js";
import { boxOf } from "../mesh/surface.js";

export const HANDLE = 2; /* the region of handle 0 */

/* The middle of the vertices of each handle. */
function centroidsOf(region, position) {
	const sums = [];

	for (let v = 0; v < region.length; v++) {
		if (region[v] < HANDLE)
			continue;
		const sum = sums[region[v] - HANDLE] = sums[region[v] - HANDLE] || [0, 0, 0, 0];
		for (let c = 0; c < 3; c++)
			sum[c] += position[3 * v + c];
		sum[3]++;
	}
	return sums.map(([x, y, z, n]) => [x / n, y / n, z / n]);
}

/* The maps of the stream; none where it has none. */
async function startOf(frame) {
	const column = columnOf(frame, "handles", "transform"), values = column ? await column.values() : [];

	return Array.from({ length: values.length / 12 }, (_, i) => Array.from(values.subarray(12 * i, 12 * i + 12)));
}

export async function poseOf(frame, regions) {
	const region = await regions.values(),
		position = await columnOf(frame, "mesh", "position").values();
	const box = boxOf(position);

	return new Pose(centroidsOf(region, position), await startOf(frame),
		Math.hypot(...box.low.map((x, c) => box.high[c] - x)));
}
