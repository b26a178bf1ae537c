"""film -- a model turns while a wave runs through it: python3 film.py model.obj film.glb"""
import sys

import numpy as np

import mr


def waves(frames):
    """Positions are arrays of numpy: the tools before and after work meanwhile."""
    for time, frame in enumerate(frames):
        p = frame["mesh"]["position"]
        frame["mesh"]["position"] = p + 0.02 * np.ptp(p) * np.sin(8 * p[:, [1]] - 0.5 * time) * [1, 0, 0]
        yield frame


base = mr.remesh(mr.smooth(mr.read(sys.argv[1])))
handles = mr.select(base, free="all", fixed="below:y,0.5", handle={1: "above:y,0.85"})
creature = mr.encode(mr.solve(handles, basis=True))
poses = mr.pose([creature], handle=1, rotate=(0, 1, 0, 60), frames=24)
mr.write(sys.argv[2], waves(mr.decode(poses)))
