"""paint -- a stream whose meshes have a column of each kind, by which what becomes of them is known (check.painted).

Means are linear in the positions: they are exact on every surface that is interpolated; labels are thirds along x.
"""
import sys

import stream
import numpy as np


def share(box, p):
    """Positions as shares of the box of others, halved first: the largest numbers have no difference."""
    low, extent = box.min(0) / 2, np.ptp(box / 2, 0)
    return (p / 2 - low) / np.where(extent > 0, extent, 1)


def painted(frames):
    for frame in frames:
        if "mesh" in frame and len(frame["mesh"].get("triangles", [])):
            p, t = share(frame["mesh"]["position"], frame["mesh"]["position"]), frame["mesh"]["triangles"]
            for name in ("texcoord", "corner_texcoord", "groups", "objects", "materials", "mtllib", "polygon"):
                if name in frame["mesh"]:
                    del frame["mesh"][name]
            frame.put("mesh", "color", np.rint(np.c_[255 * p, np.full(len(p), 255)]).astype(np.uint8), "v")
            frame.put("mesh", "heat", p[:, 2] / 3, "v")
            frame.put("mesh", "corner_texcoord", p[t][:, :, :2].reshape(-1, 6), "f")
            frame.put("mesh", "material", np.minimum(3 * p[t].mean(1)[:, 0], 2).astype(np.uint32), "f")
            frame.put("mesh", "materials", "left\nmiddle\nright")
        yield frame


if __name__ == "__main__":
    stream.write("-", painted(stream.read("-")))
