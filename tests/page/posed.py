"""posed.py -- handles that are dragged in the page: where it has vertices, and whether its line of commands has them
there, too."""
import json
import math
import subprocess

from checks import box, check, columns, length, sub

NEAR = 1e-5  # of the diagonal


SHORT = {"-H": "--handle", "-t": "--translate", "-r": "--rotate", "-s": "--scale"}


def pose_by(b, text):
    """Poses handles as a line of commands does, each by one command."""
    poses = []
    for command in text.split(" | "):
        words = command.split()
        options = {SHORT.get(k, k)[2:]: [float(x) for x in v.split(",")] for k, v in zip(words[1::2], words[2::2])}
        if words[0] == "mr-pose":
            scale = options.get("scale", [1])
            poses.append({"handle": int(options["handle"][0]), "translate": options.get("translate", [0, 0, 0]),
                          "rotate": options.get("rotate", [0, 0, 1, 0]), "scale": scale * 3 if len(scale) == 1
                              else scale})
    b.eval("mrView.posing.act(() => mrView.posing.pose.set(%s))" % json.dumps(poses))
    b.settle()


def places(b, layer):
    """Where the page has the vertices of a layer."""
    flat = b.eval("Array.from(mrView.posing.placesOf('%s') || [], (x, i) => x + mrView.centre[i %% 3])" % layer)
    return [flat[i:i + 3] for i in range(0, len(flat), 3)]


def same_layers(b, stream, line, what, layers):
    """Whether layers of the page are what the line makes of the stream."""
    b.settle()
    with open(stream, "rb") as file:
        made = subprocess.run(["sh", "-c", line], stdin=file, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            check=False)
    check(made.returncode == 0, "%s: exit %d of %s" % (what, made.returncode, line))
    with open("made.mrs", "wb") as file:
        file.write(made.stdout)
    want = columns("made.mrs")
    for layer in layers:
        p, q = want[layer, "position"], places(b, layer)
        low, high = box(p)
        off = max(length(sub(x, y)) for x, y in zip(p, q)) / length(sub(high, low)) if len(p) == len(q) else math.inf
        check(off < NEAR, "%s: %s is %g of the diagonal off, %d vertices of %d" % (what, layer, off, len(q), len(p)))


def line(b):
    return b.eval("document.getElementById('line').textContent")
