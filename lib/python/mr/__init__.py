"""mr -- multiresolution geometry: each tool of mr is a function of frames.

    import mr

    model = mr.read("model.obj")
    creature = mr.remesh(mr.smooth(model))
    creature = mr.select(creature, free="all", fixed="below:y,0.5", handle={1: "above:y,0.85"})
    posed = mr.pose(mr.encode(mr.solve(creature, basis=True)), handle=1, rotate=(0, 0, 1, 30))
    bent = mr.decode(posed)
    mr.write("bent.obj", bent)
    bent["mesh"]["position"]                # an array of numpy

A frame is a set of layers, a layer a set of columns: arrays that are not copied, and that cannot be written to; what is
put into a frame is copied (mr.stream).  A function that is given a frame gives a frame; given several, as a list or an
iterator, it gives an iterator, and the tools work beside each other.  help(mr.smooth) has a tool's options, which are
those of its command line.

A tool that fails raises mr.Error with its sentence.  What it finds poor in a result is a warning, mr.Finding, and stays
in frame.findings.
"""
from __future__ import annotations

from typing import Any, Iterable

from . import stream
from ._tools import *  # noqa: F401,F403
from ._tools import export, import_
from .stream import CutOff, Error, Finding, Frame, StreamError, mesh
from .stream import read as frames
from .tools import Path


def read(path: Path, **options: Any) -> Frame:
    """The frame of a model's file, by the options of mr.import_, or of a stream; mr.frames(path) gives all of one."""
    with open(path, "rb") as file:
        is_stream = file.read(8) == stream.MAGIC
    found = list(frames(path) if is_stream else import_(path, **options))
    if len(found) != 1:
        raise Error(f"{path}: {len(found)} frames: mr.frames gives them in turn")
    return found[0]


def write(path: Path, frames: Frame | Iterable[Frame], **options: Any) -> None:
    """Writes a frame, or frames, as a stream if the path ends in .mrs, else as models by the options of mr.export."""
    if str(path).endswith(".mrs"):
        stream.write(path, [frames] if isinstance(frames, Frame) else frames, history=None)
    else:
        export(frames, path, **options)
