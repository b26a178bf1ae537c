/*
 * held.js -- what was shown and stays, beside what is shown now: a frame, or a model of a gallery, on its level, in its pose, with
 * the regions that were painted then.
 */
import { Drawn } from "./draw/drawn.js";
import { centred } from "./mesh/surface.js";
import { keyOf, titleOf } from "./stream/stream.js";

/* A column that is painted, as it is now. */
async function frozen(column) {
	const values = (await column.values()).slice();

	return { ...column, values: async () => values };
}

/* What a panel is called: the frame, its number of several, its level, and whether it is posed. */
export function nameOf(frame, index, count, posed) {
	const level = frame.levels && frame.levels.surface.most > 0 ? "level " + frame.levels.at : "";

	return [titleOf(frame), count > 1 ? index + 1 + " / " + count : "", level, posed ? "posed" : ""].filter(Boolean).join(" \u00b7 ");
}

/* The same layer drawn once more, with materials of its own; places: where its vertices are, null: where the stream has them. */
async function drawAgain(layer, { box, drawn }, centre, places) {
	const normal = !drawn.triangles && layer.normal ? await layer.normal.values() : null;
	const made = new Drawn(centred(await layer.position.values(), centre), drawn.triangles, normal, drawn.extent);

	if (places)
		made.move(places);
	return { box, places, drawn: made };
}

/* Whether a place is in a box of these boxes. */
const isIn = (boxes, place) => boxes.some(({ low, high }) => place.every((x, c) => low[c] <= x && x <= high[c]));

export class Held {
	/* A promise of what the application shows. */
	static async of(app) {
		const { frame, seen } = app.shown, held = new Held();

		held.centre = app.centre;
		held.group = app.group;
		held.frame = { ...frame, columns: new Map(frame.columns) };
		held.layers = seen;
		held.drawn = new Map();
		held.offset = [0, 0, 0];
		for (const layer of seen) {
			const region = frame.columns.get(keyOf(layer.name, "region")), places = app.posing.placesOf(layer.name);
			if (region && "origin" in region)
				held.frame.columns.set(keyOf(layer.name, "region"), await frozen(region));
			held.drawn.set(layer.name, await drawAgain(layer, app.drawn.get(layer.name), app.centre, places && places.slice()));
		}
		held.title = "kept: " + nameOf(frame, app.frames.indexOf(frame), app.frames.length, [...held.drawn.values()].some((d) => d.places));
		return held;
	}

	/*
	 * Puts it where it is, around the centre of what is shown now, whose boxes are given; a model that is elsewhere comes to stand there
	 * too.
	 */
	place(centre, boxes) {
		const away = this.centre.map((x, c) => x - centre[c]);

		this.offset = isIn(boxes, away) ? away : [0, 0, 0];
		for (const { drawn } of this.drawn.values())
			drawn.group.position.fromArray(this.offset);
	}

	/* The boxes of its layers, there. */
	boxes() {
		const moved = (corner) => corner.map((x, c) => x + this.offset[c]);

		return [...this.drawn.values()].filter((d) => d.box).map(({ box }) => ({ low: moved(box.low), high: moved(box.high) }));
	}

	dispose() {
		for (const { drawn } of this.drawn.values())
			drawn.dispose();
	}
}
