"""painted.py -- what the tests of painting share: the regions that a page has, strokes, and what they should hold."""
import heapq
import json
import math
import subprocess

from checks import box, columns, cross, dot, length, sub

NAMES = {"fixed": 0, "free": 1}


def checksum(triangles):
    total = 2166136261
    for t in triangles:
        for v in t:
            total = (total ^ v) * 16777619 % 2 ** 32
    return "%08x" % total


def parse(text):
    """The first line, and the region of each vertex that a text of regions names."""
    head, *lines = text.splitlines()
    regions = {}
    for line in lines:
        words = line.split()
        region = NAMES[words.pop(0)] if words[0] in NAMES else 2 + int(words.pop(1)) + 0 * len(words.pop(0))
        for word in words:
            first, _, last = word.partition("-")
            for v in range(int(first), int(last or first) + 1):
                assert v not in regions, "%d is there twice" % v
                regions[v] = region
    return head, regions


def push(b, name):
    b.eval("document.getElementById(%s).click()" % json.dumps(name))
    b.settle()


def text_of(b):
    """The page's regions as text, as it saves them."""
    return b.eval("mrView.painter.takeAway.text()")


def regions_of(b):
    regions = parse(text_of(b))[1]
    return [regions[v] for v in range(len(regions))]


def give(b, regions):
    """Gives vertices regions, as one change: {vertex: region}."""
    b.eval("""(async () => {
        const { painter } = mrView, { work } = painter;
        work.painted = true;
        work.regions.begin();
        for (const [v, region] of %s)
            work.regions.set([v], region);
        await painter.done(work.regions.end());
    })()""" % json.dumps(list(regions.items())))
    b.settle()


def counts(b):
    """What the side says: {region: vertices}."""
    said = b.eval("[...document.querySelectorAll('#regions button')].map(e => [e.children[1].textContent, "
        "e.children[2].textContent])")
    return {name: int(n.replace(",", "")) for name, n in said if n}


def size(b, share):
    """Sets the brush to a share of the diagonal; returns the share that the page then has."""
    value = 100 * math.log(share / 0.002) / math.log(250)
    b.eval("(e => { e.value = %.9f; e.dispatchEvent(new Event('input')) })(document.getElementById('size'))" % value)
    return share


def read_back(stream, text):
    """The regions that mr-select --from makes of the stream by the text."""
    with open("text.regions", "w") as file:
        file.write(text)
    subprocess.run(["mr-select", "--from", "text.regions", stream, "-o", "back.mrs"], check=True)
    return [r[0] for key, rows in columns("back.mrs").items() if key[1] == "region" for r in rows]


def diagonal(positions):
    low, high = box(positions)
    return length(sub(high, low))


def met(o, d, p, t):
    """How far along o + s d the triangle is met, and how near to its edges, from 0; None where it is not."""
    a, b, c = (p[i] for i in t)
    u, v = sub(b, a), sub(c, a)
    n = cross(u, v)
    across = dot(n, d)
    if across == 0:
        return None
    s = dot(n, sub(a, o)) / across
    at = [x + s * y for x, y in zip(o, d)]
    inner = [dot(n, cross(sub(p[t[(k + 1) % 3]], p[t[k]]), sub(at, p[t[k]]))) / dot(n, n) for k in range(3)]
    return (s, min(inner)) if min(inner) > -1e-4 else None


class Picture3:
    """A surface as a camera sees it, by trying all faces whose box in the picture has the pixel."""

    def __init__(self, camera, p, t):
        self.camera, self.p, self.t = camera, p, t
        self.pixels = [camera.pixel(q) for q in p]
        self.boxes = []
        for i, f in enumerate(t):
            xs, ys = zip(*(self.pixels[v] for v in f))
            self.boxes.append((min(xs) - 0.01, max(xs) + 0.01, min(ys) - 0.01, max(ys) + 0.01, i))

    def near(self, x, y):
        return [i for x0, x1, y0, y1, i in self.boxes if x0 <= x <= x1 and y0 <= y <= y1]

    def hit(self, x, y):
        """Face and place that a pixel shows; None: nothing."""
        c, best = self.camera, None
        left, top, width, height = c.canvas
        right, up = ((x - left) / width * 2 - 1) * c.scale * c.aspect, (1 - (y - top) / height * 2) * c.scale
        d = [right * c.right[k] + up * c.up[k] - c.back[k] for k in range(3)]
        for i in self.near(x, y):
            found = met(c.eye, d, self.p, self.t[i])
            if found and found[1] >= 0 and (best is None or found[0] < best[0]):
                best = (found[0], i)
        return best and (best[1], [o + best[0] * k for o, k in zip(c.eye, d)])


def along_edges(p, t, face, place, reach):
    """Distances along edges from a place on a face, as far as reach: never less than over the surface."""
    beside = {}
    for f in t:
        for k in range(3):
            beside.setdefault(f[k], set()).update((f[k - 1], f[k - 2]))
    found, queue = {}, [(length(sub(p[v], place)), v) for v in t[face]]
    heapq.heapify(queue)
    while queue:
        d, v = heapq.heappop(queue)
        if v in found or d > reach:
            continue
        found[v] = d
        for u in beside[v]:
            heapq.heappush(queue, (d + length(sub(p[u], p[v])), u))
    return found
