"""Runs the tools.  Each is a process of its own: its input is written by a thread, or straight by the tool before it,
and its frames are read one by one, so that steps work beside each other and give the bytes of the pipe.
"""
from __future__ import annotations

import functools
import inspect
import json
import numbers
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import warnings
from collections.abc import Iterable, Iterator
from typing import Any, Callable, Sequence, TypeVar, Union

import numpy as np

from .stream import Error, Finding, Frame, StreamError, read, write

Function = TypeVar("Function", bound=Callable[..., Any])
Frames = TypeVar("Frames", Frame, Iterable[Frame])  # a frame gives a frame, an iterable of frames an iterator of them
Path = Union[str, "os.PathLike[str]"]
Stream = Union[Path, Frame, Iterable[Frame]]  # a file, or frames, which become one
Number = Union[float, str]  # 0.5, "1%", "auto"
Text = Union[str, Sequence[str], Stream]  # of several words the option is given for each
Vector = Union[str, Sequence[float], np.ndarray]
Report = Any  # of one frame a dict, or words, of several a list of them

WARNING = re.compile(r"(mr-\S+): (?:.*?: )?warning: .*?(?: \[(\S+)\])?")


@functools.lru_cache(None)
def program(tool):
    """The tool's file: in the nearest bin/ above this package, where its wheel has put it, or on the PATH."""
    path = os.pathsep.join(str(folder / "bin") for folder in pathlib.Path(__file__).resolve().parents[:-1])
    found = shutil.which(tool, path=path) or shutil.which(tool)
    if not found:
        raise Error(f"{tool} is neither beside the package mr nor on the PATH")
    return found


def feed(pipe, frames, faults):
    """Writes frames to a tool.  Where that fails END is missing, so the tool fails, too."""
    try:
        with pipe:
            write(pipe, map(a_frame, frames), history=None)
    except BrokenPipeError:
        pass  # the tool says why
    except BaseException as fault:
        faults.append(fault)


def a_frame(frame):
    if not isinstance(frame, Frame):
        raise TypeError(f"a frame is expected, not {type(frame).__name__}")
    return frame


class Run:
    """A tool at work: an iterator of the frames that it gives."""

    def __init__(self, tool, arguments, source=None, files=()):
        """source: the frames that it reads.  files: opened ones that arguments name as /dev/fd/N."""
        piped = isinstance(source, Run) and source.is_fresh()
        self.tool, self.files, self.source, self.faults = tool, files, source if piped else None, []
        path, self.text = program(tool), tempfile.TemporaryFile()
        stdin = source.process.stdout if piped else subprocess.DEVNULL if source is None else subprocess.PIPE
        self.process = subprocess.Popen([tool, *arguments], executable=path, stdin=stdin, stderr=self.text,
                                        stdout=subprocess.PIPE, pass_fds=[file.fileno() for file in files])
        self.frames = read(self.process.stdout)
        if piped:
            source.frames = None
            source.process.stdout.close()
        elif source is not None:
            threading.Thread(target=feed, args=(self.process.stdin, source, self.faults), daemon=True).start()

    def is_fresh(self):
        """Whether all frames are still to be taken."""
        return self.frames is not None and inspect.getgeneratorstate(self.frames) == inspect.GEN_CREATED

    def __iter__(self):
        return self

    def __next__(self):
        if self.frames is None:
            raise Error(f"{self.tool}: another tool has its frames")
        try:
            return next(self.frames)
        except (StopIteration, StreamError) as error:
            end = error
        self.finish()
        raise end

    def only(self):
        """Its one frame."""
        frames = list(self)
        if len(frames) != 1:
            raise Error(f"{self.tool}: {len(frames)} frames come of it, not one: give it [frame] to have them in turn")
        return frames[0]

    def output(self):
        """What it writes, where that is no stream."""
        data = self.process.stdout.read()
        self.finish()
        return data

    def finish(self):
        """Waits for it and the tools before it, warns of findings, and raises what failed first."""
        for failure in self.failures():
            raise failure

    def failures(self):
        if self.text.closed:
            return []
        failed = self.source.failures() if self.source else []
        self.process.stdout.close()
        status = self.process.wait()
        failed += self.faults
        said = self.said()
        self.close()
        if status == 0 and said:  # -v, or --stats
            print(*said, sep="\n", file=sys.stderr)
        elif status < 0 and status != -signal.SIGPIPE:
            failed.append(Error(f"{self.tool}: ended by {signal.Signals(-status).name}"))
        elif status > 0 and (said or not failed):  # one that fails for the one before has nothing to say
            failed.append(Error("\n".join(said) or f"{self.tool}: failed with status {status}"))
        return failed

    def said(self):
        """The lines of its standard error but for findings, of which it warns."""
        self.text.seek(0)
        lines = self.text.read().decode(errors="replace").splitlines()
        found = [(line, WARNING.fullmatch(line)) for line in lines]
        for line, match in found:
            if match:
                warn(Finding(line, *match.groups()))
        return [line for line, match in found if not match and not line.startswith("Try '")]

    def close(self):
        """Ends it, if nobody has read to its end."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        for file in (self.process.stdout, self.text, *self.files):
            file.close()

    def __del__(self):
        if hasattr(self, "process"):
            self.close()


def warn(finding):
    """Warns where the caller of this package stands."""
    depth, frame = 1, sys._getframe()
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        depth, frame = depth + 1, frame.f_back
    warnings.warn(finding, stacklevel=depth)


def frames_of(source):
    if isinstance(source, Frame):
        return [source]
    if not isinstance(source, Iterable) or isinstance(source, (str, bytes, dict, np.ndarray)):
        raise TypeError(f"a frame is expected, or several, not {type(source).__name__}")
    return source


def is_stream(value):
    return isinstance(value, (Frame, Iterator)) or \
        isinstance(value, (list, tuple)) and bool(value) and isinstance(value[0], Frame)


def word(value, files):
    """A value as a word of a command line; frames become a file without a name, which is added to files."""
    if is_stream(value):
        files.append(tempfile.TemporaryFile())
        write(files[-1], map(a_frame, frames_of(value)), history=None)
        return f"/dev/fd/{files[-1].fileno()}"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, numbers.Integral) and not isinstance(value, bool):
        return str(int(value))
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return repr(float(value)).removesuffix(".0")
    if isinstance(value, (np.ndarray, list, tuple)):
        return ",".join(word(number, files) for number in np.ravel(value).tolist())
    raise TypeError(f"neither text, numbers nor frames: {type(value).__name__}")


def option(name, value, files):
    """An option's words.  A list of texts, or of vectors, is one for each; a mapping, one for each KEY=VALUE."""
    name = "--" + name.rstrip("_").replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [name]
    if isinstance(value, dict):
        value = [f"{word(key, files)}={word(of_key, files)}" for key, of_key in value.items()]
    several = isinstance(value, (list, tuple)) and not is_stream(value) and \
        not all(isinstance(one, numbers.Real) for one in value)
    return [f"{name}={word(one, files)}" for one in (value if several else [value])]


def tool(name: str) -> Callable[[Function], Function]:
    """Makes a function of its typed signature: operands by position, options by name, the result as its type says."""
    def decorate(typed):
        signature = inspect.signature(typed)
        result = typed.__annotations__["return"]

        @functools.wraps(typed)
        def call(*given, **named):
            operands, files, source = [], [], None
            try:
                arguments = signature.bind(*given, **named).arguments
            except TypeError as error:
                raise TypeError(f"mr.{typed.__name__}: {error}") from None
            for key, value in arguments.items():
                if key == "source":
                    source = frames_of(value)
                elif signature.parameters[key].kind is inspect.Parameter.VAR_POSITIONAL:
                    operands += ["-"] * (key == "more") + list(value)
                elif key not in named and value is not None:
                    operands.append(value)
            reports = result == "Report" and not named.get("column")
            words = [one for key, value in named.items() for one in option(key, value, files)]  # in order, which counts
            words += ["--json"] * reports + ["--"] * bool(operands) + [word(operand, files) for operand in operands]
            run = Run(name, words, source, files)
            alone = all(isinstance(one, Frame) for one in (arguments.get("source"), *arguments.get("more", ())))
            if reports:
                lines = [json.loads(line) if line[:1] == "{" else line for line in run.output().decode().splitlines()]
                return lines[0] if alone and len(lines) == 1 else lines
            if result == "bytes":
                return run.output()
            return run.only() if alone or result == "Frame" else run
        return call
    return decorate
