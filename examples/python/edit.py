"""edit -- bends a model, its fine detail kept: python3 edit.py model.obj bent.obj"""
import sys

import mr

model = mr.read(sys.argv[1])
base = mr.remesh(mr.smooth(model))
handles = mr.select(base, free="all", fixed="below:y,0.5", handle={1: "above:y,0.85"})
creature = mr.encode(mr.solve(handles, basis=True))
bent = mr.decode(mr.pose(creature, handle=1, rotate=(0, 0, 1, 30)))
mr.write(sys.argv[2], bent)
