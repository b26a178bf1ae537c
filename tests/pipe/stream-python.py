# What stream-python.sh asks of mr.stream from within: values, copies, damage, laws, deltas, files.
import glob, gzip, io, mmap, os, struct, subprocess, sys, tracemalloc, zlib

import numpy as np

from mr import stream as mrstream
import page  # the program in mr-stream(5), which knows no numpy

failed = 0


def check(good, what):
    global failed
    if not good:
        failed = 1
        print(what)


def raises(error, act, what):
    try:
        act()
    except Exception as caught:
        check(type(caught) is error, f"{what}: {caught!r}")
    else:
        check(False, f"{what}: no {error.__name__}")


def run(command, stdin=b""):
    return subprocess.run(command, shell=True, input=stdin, capture_output=True, check=True).stdout


def data(path):
    with open(path, "rb") as f:
        return f.read()


def all_of(file):
    """Name, key and values of every frame, each looked at before the next is read."""
    return [(frame.name, frame.key, {place: (c.element, c.type, c.components, c.rows, stored_bytes(c.values))
                                     for place, c in frame.columns.items()}) for frame in mrstream.read(file)]


def stored_bytes(values):
    return values.encode("utf-8", "surrogateescape") if isinstance(values, str) else values.tobytes()


def paged(stream):
    """The same by the page's program; it does not tell keys."""
    return [(name.decode(), {(layer.decode(), name.decode()): (element.decode(), kind.decode(), n, rows, values)
                             for (layer, name), ((element, kind, n), rows, values) in columns.items()})
            for name, columns in page.read(io.BytesIO(stream))]


# Values, merged and unpacked, are the page's; from a map, a pipe, memory and a gzip file.  Written without a change they
# are the bytes of mr-cat.
accepts = "mr-cat -z --no-history | mr-cat -u --no-history"  # together they verify every column
for path in "a.mrs", "z.mrs", "pose.mrs", "walk.mrs", "walkz.mrs", "smallz.mrs", "all.mrs", "none.mrs":
    frames = all_of(path)
    check([(name, columns) for name, _, columns in frames] == paged(data(path)), f"{path}: other values than the page's")
    check([list(columns) for _, _, columns in frames] == [list(columns) for _, columns in paged(data(path))],
          f"{path}: another order")
    with subprocess.Popen(["cat", path], stdout=subprocess.PIPE) as pipe:
        check(all_of(pipe.stdout) == frames, f"{path}: a pipe has other values")
    check(all_of(io.BytesIO(data(path))) == frames, f"{path}: memory has other values")
    with gzip.open("gz", "wb", 1) as f:
        mrstream.write(f, mrstream.read(path), history=None)
    with gzip.open("gz") as f:
        check(f.read() == run(f"mr-cat --no-history {path}"), f"{path}: written with other bytes than mr-cat's")
        f.seek(0)
        check(all_of(f) == frames, f"{path}: gzip has other values")
check([key for _, key, _ in all_of("walk.mrs")] == [True] + 4 * [False], "keys and deltas are confused")
check(all_of("none.mrs") == [], "a stream of no frames has some")

# Shapes; numbers are those that mr-export writes.
for frame in mrstream.read("walkz.mrs"):
    mesh = frame["mesh"]
    shapes = {name: (mesh[name].dtype.str, mesh[name].ndim) for name in ("position", "triangles", "region")}
    check(shapes == {"position": ("<f8", 2), "triangles": ("<u4", 2), "region": ("<u4", 1)}, f"shapes {shapes}")
    check("normal" not in mesh and "nothing" not in frame and len(mesh) == len(list(mesh)), "what is there")
    check(frame.history == frame[""]["history"] and frame.history.endswith("mr-cat -z walk.mrs\n"), frame.history)
run("mr-export walk-%d.obj -l mesh -i walkz.mrs")
for number, frame in enumerate(mrstream.read("walkz.mrs"), 1):
    lines = [line.split() for line in data(f"walk-{number}.obj").splitlines()]
    for name, letter, kind, first in ("position", b"v", float, 0), ("triangles", b"f", int, 1):
        exported = np.array([[kind(x.split(b"/")[0]) for x in line[1:4]] for line in lines if line[:1] == [letter]])
        check(np.array_equal(exported - first, frame["mesh"][name]), f"walk {number}: mr-export has other {name}")


# No copy: the arrays lie in the map of the file, or in the buffer that was read; nobody can write to them.
def owner(array):
    while isinstance(array, (np.ndarray, memoryview)):
        array = array.base if isinstance(array, np.ndarray) else array.obj
    return array


with open("a.mrs", "rb") as f, subprocess.Popen(["cat", "a.mrs"], stdout=subprocess.PIPE) as pipe:
    for file, kind in ("a.mrs", mmap.mmap), (f, mmap.mmap), (pipe.stdout, bytearray):
        (frame,) = mrstream.read(file)
        for name in "position", "triangles":
            values, column = frame["mesh"][name], frame.columns["mesh", name]
            check(isinstance(owner(values), kind), f"{name}: not a view of {kind}, but {type(owner(values))}")
            check(np.shares_memory(values, np.frombuffer(column.payload, np.uint8)), f"{name}: a copy")
            if kind is mmap.mmap:
                whole = np.frombuffer(owner(values), np.uint8)
                check(values.ctypes.data - whole.ctypes.data == column.at + 64, f"{name}: not where it is stored")
            check(not values.flags.writeable and frame["mesh"][name] is values, f"{name}: can be written to")
    check(f.tell() == os.path.getsize("a.mrs"), "a mapped file is not read to its end")
(packed,) = mrstream.read("z.mrs")
check(packed.columns["points", "position"].codec == 1 and not packed["points"]["position"].flags.writeable, "packed")
with open("shifted", "wb") as f:
    f.write(b"abc" + data("a.mrs"))
with open("shifted", "rb") as f:
    f.seek(3)
    check(all_of(f) == all_of("a.mrs"), "a stream that begins within a file")

# Real faults: what the tools verify is read, with their values, and what they refuse is refused.
for path in glob.glob(os.environ["DATA"] + "/*/*.mrs"):
    try:
        expected = paged(run(accepts, data(path)))
    except subprocess.CalledProcessError:
        raises(mrstream.StreamError, lambda: all_of(path), path)
    else:
        check([frame[::2] for frame in all_of(path)] == expected, f"{path}: other values")

# Every prefix and every flipped byte: an error, and before it only frames as they are.
for path in "small.mrs", "smallz.mrs":
    whole, frames = data(path), all_of(path)
    mutants = [whole[:n] for n in range(len(whole))]
    mutants += [whole[:i] + bytes([whole[i] ^ flip]) + whole[i + 1:] for i in range(len(whole)) for flip in (255, 1 << i % 8)]
    for number, mutant in enumerate(mutants):
        with open("mutant", "wb") as f:
            f.write(mutant)
        for file in "mutant", io.BytesIO(mutant):
            seen, error = [], None
            try:
                for frame in mrstream.read(file):
                    seen.append({place: stored_bytes(c.values) for place, c in frame.columns.items()})
            except mrstream.StreamError as caught:
                error = caught
            check(error and "\n" not in str(error), f"{path}, mutant {number}: {error!r}")
            check(number >= len(whole) or type(error) is mrstream.CutOff, f"{path}, cut at {number}: {error!r}")
            check(seen == [{place: c[4] for place, c in f[2].items()} for f in frames[:len(seen)]],
                  f"{path}, mutant {number}: other values")


# Each law, broken with a right checksum: an error here, and of the tools.
def record(layer, name, element=b"-", kind=b"t", n=1, codec=0, rows=None, data=b"", stored=None, zeros=None):
    rows, stored = len(data) if rows is None else rows, len(data) if stored is None else stored
    head = struct.pack("<16s24sccBBIQQ", layer, name, element, kind, n, codec, 0, rows, stored)
    head = head[:44] + struct.pack("<I", zlib.crc32(data, zlib.crc32(head))) + head[48:]
    return head + data + (bytes(-len(data) % 64) if zeros is None else zeros)


def numbers(layer, name, rows, element=b"v", n=1):
    return record(layer, name, element, b"d", n, rows=rows, data=bytes(8 * n * rows))


START, ENDFRAME, END = record(b"mrmesh1\n", b"START"), record(b"", b"ENDFRAME"), record(b"", b"END")


def stream(*frames):
    return START + b"".join(record(b"", b"FRAME", data=text) + b"".join(columns) + ENDFRAME for text, *columns in frames) + END


def key(*columns):
    return stream((b"key x", *columns))


def delta(*columns):
    return stream((b"key x", p, q), (b"delta x", *columns))


def drop(layer, name=b"", **rest):
    return record(layer, b"DROP", data=name, **rest)


p, q = numbers(b"l", b"p", 3, n=3), numbers(b"l", b"q", 3)
planes = zlib.compress(bytes(24))
good = {
    "layers of 16, names of 24": key(numbers(b"l" * 16, b"n" * 24, 2)),
    "255 components": key(numbers(b"l", b"n", 2, n=255)),
    "no rows": key(numbers(b"l", b"n", 0), record(b"", b"t"), record(b"l", b"z", b"f", b"u", 3, 1, 0, zlib.compress(b""))),
    "no columns": key(),
    "a name of 255 bytes": stream((b"key " + "ä".encode() * 127 + b"b",)),
    "packed": key(record(b"l", b"p", b"v", b"d", 1, 1, 3, planes)),
    "stored blocks": key(record(b"l", b"p", b"v", b"d", 1, 1, 3, zlib.compress(bytes(24), 0))),
    "drops": delta(drop(b"l", b"p"), drop(b"l"), numbers(b"l", b"p", 7)),
    "a column before the drop of its layer": delta(p, drop(b"l")),
    "rows of -": key(numbers(b"l", b"p", 3), numbers(b"l", b"q", 4, b"-"), numbers(b"l", b"r", 5, b"f")),
    "streams in a row": key(p) + key(q) + START + END,
}
broken = {
    "no START": key()[64:],
    "START with a name": record(b"mrmesh1\nx", b"START") + END,
    "START of version 2": record(b"mrmesh2\n", b"START") + END,
    "a column for START": record(b"mrmesh1\n", b"p") + END,
    "a column of START's layer": key(record(b"mrmesh1\n", b"p")),
    "START with a payload": record(b"mrmesh1\n", b"START", data=b"x") + END,
    "START within": START + START + END,
    "a byte behind END": key() + b"x",
    "a record behind END": key() + END,
    "END within a frame": START + record(b"", b"FRAME", data=b"key x") + END,
    "END with a layer": START + record(b"l", b"END"),
    "END with a payload": START + record(b"", b"END", data=b"x"),
    "END of a vertex": START + record(b"", b"END", b"v"),
    "END of bytes": START + record(b"", b"END", kind=b"b"),
    "END packed": START + record(b"", b"END", codec=1, rows=0, data=zlib.compress(b"")),
    "a column outside": START + p + END,
    "ENDFRAME outside": START + ENDFRAME + END,
    "FRAME within a frame": key(record(b"", b"FRAME", data=b"key y")),
    "FRAME with a layer": START + record(b"l", b"FRAME", data=b"key x") + ENDFRAME + END,
    "a first delta": stream((b"delta x",)),
    "a first delta of a second stream": key() + stream((b"delta x",)),
    "neither key nor delta": stream((b"keys x",)),
    "no space": stream((b"key",)),
    "no name": stream((b"key ",)),
    "a name of 256 bytes": stream((b"key " + b"n" * 256,)),
    "name .": stream((b"key .",)),
    "name ..": stream((b"key ..",)),
    "name a/b": stream((b"key a/b",)),
    "a control in a name": stream((b"key a\x7f",)),
    "a C1 control in a name": stream((b"key a\xc2\x9f",)),
    "a name overlong": stream((b"key \xc1\x81",)),
    "a surrogate in a name": stream((b"key \xed\xa0\x80",)),
    "no name of a column": key(record(b"l", b"")),
    "a blank in a name": key(record(b"l", b"a b")),
    "a byte of 128 in a layer": key(record(b"\x80", b"a")),
    "a name behind zeros": key(record(b"l", b"a\0b")),
    "element w": key(numbers(b"l", b"p", 3, b"w")),
    "type e": key(record(b"l", b"p", b"v", b"e", rows=3, data=bytes(3))),
    "codec 2": key(record(b"l", b"p", b"v", b"b", codec=2, rows=3, data=zlib.compress(bytes(3)))),
    "no components": key(record(b"l", b"p", b"v", b"d", 0, rows=3)),
    "text of two components": key(record(b"l", b"p", b"-", b"t", 2, rows=1, data=b"ab")),
    "stored more than rows": key(record(b"l", b"p", b"v", b"d", rows=1, data=bytes(16))),
    "stored less than rows": key(record(b"l", b"p", b"v", b"d", rows=3, data=bytes(16))),
    "2^64 - 1 rows": key(record(b"l", b"p", b"v", b"d", rows=2 ** 64 - 1)),
    "a size that wraps": key(record(b"l", b"p", b"v", b"d", rows=2 ** 61)),
    "a size over 2^56": key(record(b"l", b"p", b"v", b"d", rows=2 ** 53 + 1, stored=2 ** 56 + 8)),
    "2^56 stored": key(record(b"l", b"p", b"v", b"d", codec=1, rows=1, stored=2 ** 56)),
    "over 1032 to 1": key(record(b"l", b"p", b"v", b"b", codec=1, rows=1032 * 12, data=zlib.compress(b"")[:11])),
    "packed too short": key(record(b"l", b"p", b"v", b"d", codec=1, rows=4, data=planes)),
    "packed too long": key(record(b"l", b"p", b"v", b"d", codec=1, rows=2, data=planes)),
    "packed and cut": key(record(b"l", b"p", b"v", b"d", codec=1, rows=3, data=planes[:-1])),
    "packed and more": key(record(b"l", b"p", b"v", b"d", codec=1, rows=3, data=planes + b"x")),
    "packed, its sum wrong": key(record(b"l", b"p", b"v", b"d", codec=1, rows=3, data=planes[:-1] + b"x")),
    "packed, another format": key(record(b"l", b"p", b"v", b"d", codec=1, rows=3, data=gzip.compress(bytes(24)))),
    "padding": key(record(b"l", b"p", b"v", b"d", rows=3, data=bytes(24), zeros=bytes(39) + b"x")),
    "a column twice": key(p, p),
    "rows of v": key(p, numbers(b"l", b"q", 4)),
    "rows of f": key(numbers(b"l", b"p", 3, b"f"), numbers(b"l", b"q", 2, b"f")),
    "rows of v, of no layer": key(numbers(b"", b"p", 3), numbers(b"", b"q", 4)),
    "rows of v in a delta": delta(numbers(b"l", b"q", 4)),
    "a drop in a key": key(p, drop(b"l")),
    "a drop of nothing": delta(drop(b"l", b"r")),
    "a drop of another layer": delta(drop(b"m", b"p")),
    "a drop of what was sent": delta(p, drop(b"l", b"p")),
    "a drop of what was sent, all": delta(p, q, drop(b"l")),
    "a drop twice": delta(drop(b"l"), drop(b"l")),
    "a drop of 25 bytes": delta(drop(b"l", b"p" * 25)),
    "a drop packed": delta(drop(b"l", codec=1, rows=0)),
}
for what, bytes_ in good.items():
    check([frame[::2] for frame in all_of(io.BytesIO(bytes_))] == paged(run(accepts, bytes_)), f"{what}: other values")
    out = io.BytesIO()
    mrstream.write(out, mrstream.read(io.BytesIO(bytes_)), history=None)
    check(out.getvalue() == run("mr-cat --no-history", bytes_), f"{what}: mr-cat writes other bytes")
for what, bytes_ in broken.items():
    look = all_of if what.startswith("packed") else lambda file: list(mrstream.read(file))  # all else shows unasked
    raises(mrstream.StreamError, lambda: look(io.BytesIO(bytes_)), what)
    raises(subprocess.CalledProcessError, lambda: run(accepts, bytes_), f"the tools, {what}")
columns = [record(b"", b"c%d" % i) for i in range(4097)]
check(len(all_of(io.BytesIO(key(*columns[1:])))[0][2]) == 4096, "4096 columns")
raises(mrstream.StreamError, lambda: all_of(io.BytesIO(key(*columns))), "4097 columns")

# What a header promises gets no memory before it arrives.
tracemalloc.start()
for what, error, promise in (
    ("raw", mrstream.CutOff, record(b"l", b"p", b"v", b"d", rows=2 ** 50, stored=2 ** 53)),
    ("packed", mrstream.CutOff, record(b"l", b"p", b"v", b"d", codec=1, rows=2 ** 50, stored=2 ** 45)),
    ("packed to 1032", mrstream.StreamError,
     record(b"l", b"p", b"v", b"b", codec=1, rows=1032 << 18, data=zlib.compress(bytes(24)).ljust(1 << 18, b"\0"))),
):
    with open("promise", "wb") as f:
        f.write(key(promise))
    with subprocess.Popen(["cat", "promise"], stdout=subprocess.PIPE) as pipe:
        for file in "promise", pipe.stdout:
            tracemalloc.reset_peak()
            before = tracemalloc.get_traced_memory()[0]
            raises(error, lambda: all_of(file), f"a promise, {what}")
            peak = tracemalloc.get_traced_memory()[1] - before
            check(peak < 8 << 20, f"a promise, {what}: {peak} bytes")
tracemalloc.stop()

# Text of any bytes is str, and comes back.
wild = key(record(b"", b"history", data=bytes(range(256)) + "ä\n".encode()), record(b"l", b"t", data="ö".encode()))
(frame,) = mrstream.read(io.BytesIO(wild))
check(frame["l"]["t"] == "ö" and frame.history.endswith("ä\n"), "text")
frame["l"]["t"], frame[""]["history"] = frame["l"]["t"], frame.history
out = io.BytesIO()
mrstream.write(out, [frame], history=None)
check(out.getvalue() == wild, "text put again has other bytes")
for text, before in (bytes(range(256)) + b"\n", bytes(range(256)) + b"\n"), (b"open", b"open\n"), (b"", b""):
    out = io.BytesIO()
    mrstream.write(out, mrstream.read(io.BytesIO(key(record(b"", b"history", data=text)))), history="a\nb\x9f\udcff ä")
    history = next(page.read(io.BytesIO(out.getvalue())))[1][b"", b"history"][2]
    check(history == before + "a?b?? ä\n".encode(), f"history: {history}")


# What is put: the element and type that were there, else what rows and dtype say; nothing that would change.
def put(values, layer="l", name="r", element=None):
    indices = record(b"l", b"u", b"v", b"u", rows=3, data=bytes(12))
    (frame,) = mrstream.read(io.BytesIO(key(p, q, numbers(b"l", b"f", 2, b"f"), indices)))
    frame.put(layer, name, values, element)
    column = frame.columns[layer, name]
    out = io.BytesIO()
    mrstream.write(out, [frame])
    (again,) = mrstream.read(io.BytesIO(out.getvalue()))
    check(np.array_equal(again[layer][name], column.values), f"{name}: written otherwise")
    return column.element + column.type + str(column.components), stored_bytes(again[layer][name])


def doubles(*values):
    return struct.pack(f"<{len(values)}d", *values)


for given, want in (
    (put([1.5, 2, 3]), ("vd1", doubles(1.5, 2, 3))),
    (put(np.array([[1, 2], [3, 4]], ">i2")), ("fu2", struct.pack("<4I", 1, 2, 3, 4))),
    (put(np.array([1, 2, 3], np.uint8)), ("vb1", b"\1\2\3")),
    (put([True, False]), ("fb1", b"\1\0")),
    (put([1, 2, 3], name="q"), ("vd1", doubles(1, 2, 3))),
    (put(np.arange(6, dtype=np.float32).reshape(2, 3).T, name="q"), ("vd2", doubles(0, 3, 1, 4, 2, 5))),
    (put([0.0, 7, 2 ** 32 - 1], name="u"), ("vu1", struct.pack("<3I", 0, 7, 2 ** 32 - 1))),
    (put("ä"), ("-t1", "ä".encode())),
    (put(np.empty((0, 3)), "new", "position", "v"), ("vd3", b"")),
    (put([7], element="-"), ("-u1", struct.pack("<I", 7))),
):
    check(given == want, f"put {given}, not {want}")
for what, act in {
    "rows of no element": lambda: put([1, 2, 3, 4, 5]),
    "a new layer": lambda: put([1, 2, 3], "new"),
    "rows of another number": lambda: put([1, 2, 3, 4], name="q"),
    "a negative index": lambda: put([-1, 0, 1], name="u"),
    "an index of 2^32": lambda: put([2 ** 32, 0, 1]),
    "a half": lambda: put([0.5, 0, 1], name="u"),
    "nan": lambda: put([np.nan, 0, 1], name="u"),
    "complex": lambda: put([1j, 0, 1]),
    "words": lambda: put(["a", "b", "c"]),
    "a number": lambda: put(7),
    "three dimensions": lambda: put(np.zeros((3, 2, 2))),
    "no components": lambda: put(np.zeros((3, 0))),
    "256 components": lambda: put(np.zeros((3, 256))),
    "element w": lambda: put([1, 2, 3], element="w"),
    "element vf": lambda: put([1, 2, 3], element="vf"),
    "a long layer": lambda: put([1], "l" * 17, "r", "-"),
    "a long name": lambda: put([1], "l", "r" * 25, "-"),
    "a NUL": lambda: put([1], "l\0", "r", "-"),
    "a NUL behind": lambda: put([1], "l", "r\0", "-"),
    "a blank": lambda: put([1], "l", "a b", "-"),
    "no name": lambda: put([1], "l", "", "-"),
    "DROP": lambda: mrstream.Frame("x").put("", "DROP", ""),
    "END": lambda: mrstream.Frame("x").put("", "END", ""),
    **{f"frame {name!r}": lambda name=name: mrstream.write(io.BytesIO(), [mrstream.Frame(name)])
       for name in ("", ".", "..", "a/b", "a\n", "\x80", "\udc80", "ä" * 128)},
}.items():
    raises(mrstream.StreamError, act, what)

# What breaks a law of frames is found before anything is written.
(torn,) = mrstream.read(io.BytesIO(key(p, q)))
torn["l"]["q"] = [1, 2]
wide = mrstream.Frame("wide")
for number in range(4096):
    wide.put("", str(number), "")
for frame in torn, wide, mrstream.Frame("."):
    out = io.BytesIO()
    raises(mrstream.StreamError, lambda: mrstream.Writer(out).put(frame), frame.name)
    check(out.getvalue() == b"", f"{frame.name}: something is written")

# What is done to a frame does not reach the next.
for frame in mrstream.read("walk.mrs"):
    check("base" in frame and np.ptp(frame["mesh"]["region"]) > 0, "a frame lacks what was changed in the one before")
    frame["mesh"]["region"] = np.zeros(len(frame["mesh"]["region"]))
    del frame["base"]

# Deltas: what is written is what was meant, for columns put, put again, dropped and moved; the tools read the same.
triangle = mrstream.Frame("triangle")
triangle.put("mesh", "position", [[0, 0, 0.0], [1, 0, 0], [0, 1, 0]], "v")
triangle.put("mesh", "triangles", [[0, 1, 2]], "f")
mrstream.write("triangle.mrs", [triangle], history=None)
with open(os.path.join(os.environ["TOP"], "man/mr-stream.5")) as f:
    dump = f.read().partition("begin triangle.hex\n.Bd -literal\n")[2].partition(".Ed")[0].replace("\\-", "-")
check(run("od -A x -t x1z triangle.mrs").decode() == dump, "the page's triangle is written otherwise")
buffer, meant = np.array([[0, 0, 0.0], [1, 0, 0], [0, 1, 0]]), []
out = io.BytesIO()
writer = mrstream.Writer(out, history="by hand")


def send(most):
    before = len(out.getvalue())
    writer.put(triangle)
    triangle.key = False
    columns = {place: stored_bytes(c.values) for place, c in triangle.columns.items()}
    meant.append({**columns, ("", "history"): b"by hand\n"})
    records = (len(out.getvalue()) - before) // 64
    check(records == most, f"frame {len(meant)}: {records} pieces of 64 bytes, not {most}")


send(11)  # START 1, FRAME 2, position 3, triangles 2, history 2, ENDFRAME 1
triangle["mesh"]["position"] = buffer
send(3)
buffer *= 2
triangle["mesh"]["position"] = buffer
send(3 + 3)
triangle.put("base", "position", buffer, "v")
send(3 + 1 + 3 + 2)  # it comes in front of the history, which so is dropped and sent again
del triangle["mesh"]["triangles"]
triangle.put("mesh", "triangles", [[0, 1, 2]], "f")
send(3 + 2 + 1 + 2 + 2)  # the same of triangles and history
del triangle["mesh"]
send(3 + 1)
send(3)
writer.end()
frames = all_of(io.BytesIO(out.getvalue()))
check([{place: c[4] for place, c in columns.items()} for _, _, columns in frames] == meant, "deltas of frames put")
check([frame[::2] for frame in frames] == paged(run(accepts, out.getvalue())), "the tools read other deltas")
check([key for _, key, _ in frames] == [True] + 6 * [False], "keys and deltas")

# A file gets its name with END, also the one that is read; an exception leaves what was there, and no END in a pipe.
before = data("a.mrs")
mrstream.write("a.mrs", mrstream.read("a.mrs"), history=None)
check(data("a.mrs") == before, "a file is written over itself otherwise")


def breaks():
    yield from mrstream.read("a.mrs")
    raise KeyError("on purpose")


raises(KeyError, lambda: mrstream.write("a.mrs", breaks()), "an exception of the frames")
check(data("a.mrs") == before and not [name for name in os.listdir() if name.endswith("~")], "half a file is left")
out = io.BytesIO()
raises(KeyError, lambda: mrstream.write(out, breaks()), "an exception of the frames")
raises(mrstream.CutOff, lambda: all_of(io.BytesIO(out.getvalue())), "END behind an exception")
with open("unended.mrs", "wb") as f:
    mrstream.Writer(f).put(triangle)
    raises(mrstream.CutOff, lambda: all_of("unended.mrs"), "no END")
    check(os.path.getsize("unended.mrs") % 64 == 0 < os.path.getsize("unended.mrs"), "a frame waits in a buffer")
raises(OSError, lambda: mrstream.write("/dev/full", mrstream.read("a.mrs")), "a full disk")
raises(FileNotFoundError, lambda: mrstream.write("no/such/place.mrs", mrstream.read("a.mrs")), "no folder")
raises(FileNotFoundError, lambda: all_of("none-such.mrs"), "no file")


class Narrow(io.RawIOBase):
    taken = b""

    def write(self, piece):
        self.taken += bytes(piece[:10000])
        return min(len(piece), 10000)


narrow = Narrow()
mrstream.write(narrow, mrstream.read("small.mrs"), history=None)
mrstream.write(narrow, mrstream.read("walk.mrs"), history=None)
check(narrow.taken == data("small.mrs") + data("walk.mrs"), "a file that takes a part of what it is given")

# A file that is replaced stays as private as it was.
os.chmod("walk.mrs", 0o600)
mrstream.write("walk.mrs", mrstream.read("walk.mrs"))
check(os.stat("walk.mrs").st_mode & 0o777 == 0o600, "a private file is readable for all")

sys.exit(failed)
