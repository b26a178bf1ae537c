"""flaws.py -- see flaws.sh, which made the pages."""
import json

from browser import Browser
from checks import box, check, columns, cross, dot, end, sub


def red(p):
    return p[0] > 200 and p[1] < 70 and p[2] < 70


def violet(p):
    return p[2] > 200 and p[1] < 110 and 110 < p[0] < 190


def folded(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)["layers"]["mesh"]["folded_edges"]


def pierces(a, b, tri):
    """Whether the segment from a to b passes through the triangle; all in general position."""
    p, q, r = tri
    side = [dot(cross(sub(q, p), sub(r, p)), sub(e, p)) > 0 for e in (a, b)]
    turns = [dot(cross(sub(u, a), sub(v, a)), sub(b, a)) > 0 for u, v in ((p, q), (q, r), (r, p))]
    return side[0] != side[1] and len(set(turns)) == 1


def crossing(p, t):
    """Faces that intersect another: an edge of one passes through the other, of which it has no corner."""
    boxes = [box([p[v] for v in tri]) for tri in t]
    out = set()
    for i, a in enumerate(t):
        for j in range(i):
            b = t[j]
            if any(boxes[i][0][c] > boxes[j][1][c] or boxes[j][0][c] > boxes[i][1][c] for c in range(3)):
                continue
            if any(not {f[k], f[k - 1]} & set(g) and pierces(p[f[k]], p[f[k - 1]], [p[v] for v in g]) for f, g in ((a, b), (b, a)) for k in range(3)):
                out |= {i, j}
    return out


def said(b):
    return b.eval("[...document.querySelectorAll('#flaw-list li')].map(e => e.textContent)")


def marks(b):
    """As many as mr-info counts, by key and switch; the faces are those of the test here."""
    values = columns("noisy.mrs")
    faces = crossing(values["mesh", "position"], values["mesh", "triangles"])
    want = folded("noisy.json")
    check(want > 5 and len(faces) > 20, "a model without flaws: %d, %d" % (want, len(faces)))
    b.open("noisy.html")
    first = b.picture()
    check(said(b) == [], "at first the page says %s" % said(b))
    b.press("d")
    check(said(b) == ["%d folded edges" % want, "{:,} intersecting faces".format(len(faces))], "noisy: %s, not %d and %d" % (said(b), want, len(faces)))
    picture = b.picture()
    for color in (red, violet):
        check(first.share(b.canvas(), color) == 0 and picture.share(b.canvas(), color) > 0.0003, "noisy: %s is not to be seen" % color.__name__)
    got = b.eval("Array.from(mrView.drawn.get('mesh').drawn.solid.crossings())")
    corners = values["mesh", "triangles"]
    check({tuple(got[k:k + 3]) for k in range(0, len(got), 3)} == {tuple(corners[f]) for f in faces}, "noisy: other faces intersect")
    b.press("d")
    check(said(b) == [] and b.picture() == first, "the marks stay")
    b.press("d")
    b.press("1")
    check(said(b) == [], "of no layer: %s" % said(b))


def followed(b):
    """Of a level that the page makes, and of what it poses."""
    b.open("rough.html")
    b.press("d")
    check(said(b)[0] == "%d folded edges" % folded("rough.json") and "intersecting" in said(b)[1], "rough: %s, not %d" % (said(b), folded("rough.json")))
    b.press("PageDown")
    check("intersecting" in said(b)[1], "rough, level 0: %s" % said(b))
    b.open("edit.html")
    b.press("d")
    check(said(b) == ["0 folded edges", "0 intersecting faces"], "edit: %s" % said(b))
    b.eval("(e => { e.value = 'mr-pose -H 1 --rotate 0,0,1,170 | mr-decode'; e.dispatchEvent(new Event('change')) })(document.getElementById('line'))")
    b.settle()
    want = folded("posed.json")
    check(want > 0 and b.wait("document.querySelector('#flaw-list li').textContent === '%d folded edges'" % want, 20), "posed: %s, not %d" % (said(b), want))
    check(b.wait("/[1-9].*intersecting/.test(document.querySelectorAll('#flaw-list li')[1].textContent)", 20), "posed: %s" % said(b))


with Browser() as browser:
    for test in (marks, followed):
        browser.draw(test is marks)
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
