"""GLB files with pictures, made from nothing: a square of two triangles, or whatever is given."""
import json
import struct
import zlib


def png(width, height, pixel):
    """A PNG whose pixel at x, y is pixel(x, y): red, green, blue; not packed, so that any zlib gives the same bytes."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b""))


def write(path, root, data):
    """The document and its bytes as a GLB."""
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    with open(path, "wb") as f:
        f.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        f.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)


def read(path):
    """The document of a GLB, and its bytes."""
    data = open(path, "rb").read()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def square(pictures):
    """A document of a square with a material of the first picture, and its bytes."""
    data = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0) + struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0)
    data += struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    root = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"name": "painted", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
        "textures": [{"source": i} for i in range(len(pictures))],
        "images": [{"bufferView": 3 + i, "mimeType": "image/png"} for i in range(len(pictures))],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}]}
    for picture in pictures:
        root["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(picture)})
        data += picture + bytes(-len(picture) % 4)
    root["buffers"] = [{"byteLength": len(data)}]
    return root, data


def pictures(path):
    """The bytes of the pictures in a GLB, in their order."""
    root, data = read(path)
    views = [root["bufferViews"][image["bufferView"]] for image in root.get("images", [])]
    return [data[v.get("byteOffset", 0):][:v["byteLength"]] for v in views]
