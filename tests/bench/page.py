"""page.py -- see bench_page.sh, which made the pages on the command line."""
import os
import sys

from browser import Browser

FRAMES = 60
DRAG = """(async () => {
	const { posing } = mrView, { deformer, pose } = posing, times = { deformation: [], normals: [] };
	for (let i = 0; i < %d; i++) {
		const turn = pose.grip(1).turn.clone().set(0, 0, 0.01 * i);
		pose.drag(1, { translate: [0.002 * i, 0, 0], turn, scale: [1, 1, 1] });
		let began = performance.now();
		deformer.pose(pose.maps(), mrView.centre);
		times.deformation.push(performance.now() - began);
		began = performance.now();
		mrView.drawn.get("mesh").drawn.move(deformer.places.mesh);
		times.normals.push(performance.now() - began);
	}
	return { vertices: [deformer.places.mesh.length / 3, deformer.places.base.length / 3],
		...Object.fromEntries(Object.entries(times).map(([k, t]) => [k,
			(s => [s[s.length >> 1], s[0]])(t.sort((a, b) => a - b))])) };
})()""" % FRAMES

with Browser(scale=1) as b:
    for page in sys.argv[1:]:
        name = os.path.basename(page)[:-len(".html")]
        b.open(page)
        got = b.eval(DRAG)
        print("%s: %d vertices, base %d" % (name, *got["vertices"]))
        for what in ("deformation", "normals"):
            print("%s-%s mr %.3g ms" % (name, what, got[what][0]))
            print("%s-%s-fastest mr %.3g ms" % (name, what, got[what][1]))
