"""texture.py -- see texture.sh; usage: texture.py [pictures], which makes the pictures."""
import base64
import json
import math
import os
import re
import struct
import subprocess
import sys
import zlib

from browser import Browser, Picture
from checks import box, check, columns, end, length, sub
from painted import push
from posed import places, pose_by

GROUND, PLAIN = (244, 243, 240), (212, 204, 193)


def png(path, width, height, color, n):
    """n bytes a pixel: color(x, y)."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(v for x in range(width) for v in color(x, y)) for y in range(height))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[n], 0,
            0, 0))
                   + chunk(b"tEXt", b"Comment\0taken at home") + chunk(b"IDAT", zlib.compress(rows))
                       + chunk(b"IEND", b""))


def pictures():
    """No two of twelve patches alike, so that a picture that is turned, mirrored or shifted looks otherwise; sizes are
    no powers of two."""
    tints = [(230, 60, 60), (60, 200, 60), (70, 90, 230), (230, 210, 60), (210, 70, 210), (60, 210, 210),
             (20, 110, 100), (240, 140, 40), (120, 70, 200), (100, 100, 100), (150, 230, 110), (250, 170, 190)]
    png("checks.png", 120, 90, lambda x, y: tints[y // 30 * 4 + x // 30], 3)
    png("clear.png", 10, 10, lambda x, y: (200, 0, 0, 255 if x < 5 else 0), 4)
    with open("card.mtl", "w", encoding="ascii") as file:
        file.write("newmtl picture\nKd 0 0 0\nmap_Kd checks.png\nnewmtl colour\nKd 0.1 0.2 0.9\nnewmtl neither\n")


def pixels_of(path):
    """Rows of its pixels."""
    with open(path, "rb") as file:
        picture = Picture(file.read(), 1)
    n = picture.n
    return [[tuple(row[n * x:n * x + 3]) for x in range(picture.width)] for row in picture.rows]


def bare(p):
    """A colour without how bright it is."""
    return tuple(255 * v // max(*p, 1) for v in p)


def is_far(a, b, much=48):
    return max(abs(x - y) for x, y in zip(a, b)) > much


def as_rendered(b, model):
    """With the camera of mr-render: how bright is another matter, where which colour is the same."""
    points = columns(model + ".mrs")["mesh", "position"]
    low, high = box(points)
    middle, far = [(x + y) / 2 for x, y in zip(low, high)], 2 * length(sub(high, low))
    for view, toward in (("front", (0, 0, 1)), ("back", (0, 0, -1)), ("left", (-1, 0, 0))):
        pixels = pixels_of("%s-%s.png" % (model, view))
        width, height, paper = len(pixels[0]), len(pixels), pixels[0][0]
        right = [toward[2], 0, -toward[0]]
        seen = [[sum(r * x for r, x in zip(axis, sub(p, middle))) for axis in (right, (0, 1, 0), toward)]
            for p in points]
        ends = [[end(p[c] / (far - p[2]) for p in seen) for end in (min, max)] for c in (0, 1)]
        drawn = [[i for i, line in enumerate(lines) if any(is_far(p, paper, 24) for p in line[::4])]
            for lines in (list(zip(*pixels)), pixels)]
        sizes = [(d[-1] - d[0] + 1, high - low) for d, (low, high) in zip(drawn, ends)]
        scale = max(sizes)[0] / max(sizes)[1]  # pixels of a unit at distance 1
        aside = [round(s * scale * (low + high) / 2) for s, (low, high) in zip((1, -1),
            ends)]  # its middle is that of what is drawn
        check(all(abs(n - size * scale) < 3 for n, size in sizes),
            "%s: %s of mr-render has another camera than is thought here" % (model, view))
        b.choose("view", ",".join(map(str, toward)))
        b.eval("(({ camera, controls }, at, far, angle) => { "
            "camera.position.copy(controls.target).addScaledVector(camera.position.clone().set(...at), far); "
            "camera.fov = angle; mrView.stage.ask() })(mrView.stage, %s, %r, %r)"
               % (json.dumps(toward), far, 2 * math.degrees(math.atan(height / 2 / scale))))
        b.settle()
        picture, (left, top, w, h) = b.picture(), b.canvas()
        check((w, h) == (width, height), "the stage is %g x %g" % (w, h))
        inside = others = edge = 0
        for y in range(20, height - 20, 4):
            for x in range(20, width - 20, 4):
                mine, its = picture.pixel(left + x + aside[0], top + y + aside[1]), pixels[y][x]
                if is_far(mine, GROUND, 12) != is_far(its, paper, 12):
                    edge += 1
                elif is_far(mine, GROUND, 12):
                    inside += 1
                    others += is_far(bare(mine), bare(its))
        print("%s from the %s: of %d pixels %d have another colour, %d more are drawn in one picture only"
            % (model, view, inside, others, edge))
        check(inside > 4000 and others < 0.02 * inside and edge < 0.01 * inside,
            "%s: the picture lies otherwise than in mr-render's from the %s" % (model, view))
        seen_colors = {bare(picture.pixel(left + x, top + y)) for y in range(0, height, 9) for x in range(0, width, 9)}
        check(len(seen_colors) > 20, "%s: no picture is drawn" % model)


def balls(b):
    with open("both.html", encoding="utf-8") as file:
        stored = re.findall('class="picture">([^<]*)<', file.read())
    check(len(stored) == 1, "a picture of two models is there %d times" % len(stored))
    check(b"taken" not in base64.b64decode(stored[0]), "what is said in the picture is in the page")
    b.open("sphere.html")
    options = b.eval("[...document.getElementById('color').options].map(o => o.text)")
    check(options == ["plain", "texture"] and b.eval("document.getElementById('color').selectedOptions[0].text")
        == "texture", "colours: %s" % options)
    worn = b.picture()
    b.choose("color", "")
    check(b.picture() != worn, "plain is not another colour")
    b.press("c")
    check(b.picture() == worn, "the texture again looks otherwise")
    b.press("s")
    check(b.picture() != worn, "flat is not otherwise with a texture")
    b.press("s")
    b.press("e")
    check(b.picture() != worn, "no edges on a texture")
    b.press("e")
    check(b.picture() == worn, "smooth again, without edges, it looks otherwise")
    as_rendered(b, "sphere")
    b.open("cylinder.html")
    as_rendered(b, "cylinder")


def bright(b, points):
    """The pixels at places of the card, which is 3 by 1 and in all of the picture's width."""
    b.choose("view", "0,0,1")
    left, top, width, height = b.canvas()
    unit = height / 2 * math.sin(math.radians(15)) / (math.sqrt(10) / 2) / math.tan(math.radians(15))
    picture = b.picture()
    return [picture.pixel(left + width / 2 + unit * (x - 1.5), top + height / 2 - unit * (y - 0.5)) for x, y in points]


def card(b):
    """A picture that repeats, twice over the first square; a material's colour; one that has neither."""
    b.open("card.html")
    got = bright(b, [(0.06, 0.84), (0.2, 0.84), (0.56, 0.84), (0.7, 0.84), (0.06, 0.5), (0.06, 0.17), (1.5, 0.5),
        (2.5, 0.5)])
    want = [(230, 60, 60), (60, 200, 60), (230, 60, 60), (60, 200, 60), (210, 70, 210), (120, 70, 200), (26, 51, 230),
        PLAIN]
    for i, (p, q) in enumerate(zip(got, want)):
        pair = bare(p), bare(q)
        check(not is_far(*pair, 40), "the card: place %d is %s, not %s" % (i, p, q))
    names = b.eval("[...document.getElementById('color').options].map(o => o.text)")
    check("texture" in names and "material" in names, "the card: colours %s" % names)
    b.choose("color", "material")
    check(b.eval("[...document.querySelectorAll('#kinds li')].map(e => e.textContent)")
        == ["picture", "colour", "neither"], "the card: kinds")
    b.open("clear.html")
    got = bright(b, [(0.125, 0.5), (0.375, 0.5)])
    check(not is_far(bare(got[0]), (255, 0, 0), 40) and not is_far(bare(got[1]), (255, 255, 255), 40),
        "what is transparent is not white: %s" % got)


def pose(b):
    """What is posed wears what the pose of the pipe does."""
    def stage():
        left, top, width, height = (int(v) for v in b.canvas())
        picture = b.picture()
        return [picture.pixel(x, y) for y in range(top, top + height - 140, 2) for x in range(left, left + width, 2)]

    line = "mr-pose -H 1 --translate 0.2,0.4,0 | mr-decode"
    b.open("posed.html")
    want = stage()
    camera = b.eval(
        "[mrView.stage.camera.position.toArray().map((x, c) => x + mrView.centre[c]), "
        "mrView.stage.controls.target.toArray().map((x, c) => x + mrView.centre[c])]")
    b.open("pose.html")
    b.press("Escape")
    rest = stage()
    pose_by(b, line)
    b.eval("((eye, at) => { const { camera, controls } = mrView.stage, c = mrView.centre; "
        "camera.position.set(...eye.map((x, i) => x - c[i])); controls.target.set(...at.map((x, i) => x - c[i])); "
        "controls.update() })(...%s)" % json.dumps(camera))
    b.settle()
    got = stage()
    differ = sum(is_far(p, q, 24) for p, q in zip(got, want)) / len(want)
    check(differ < 0.002, "the pose: %.4f of the picture differ from the pipe's" % differ)
    check(sum(is_far(p, q, 24) for p, q in zip(got, rest)) > 0.02 * len(want), "the pose looks like the rest")
    saves(b)


def saves(b):
    """As a GLB what is seen: places, faces and the picture, or the colours; and a picture.  On the page as it was
    left."""
    values, name = import_glb(b), b.text("name")
    corners = [p for t in values["mesh", "triangles"] for p in (values["mesh", "position"][v] for v in t)]
    seen = places(b, "mesh")
    want = [seen[v] for v in b.eval("Array.from(mrView.drawn.get('mesh').drawn.triangles)")]
    off = max(length(sub(p, q)) for p, q in zip(corners, want))
    check(len(corners) == len(want) and off < 1e-5, "the GLB: %d corners, %g off" % (len(corners), off))
    check(("mesh", "corner_texcoord") in values and any(key[1].endswith(".png") or key[1] == "file" for key in values),
        "the GLB has no picture: %s" % sorted(values))
    b.choose("color", "detail_height")
    values = import_glb(b)
    check(len(set(map(tuple, values["mesh", "color"]))) > 20, "the GLB has no colours")
    push(b, "save-picture")
    check(wait_for(b, name + ".png"), "no picture is saved: %s" % os.listdir("saved"))


def wait_for(b, name):
    for _ in range(100):
        if os.path.exists(os.path.join("saved", name)):
            return True
        b.settle()
    return False


def import_glb(b):
    name = b.text("name") + ".glb"
    if os.path.exists("saved/" + name):
        os.remove("saved/" + name)
    push(b, "save-glb")
    check(wait_for(b, name), "no GLB is saved, but %s" % os.listdir("saved"))
    subprocess.run(["mr-import", "-q", "saved/" + name, "-o", "saved.mrs"], check=True)
    return columns("saved.mrs")


if sys.argv[1:] == ["pictures"]:
    pictures()
    sys.exit()
os.makedirs("saved", exist_ok=True)
with Browser(scale=1) as browser:
    browser.call("Page.setDownloadBehavior", behavior="allow", downloadPath=os.path.abspath("saved"))
    for test in (balls, card, pose):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
