"""posing.py -- the picture that moves in README.md: usage: posing.py PAGE OUT.webp

The two arms of an armadillo turned by their handles, as by hand; frames of WebP from Chromium, put into one file.
"""
import base64
import math
import struct
import sys

from browser import Browser

STEPS, STEP, REST = 12, 80, 900  # pictures of a turn, and milliseconds that one is shown, the last of a turn longer
CURSOR = """(() => {
    const e = document.createElement("div");
    e.id = "cursor";
    e.style = "position:fixed;z-index:9;pointer-events:none";
    e.innerHTML = "<svg width=22 height=28 viewBox='0 0 11 14'><path d='M0 0v11.5l3-2.7 1.9 4.5 2-.9-1.9-4.3h4z' \
fill='#111' stroke='#fff' stroke-width='.8'/></svg>";
    document.body.append(e);
})()"""
# The gizmo's middle and the radius of its outer ring, in the window.
RING = """(() => {
    const s = mrView.stage, g = s.gizmo, at = g.at.position.clone(), b = s.place();
    const up = at.clone().add(s.camera.up.clone().applyQuaternion(s.camera.quaternion)
        .setLength(1.25 * 0.6 / 7 * at.distanceTo(s.camera.position)));
    const [p, q] = [at, up].map(v => v.project(s.camera));
    return [b.left + (p.x + 1) / 2 * b.width, b.top + (1 - p.y) / 2 * b.height, (q.y - p.y) / 2 * b.height];
})()"""


def chunk(kind, data):
    return kind + struct.pack("<I", len(data)) + data + bytes(len(data) % 2)


def animation(frames, width, height):
    """The bytes of a WebP of (WebP of one picture, milliseconds), shown again and again."""
    def size(n):
        return struct.pack("<I", n - 1)[:3]
    body = chunk(b"VP8X", struct.pack("<I", 2) + size(width) + size(height)) + chunk(b"ANIM", bytes(4) + bytes(2))
    for data, milliseconds in frames:
        at, image = 12, b""
        while at < len(data):
            n = struct.unpack_from("<I", data, at + 4)[0]
            image += data[at:at + 8 + n + n % 2] if data[at:at + 4] in (b"VP8 ", b"VP8L", b"ALPH") else b""
            at += 8 + n + n % 2
        head = bytes(6) + size(width) + size(height) + struct.pack("<I", milliseconds)[:3] + b"\2"
        body += chunk(b"ANMF", head + image)
    return b"RIFF" + struct.pack("<I", len(body) + 4) + b"WEBP" + body


def main(page, out):
    frames = []
    with Browser(960, 600, scale=1) as b:
        b.open(page)
        left, top, width, height = (int(x) for x in b.canvas())

        def take(x, y, milliseconds):
            b.eval("Object.assign(document.getElementById('cursor').style, {left: '%gpx', top: '%gpx'})" % (x, y))
            b.settle()
            data = b.call("Page.captureScreenshot", format="webp", quality=60,
                clip={"x": left, "y": top, "width": width, "height": height, "scale": 1})["data"]
            frames.append((base64.b64decode(data), milliseconds))

        def turn(handle, start, by):
            if b.eval("mrView.posing.handle") != handle:
                b.eval("document.querySelectorAll('#handles button')[%d].click()" % (handle - 1))
                b.settle()
            x, y, radius = b.eval(RING)
            for i in range(STEPS + 1):
                angle = math.radians(start + by * (1 - math.cos(math.pi * i / STEPS)) / 2)
                at = x + radius * math.cos(angle), y - radius * math.sin(angle)
                if i == 0:
                    b.mouse("mouseMoved", *at)
                    b.mouse("mousePressed", *at)
                b.mouse("mouseMoved", *at, buttons=1)
                take(*at, REST if i in (0, STEPS) else STEP)
            b.mouse("mouseReleased", *at)

        b.eval(CURSOR)
        b.choose("view", "0,0,1")
        turn(1, 150, -55)
        turn(2, 20, 50)
        if b.said:
            sys.exit(str(b.said))
    with open(out, "wb") as file:
        file.write(animation(frames, width, height))


main(*sys.argv[1:])
