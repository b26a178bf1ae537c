"""Streams of meshes (man 5 mr-stream), read and written with numpy alone; a copy of this file works by itself, too.

    for frame in stream.read("x.mrs"):            # a path, "-" (standard input) or a binary file
        p = frame["mesh"]["position"]               # (vertices, 3), float64
        t = frame["mesh"]["triangles"]              # (faces, 3), uint32
        print(frame.name, frame.key, list(frame), list(frame["mesh"]), frame.history)

A filter, for `mr-import x.obj | python3 scale.py 2.5 | mr-export y.obj`:

    import sys
    from mr import stream

    def scaled(frames, factor):
        for frame in frames:
            for layer in frame:
                if "position" in frame[layer]:
                    frame[layer]["position"] = factor * frame[layer]["position"]
            yield frame

    stream.write("-", scaled(stream.read("-"), float(sys.argv[1])))

From nothing, a key frame, and a delta that sends its positions alone:

    frame = stream.Frame("triangle")
    frame.put("mesh", "position", [[0, 0, 0.0], [1, 0, 0], [0, 1, 0]], "v")
    frame.put("mesh", "triangles", [[0, 1, 2]], "f")
    with stream.writer("x.mrs") as out:
        out.put(frame)
        frame.key = False
        frame["mesh"]["position"] = 2 * frame["mesh"]["position"]
        out.put(frame)

A frame maps names to layers, a layer names to values; the layer "" has the columns that belong to none.  Values are
str, or arrays that cannot be written to and stay valid: views of the mapped file, or of what was read, unless the
column is packed.  Rows of one component make an array of one dimension.  A delta comes merged with what it keeps.

What is put is copied.  A column that was there keeps its element (v, f or -) and type (d, u or b); of a new one they
are what its rows and dtype say, or put says.  frame.columns[layer, name] is the record, with these.  What a change
makes stale is to be removed by `del frame["base"]` or `del frame["mesh"]["normal"]`.  What nobody touches is written
as it came, byte for byte; a line is added to the history.

The laws of the format are checked, and the checksums of a frame before it is given, also of columns that nobody uses:
StreamError, and CutOff where END is missing; so read to the end to know that the tool before succeeded.  END is written
unless an exception ends the block of writer(), or the frames of write().
"""
from __future__ import annotations

import contextlib
import io
import mmap
import os
import re
import shlex
import stat
import struct
import sys
import zlib
from collections.abc import MutableMapping
from typing import Any, Iterable, Iterator

import numpy as np

HEAD = struct.Struct("<16s24sccBBIQQ")  # layer, name, element, type, components, codec, checksum, rows, stored
MAGIC = b"mrmesh1\n"
TYPES = {"d": np.dtype("<f8"), "u": np.dtype("<u4"), "b": np.dtype("u1"), "t": np.dtype("u1")}
KINDS = {"START": 0, "FRAME": 261, "DROP": 24, "ENDFRAME": 0, "END": 0}  # what is no column: most bytes of its text
BLOCK = 32768  # rows that are packed together
CHUNK = 1 << 20  # bytes asked of a pipe at first: no header gets memory for what has not arrived


class Error(Exception):
    """What was asked for failed; its text is one sentence."""


class StreamError(Error, ValueError):
    """A stream, or a frame to be written, breaks a law of mr-stream(5)."""


class CutOff(StreamError):
    """A stream ends without END: the tool that wrote it failed."""


class Finding(UserWarning):
    """What a tool reports of a result that it gives all the same (man 7 mr-findings); what is not known is None.

    tool, kind, layer; count, of (how many, of how many); value, limit; vertex, at (the worst place); what (words).
    """

    def __init__(self, sentence, tool=None, kind=None, layer=None, count=None, of=None, value=None, limit=None,
                 vertex=None, at=None, what=None):
        super().__init__(sentence)
        self.tool, self.kind, self.layer, self.count, self.of = tool, kind, layer, count, of
        self.value, self.limit, self.vertex, self.at, self.what = value, limit, vertex, at, what

    @classmethod
    def of_line(cls, line):
        """From a line of the column findings."""
        tool, kind, layer, count, of, value, limit, vertex, *at, what = line.split("\t")
        count, of, value, limit = int(count), int(of), float(value), float(limit)
        words = what or (f"{count} of {of}" if of else f"{count or value:.3g}")
        return cls(f"{tool}: {layer}{layer and ': '}{words} [{kind}]", tool, kind, layer or None, count or None,
                   of or None, value or None, limit or None, int(vertex) if vertex else None,
                   tuple(map(float, at)) if at[0] else None, what or None)


class Column:
    """A record: layer, name, element, type, components, codec, rows; payload, as it is stored; values, decoded."""

    def __init__(self, head, at=None):
        """Checks what a header shows alone.  at: the byte where it was read; None: it was not read but put."""
        self.head, self.at, self.payload, self._values = head, at, b"", None
        layer, name, element, kind, self.components, self.codec, self.checksum, *sizes = HEAD.unpack(head)
        self.rows, self.stored = sizes
        start = layer == MAGIC.ljust(16, b"\0")
        fields = [re.fullmatch(rb"([!-~]*)\0*", field) for field in (b"" if start else layer, name)]
        self.layer, self.name = (field[1].decode() if field else None for field in fields)
        self.element, self.type = element.decode("latin-1"), kind.decode("latin-1")
        if self.layer is None or not self.name or start != (self.name == "START"):
            self.fail("no record begins here: a bad name of a layer or column")
        if (self.element not in "vf-" or self.type not in TYPES or not self.components or self.codec > 1
                or self.type == "t" and self.components > 1):
            self.fail(f"no such element {element}, type {kind}, components {self.components} or codec {self.codec}")
        self.size = self.rows * self.components * TYPES[self.type].itemsize
        least, most = (self.size // 1032, (1 << 56) - 1) if self.codec else (self.size, self.size)
        if self.size > 1 << 56 or not least <= self.stored <= most:
            self.fail(f"{self.stored} bytes stored cannot be {self.rows} rows, {self.size} bytes")
        if self.name in KINDS and (self.element + self.type != "-t" or self.codec or self.stored > KINDS[self.name]
                                   or self.layer and self.name != "DROP"):
            self.fail(f"not raw text of no layer, at most {KINDS[self.name]} bytes")

    @classmethod
    def encode(cls, layer, name, element, kind, components, payload, rows):
        fields = [text.encode() for text in (layer, name, element, kind)]
        if any(len(field) > most for field, most in zip(fields, (16, 24, 1, 1))) or components > 255:
            raise StreamError(f"{layer}.{name}: beyond 16 and 24 characters, element v, f or -, or 255 components")
        head = HEAD.pack(*fields, components, 0, 0, rows, len(payload))
        column = cls(HEAD.pack(*fields, components, 0, zlib.crc32(payload, zlib.crc32(head)), rows, len(payload)))
        column.payload = payload
        return column

    def fail(self, sentence):
        where = "" if self.at is None else f"byte {self.at}: "
        raise StreamError(f"{where}{self.layer or ''}{'.' if self.layer else ''}{self.name or 'record'}: {sentence}")

    def fill(self, body):
        """Takes the payload, with the zeros behind it."""
        self.payload = body[:self.stored]
        checksum = zlib.crc32(self.payload, zlib.crc32(self.head[:44] + bytes(4) + self.head[48:]))
        if any(body[self.stored:]):
            self.fail("the padding is not zero")
        if checksum != self.checksum:
            self.fail(f"the checksum is {checksum:08x}, not {self.checksum:08x}: damaged bytes")
        return self

    @property
    def values(self):
        if self._values is None:
            data = self._unpack() if self.codec else self.payload
            shape = (self.rows, self.components) if self.components > 1 else self.rows
            self._values = (str(data, "utf-8", "surrogateescape") if self.type == "t"
                            else np.ndarray(shape, TYPES[self.type], data))
        return self._values

    def _unpack(self):
        """Codec 1: of a block, for each component, for each byte of its differences, that byte of all rows."""
        inflate = zlib.decompressobj()
        try:
            planes = inflate.decompress(self.payload, self.size + 1)
        except zlib.error as error:
            self.fail(f"packed bytes are damaged: {error}")
        if len(planes) != self.size or not inflate.eof or inflate.unused_data:
            self.fail(f"packed bytes are not those of {self.rows} rows")
        width = TYPES[self.type].itemsize
        values = np.empty((self.rows, self.components), f"<u{width}")
        for first in range(0, self.rows, BLOCK):
            block = values[first:first + BLOCK]
            stored = np.ndarray((self.components, width, len(block)), np.uint8, planes, first * self.components * width)
            steps = np.empty((self.components, len(block), width), np.uint8)
            for byte in range(width):  # takes a third of the time of one transposition
                steps[:, :, byte] = stored[:, byte]
            np.cumsum(steps.view(values.dtype)[:, :, 0], axis=1, dtype=values.dtype, out=block.T)
        return memoryview(values.reshape(-1).view(np.uint8)).toreadonly()

    def same(self, other):
        """Whether a delta keeps it: the very record that was read, or bytes that have been put again."""
        return self is other or self.at is other.at is None and (self.head, self.payload) == (other.head, other.payload)


class Layer(MutableMapping):
    """The columns of one layer of a frame, name: values.  What is done to it is done to the frame."""

    def __init__(self, frame, layer):
        self.frame, self.layer = frame, layer

    def __getitem__(self, name):
        return self.frame.columns[self.layer, name].values

    def __setitem__(self, name, values):
        self.frame.put(self.layer, name, values)

    def __delitem__(self, name):
        del self.frame.columns[self.layer, name]

    def __contains__(self, name):
        return (self.layer, name) in self.frame.columns

    def __iter__(self):
        return iter([name for layer, name in self.frame.columns if layer == self.layer])

    def __len__(self):
        return len(list(iter(self)))


class Frame:
    """Its name; key (False: a delta); columns, {(layer, name): Column} in order; and its layers by name."""

    def __init__(self, name: str, key: bool = True, columns: Any = ()):
        if not isinstance(name, str):
            raise StreamError(f"a frame cannot be called {name!r}")
        self.name, self.key, self.columns = name, key, dict(columns)

    def __iter__(self):
        return iter(dict.fromkeys(layer for layer, _ in self.columns))

    def __getitem__(self, layer: str) -> Layer:
        if layer not in self:
            raise KeyError(layer)
        return Layer(self, layer)

    def __delitem__(self, layer):
        for name in self[layer]:
            del self.columns[layer, name]

    @property
    def history(self) -> str:
        """A line for each tool that the frame has been through."""
        return self.columns["", "history"].values if ("", "history") in self.columns else ""

    @property
    def findings(self) -> list[Finding]:
        """What the tools found poor in it: a list of Finding."""
        lines = self.columns["", "findings"].values if ("", "findings") in self.columns else ""
        return [Finding.of_line(line) for line in lines.splitlines() if line.count("\t") == 11]

    def __repr__(self):
        layers = []
        for layer in filter(None, self):
            rows = {c.element: c.rows for c in self.columns.values() if c.layer == layer}
            layers.append(f"{layer} ({rows.get('v', 0)} vertices, {rows.get('f', 0)} faces)")
        return f"<mr.Frame {self.name!r}: {', '.join(layers) or 'empty'}>"

    def put(self, layer: str, name: str, values: Any, element: str | None = None) -> None:
        """Puts text, or rows of numbers: of vertices (element "v"), faces ("f") or neither ("-")."""
        if not all(isinstance(text, str) for text in (layer, name, element or "")):
            raise StreamError(f"{layer}.{name}: layer, column and element are text")
        old = self.columns.get((layer, name))
        kind, components, payload, rows = _encoded(f"{layer}.{name}", values, old.type if old else None)
        if name in KINDS or "\0" in layer + name:
            raise StreamError(f"{layer}.{name}: no name of a column")
        if not element and (old or kind == "t"):
            element = old.element if old else "-"
        if not element:
            fitting = {c.element for c in self.columns.values() if (c.layer, c.rows) == (layer, rows)} - {"-"}
            if len(fitting) != 1:
                raise StreamError(f"{layer}.{name}: {rows} rows do not say of which element they are: v, f or -")
            element = fitting.pop()
        self.columns[layer, name] = Column.encode(layer, name, element, kind, components, payload, rows)

    def check(self):
        """What a frame must satisfy with its columns merged."""
        firsts = {}
        for column in self.columns.values():
            first = firsts.setdefault((column.layer, column.element), column)
            if column.element != "-" and column.rows != first.rows:
                column.fail(f"{column.rows} rows, but {first.name}, also of element {first.element}, has {first.rows}")
        if len(self.columns) > 4096:
            raise StreamError(f"{self.name}: {len(self.columns)} columns of 4096")


def mesh(positions: Any, triangles: Any = None, name: str = "mesh") -> Frame:
    """A frame of the layer mesh, or of points where there are no triangles: arrays of three numbers a row."""
    frame, layer = Frame(name), "points" if triangles is None else "mesh"
    columns = [("position", "v", positions, "fiu", np.float64), ("triangles", "f", triangles, "iu", np.uint32)]
    for column, element, values, kinds, dtype in columns[:1 if triangles is None else 2]:
        rows = np.asarray(values)
        if rows.dtype.kind not in kinds or rows.ndim != 2 or rows.shape[1] != 3:
            raise StreamError(f"{layer}.{column}: {rows.dtype} of shape {rows.shape} is not rows of three numbers")
        stored = rows.astype(dtype)
        if not (np.isfinite(stored).all() if element == "v" else np.array_equal(stored, rows)):
            raise StreamError(f"{layer}.{column}: a number is not finite, or no index")
        frame.put(layer, column, stored, element)
    return frame


def _encoded(where, values, kind):
    """Type, components, bytes and rows of values.  kind: the type of the column that they replace."""
    if isinstance(values, str):
        text = values.encode("utf-8", "surrogateescape")
        return "t", 1, text, len(text)
    values = np.asarray(values)
    if values.dtype.kind not in "fiub" or values.ndim not in (1, 2):
        raise StreamError(f"{where}: {values.dtype} of {values.ndim} dimensions is neither text nor rows of numbers")
    if kind in (None, "t"):
        kind = "d" if values.dtype.kind == "f" else "b" if values.dtype in (np.uint8, np.bool_) else "u"
    with np.errstate(invalid="ignore"):
        stored = values.astype(TYPES[kind], copy=False)
    if kind != "d" and not np.array_equal(stored, values):
        raise StreamError(f"{where}: values that type {kind} does not hold")
    try:
        return kind, values.shape[1] if values.ndim == 2 else 1, stored.tobytes(), len(values)
    except MemoryError:
        raise MemoryError(f"{where}: no memory for {values.dtype} of shape {values.shape}") from None


def _frame_name(name):
    """The bytes of a frame's name as text, if it can be one."""
    with contextlib.suppress(UnicodeDecodeError):
        text = name.decode()
        if 0 < len(name) < 256 and text not in (".", "..") and not re.search("[\0-\x1f\x7f-\x9f/]", text):
            return text
    raise StreamError(f"a frame cannot be called {name}")


class _Input:
    """Bytes in order: views of a mapped file, or of memory that grows as they arrive."""

    def __init__(self, file):
        self.file, self.at, self.map = file, 0, None
        with contextlib.suppress(OSError, ValueError):  # an empty file, or one that cannot be mapped, is read
            if isinstance(getattr(file, "raw", file), io.FileIO) and stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                self.at = file.tell()
                self.map = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))

    def take(self, n):
        """The next n bytes, or fewer at the end."""
        if self.map:
            piece = self.map[self.at:self.at + n]
        else:
            data = bytearray()
            while len(data) < n and (more := self.file.read(min(n - len(data), len(data) + CHUNK))):
                data += more
            piece = memoryview(data).toreadonly()
        self.at += len(piece)
        return piece

    def record(self, may_begin=False, may_end=False):
        """The next record; None where the input ends and may."""
        at, head = self.at, bytes(self.take(64))
        if may_end and not head:
            return None
        if may_begin and not MAGIC.startswith(head[:8]):
            raise StreamError(f"byte {at}: this is not a stream: no START here")
        if len(head) == 64:
            record = Column(head, at)
            padded = -(-record.stored // 64) * 64
            body = self.take(padded)
            if len(body) == padded:
                return record.fill(body)
        raise CutOff(f"stream ends without END at byte {self.at}: the previous tool failed")


def _merged(source, columns):
    """The columns of the frame that has begun, from those of the one before."""
    sent = set()
    while (record := source.record()).name != "ENDFRAME":
        place = record.layer, record.name
        if record.name == "DROP":
            name = bytes(record.payload)
            dropped = [p for p in columns if p not in sent and p[0] == record.layer and name in (b"", p[1].encode())]
            if not dropped:
                record.fail(f"the frame before has no {name} to drop")
            for p in dropped:
                del columns[p]
        elif record.name in KINDS or place in sent:
            record.fail("comes twice in a frame" if place in sent else "stands within a frame")
        else:
            columns[place] = record
            sent.add(place)
    return columns


def _frames(source):
    start = source.record(may_begin=True)
    while start:
        columns = None  # those of the frame before
        while (record := source.record()).name != "END":
            kind, _, name = bytes(record.payload[:KINDS["FRAME"]]).partition(b" ")
            if record.name != "FRAME" or kind not in (b"key", b"delta"):
                record.fail("neither a key frame nor a delta begins here")
            if kind == b"delta" and columns is None:
                record.fail("a delta that follows nothing")
            name, columns = _frame_name(name), _merged(source, columns if kind == b"delta" else {})
            frame = Frame(name, kind == b"key", columns)
            frame.check()
            yield frame
        start = source.record(may_begin=True, may_end=True)
    if source.map:
        source.file.seek(source.at)


def read(file: Any = "-") -> Iterator[Frame]:
    """The frames of a file: a path, "-" for standard input, or an object, which is read from where it stands."""
    if isinstance(file, (str, os.PathLike)) and file != "-":
        with open(file, "rb") as opened:
            yield from _frames(_Input(opened))
    else:
        yield from _frames(_Input(sys.stdin.buffer if file == "-" else file))


class Writer:
    """Writes to a binary file; of a delta what differs from what it sent before."""

    def __init__(self, file, history=True):
        """history: the line that is added to each frame's; True: the command line; None: none."""
        command = [os.path.basename(sys.argv[0]) or "python3", *sys.argv[1:]]
        line = f"mr.stream 1.0: {shlex.join(command)}" if history is True else history
        self.line = line and re.sub("[\0-\x1f\x7f-\x9f\ud800-\udfff]", "?", line) + "\n"
        self.file, self.sent, self.started = file, None, False

    def put(self, frame):
        """Writes a frame, key if it says so or is the first.  What can be wrong with it is found before."""
        frame = Frame(frame.name, frame.key or self.sent is None, frame.columns)
        name = _frame_name(frame.name.encode("utf-8", "surrogatepass"))
        if self.line:
            old = frame.history
            frame.put("", "history", old + "\n" * (old[-1:] not in ("", "\n")) + self.line)
        frame.check()
        before = {} if frame.key else self.sent
        rest, kept, sends = iter(before), set(), []
        for place, column in frame.columns.items():
            if place in rest:  # looks on from the last that was found: what has another place now, and follows, is new
                kept.add(place)
            if place not in kept or not before[place].same(column):
                sends.append(column)
        layers = {layer for layer, _ in kept}
        drops = [(layer, column if layer in layers else "") for layer, column in before if (layer, column) not in kept]
        self._write("FRAME", f"{'key' if frame.key else 'delta'} {name}")
        for layer, column in dict.fromkeys(drops):
            self._write("DROP", column, layer)
        for column in sends:
            self._write_record(column)
        self._write("ENDFRAME")
        self.file.flush()
        self.sent = frame.columns

    def end(self):
        """Writes END: to be called only when all went well."""
        self._write("END")
        self.file.flush()

    def _write(self, name, text="", layer=""):
        if not self.started:
            self.started = True
            self._write("START", "", MAGIC.decode())
        self._write_record(Column.encode(layer, name, "-", "t", 1, text.encode(), len(text.encode())))

    def _write_record(self, record):
        for piece in record.head, record.payload, bytes(-record.stored % 64):
            piece = memoryview(piece)
            while piece:  # a raw file takes what it can
                piece = piece[self.file.write(piece):]


@contextlib.contextmanager
def _output(path):
    """A regular file gets its name when all has gone well: it may be the one that is mapped and read."""
    path, regular = os.path.realpath(path), os.path.isfile(path) or not os.path.exists(path)
    beside = f"{path}.{os.getpid()}~" if regular else path
    mode = None
    if regular and os.path.exists(path):
        with open(path, "r+b") as old:  # fails where it may not be written
            mode = os.fstat(old.fileno()).st_mode & 0o7777
    with open(beside, "wb") as file:
        try:
            if mode is not None:
                os.chmod(beside, mode)
            yield file
            if regular:
                os.replace(beside, path)
        except BaseException:
            if regular:
                os.unlink(beside)
            raise


@contextlib.contextmanager
def writer(file="-", history=True):
    """A Writer to a path, "-" for standard output, or a binary file; END is written unless the block raises."""
    place = isinstance(file, (str, os.PathLike)) and file != "-"
    with _output(file) if place else contextlib.nullcontext(sys.stdout.buffer if file == "-" else file) as opened:
        out = Writer(opened, history)
        yield out
        out.end()


def write(file: Any, frames: Iterable[Frame], history: bool | str | None = True) -> None:
    """Writes frames; see writer()."""
    with writer(file, history) as out:
        for frame in frames:
            out.put(frame)
