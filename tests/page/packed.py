"""packed.py -- see packed.sh, which made the pages."""
import base64
import os
import re

from browser import Browser
from checks import box, check, columns, end, length, sub


def values(b, layer, name, frame=0):
    """A column of a layer as the page has it, as rows."""
    flat, n = b.eval("""(async () => {
        const column = mrView.frames[%d].columns.get("%s\\0%s");
        return column ? [Array.from(await column.values()), column.components] : [[], 1];
    })()""" % (frame, layer, name))
    return [tuple(flat[n * i:n * i + n]) for i in range(len(flat) // n)]


def stored(name):
    """Columns of the first frame in the page's stream."""
    with open(name + ".html", encoding="utf-8") as file:
        blocks = re.findall('<script type="text/plain" class="stream">([A-Za-z0-9+/=]*)</script>\n', file.read())
    with open("page.mrs", "wb") as file:
        file.write(b"".join(base64.b64decode(block) for block in blocks))
    return columns("page.mrs")


def as_unpacked(b, name):
    """The page's bytes, and the values of its columns, in whatever order."""
    page, want = stored(name), columns(name + ".un.mrs")
    with open(name + ".mrz", "rb") as file:
        packed = file.read()
    check(bytes(x for (x,) in page["displacement", "packed"]) == packed, name + ": other bytes than mr-pack's")
    check(("displacement", "height") not in page and ("control", "position") not in page, name + ": stored twice")
    for column in ("control", "position"), ("displacement", "height"), ("displacement", "color"):
        if column in want or column[1] != "color":
            check(sorted(values(b, *column)) == sorted(want[column]), "%s: %s.%s is not mr-unpack's" % (name, *column))


def as_decoded(b, name, mean):
    """The stream's triangles, and near its vertices; what was not packed is as it was."""
    was, want, got = columns(name + ".mrs"), columns(name + ".dec.mrs"), values(b, "mesh", "position")
    low, high = box(want["mesh", "position"])
    off = [length(sub(p, q)) / length(sub(high, low)) for p, q in zip(want["mesh", "position"], got)]
    check(len(got) == len(want["mesh", "position"]) and sum(off) < mean * len(off),
        "%s: its vertices are %g of the diagonal off" % (name, sum(off) / max(len(off), 1)))
    check(values(b, "mesh", "triangles") == want["mesh", "triangles"], name + ": other triangles")
    check(values(b, "control", "triangles") == was["control", "triangles"], name + ": other control triangles")
    if ("control", "region") in was:
        check(values(b, "control", "region") == was["control", "region"], name + ": other regions")
    if ("displacement", "color") in was:
        wrong = max(abs(x - y) for p, q in zip(was["displacement", "color"], values(b, "mesh", "color"))
            for x, y in zip(p, q))
        check(wrong < 100, "%s: colours are %d off" % (name, wrong))


def levels(b, name):
    """A coarser level is another picture, the finest again the first."""
    b.open(name + ".html")
    first = b.picture()
    check(b.text("level-is") == "3 of 3", "%s: on level %s" % (name, b.text("level-is")))
    b.press("PageDown")
    check(b.picture() != first, "a coarser level looks the same")
    b.press("PageUp")
    check(b.picture() == first, "the finest level again looks otherwise")


def scan(b):
    b.open("scan.html")
    marks = b.eval("Object.fromEntries(performance.getEntriesByType('mark').map(m => [m.name, m.startTime]))")
    size, heights = os.path.getsize("scan.html") - os.path.getsize("none.html"), len(values(b, "mesh", "position"))
    print("a page of %d vertices: %d bytes beside its program, coarse after %.2f s, complete after %.2f s"
        % (heights, size, marks["coarse"] / 1000, marks["complete"] / 1000))
    check(heights > 25000 and size < 150000, "%d bytes for %d heights" % (size, heights))
    visible = b.eval("[...mrView.choice.visible]")
    check(visible == ["mesh"], "it opens with %s" % visible)
    check(marks["coarse"] < marks["complete"], "it is not drawn coarse first")


with Browser() as browser:
    scan(browser)
    for surface, share in ("closed", 2e-3), ("open", 2e-3), ("creased", 2e-3), ("colored", 2e-3):
        browser.open(surface + ".html")
        as_unpacked(browser, surface)
        as_decoded(browser, surface, share)
    levels(browser, "closed")
    browser.open("film.html")
    for i in range(3):
        check(len(values(browser, "mesh", "position", i)) == len(columns("closed.dec.mrs")["mesh", "position"]),
            "film: frame %d has no surface" % i)
    rest, posed = (values(browser, "mesh", "position", i) for i in (0, 2))
    check(max(length(sub(p, q)) for p, q in zip(rest, posed)) > 0.05, "film: it stands still")
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
