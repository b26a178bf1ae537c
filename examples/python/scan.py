"""scan -- makes a surface with levels of detail of points: python3 scan.py scan.ply surface.mrs

Writes each level as a PLY, too, and how far the points are from it as a table, and as levels.png where there is
matplotlib.
"""
import sys

import mr

cloud = mr.read(sys.argv[1], points=True)
surface = mr.sample(mr.fit(mr.simplify(mr.shrinkwrap(cloud))))
mr.write(sys.argv[2], surface)

faces, errors = [], []
for level in range(surface["displacement"]["level"][0] + 1):
    mesh = mr.decode(surface, level=level)
    mr.write(f"level-{level}.ply", mesh)
    faces.append(len(mesh["mesh"]["triangles"]))
    errors.append(mr.compare(mesh, from_="points", to="mesh")["a_to_b_relative"]["rms"])
    print(f"level {level}: {faces[-1]:8} faces, {100 * errors[-1]:.3f} % of the diagonal from the points")

try:
    from matplotlib import pyplot
except ImportError:
    sys.exit()
pyplot.loglog(faces, errors, "o-")
pyplot.xlabel("faces")
pyplot.ylabel("distance of the points, in diagonals")
pyplot.savefig("levels.png")
