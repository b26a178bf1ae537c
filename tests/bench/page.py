"""page.py -- see bench_page.sh, which made the pages on the command line."""
import os
import sys

from browser import Browser

FRAMES = 60
DRAG = """(async () => {
	const { posing } = mrView, { deformer, pose } = posing, times = { frame: [], turns: [], normals: [] };
	for (let i = 0; i < %d; i++) {
		pose.drag(1, { translate: [0.002 * i, 0, 0], turn: [0, 0, 0.01 * i], scale: [1, 1, 1] });
		const changes = pose.changes();
		let began = performance.now();
		deformer.base.pose(changes);
		deformer.decode();
		times.frame.push(performance.now() - began);
		began = performance.now();
		mrView.drawn.get("mesh").drawn.move(deformer.places.mesh);
		times.normals.push(performance.now() - began);
		await deformer.ask();
		times.turns.push(deformer.took);
	}
	return { vertices: [deformer.places.mesh.length / 3, deformer.places.base.length / 3],
		...Object.fromEntries(Object.entries(times).map(([k, t]) => [k, t.sort((a, b) => a - b)[t.length >> 1]])) };
})()""" % FRAMES

with Browser() as b:
    for page in sys.argv[1:]:
        name = os.path.basename(page)[:-len(".html")]
        b.open(page)
        got = b.eval(DRAG)
        print("%s: %d vertices, base %d" % (name, *got["vertices"]))
        for what in ("frame", "turns", "normals"):
            print("%s-%s mr %.3g ms" % (name, what, got[what]))
