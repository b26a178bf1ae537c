"""records -- streams (man 5 mr-stream) for the tests, read and written record by record, also such as break a law.

A record is (layer, name, shape, rows, data); its shape is element, type, components and codec, b"vd\\3\\0".  Layers
and names are bytes.  examples/mrstream.py is the reader for everyone else: it checks, and needs numpy.
"""
import struct
import zlib

TEXT = b"-t\1\0"
NUMBERS = {"d": "d", "u": "I", "b": "B"}


def record(layer, name, shape=TEXT, rows=None, data=b""):
    """A record's bytes; of text its rows are its bytes."""
    rows = len(data) if rows is None else rows
    head = struct.pack("<16s24s4sIQQ", layer, name, shape.ljust(4, b"\0"), 0, rows, len(data))
    checksum = zlib.crc32(data, zlib.crc32(head))
    return head[:44] + struct.pack("<I", checksum) + head[48:] + data + bytes(-len(data) % 64)


def read(stream):
    """Each record of a stream's bytes: where it begins, and the record."""
    at = 0
    while at < len(stream):
        layer, name, shape, _, rows, stored = struct.unpack_from("<16s24s4sIQQ", stream, at)
        yield at, (layer.rstrip(b"\0"), name.rstrip(b"\0"), shape, rows, bytes(stream[at + 64:at + 64 + stored]))
        at += 64 + (stored + 63) // 64 * 64


def stream(*frames):
    """A stream of frames, each (name, record, ...)."""
    out = record(b"mrmesh1\n", b"START")
    for name, *columns in frames:
        out += record(b"", b"FRAME", data=b"key " + name) + b"".join(columns) + record(b"", b"ENDFRAME")
    return out + record(b"", b"END")


def values(shape, data):
    """Numbers of a record that is not packed, one after another."""
    return struct.unpack("<%d%s" % (len(data) // {"d": 8, "u": 4}.get(chr(shape[1]), 1), NUMBERS[chr(shape[1])]), data)


def column(path, layer, name):
    """The numbers of the first column of that name; None where there is none."""
    with open(path, "rb") as file:
        for _, (its_layer, its_name, shape, _, data) in read(file.read()):
            if (its_layer, its_name) == (layer, name):
                return values(shape, data)


def changed(stream, layer, name, change):
    """The stream with that column's data, a bytearray, as change leaves it."""
    for at, (its_layer, its_name, shape, rows, data) in read(stream):
        if (its_layer, its_name) == (layer, name):
            data = bytearray(data)
            change(data)
            other = record(layer, name, shape, rows, bytes(data))
            return stream[:at] + other + stream[at + len(other):]
    raise KeyError(name)
