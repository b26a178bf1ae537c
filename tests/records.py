"""records -- streams (man 5 mr-stream) for the tests, read and written record by record, also such as break a law.

A record is (layer, name, shape, rows, data), its layer and name bytes, its shape element, type and components: b"vd\\3".
lib/python/mr/stream.py is the reader for everyone else: it checks, and needs numpy.
"""
import struct
import subprocess
import zlib

NUMBERS = {"d": "d", "u": "I", "b": "B"}


def record(layer, name, shape=b"-t\1", rows=None, data=b""):
    """A record's bytes; text has as many rows as bytes."""
    rows = len(data) if rows is None else rows
    head = struct.pack("<16s24s4sIQQ", layer, name, shape, 0, rows, len(data))
    checksum = zlib.crc32(data, zlib.crc32(head))
    return head[:44] + struct.pack("<I", checksum) + head[48:] + data + bytes(-len(data) % 64)


def read(stream):
    """The records of a stream's bytes; the layer of START is the magic of the format."""
    at = 0
    while at < len(stream):
        layer, name, shape, _, rows, stored = struct.unpack_from("<16s24s4sIQQ", stream, at)
        yield layer.rstrip(b"\0"), name.rstrip(b"\0"), shape, rows, bytes(stream[at + 64:at + 64 + stored])
        at += 64 + (stored + 63) // 64 * 64


START, END = record(b"mrmesh1\n", b"START"), record(b"", b"END")


def frame(text, *columns):
    """A frame's bytes: its text, `key NAME` or `delta NAME`, and its records."""
    return record(b"", b"FRAME", data=text) + b"".join(columns) + record(b"", b"ENDFRAME")


def numbers(shape, data):
    """The numbers of a record, one after another; text as it is."""
    kind = chr(shape[1])
    return data if kind == "t" else struct.unpack("<%d%s" % (len(data) // {"d": 8, "u": 4, "b": 1}[kind], NUMBERS[kind]), data)


def column(path, layer, name):
    """The numbers of the last column of that name in a file that is not packed."""
    with open(path, "rb") as file:
        return [numbers(shape, data) for *place, shape, _, data in read(file.read()) if place == [layer, name]][-1]


def first_frame(path):
    """The columns of a stream's first frame, {(layer, name): rows as tuples}; those of text are bytes."""
    out = {}
    stream = subprocess.run(["mr-cat", "-u", "--no-history", path], stdout=subprocess.PIPE, check=True).stdout
    for layer, name, shape, rows, data in read(stream):
        if name == b"ENDFRAME":
            break
        flat, n = numbers(shape, data), shape[2]
        out[layer.decode(), name.decode()] = flat if shape[1:2] == b"t" else [flat[n * i:n * i + n] for i in range(rows)]
    return out


def changed(stream, change):
    """The stream of what change(layer, name, shape, rows, data) gives for each record: a record's parts, or None for none."""
    others = (change(*parts) for parts in read(stream))
    return b"".join(record(*parts) for parts in others if parts)
