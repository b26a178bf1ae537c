"""beside.py -- see beside.sh, which made the pages."""
import json

from browser import Browser
from checks import box, check, columns, end, length, sub

GROUND = (244, 243, 240)


def panels(b):
    """The places of the panels in the window, below their names: left, top, width, height."""
    return b.eval("(({ panels }, r) => mrView.stage.panels().map(p => [r.left + p.x, r.top + p.y + 40, p.width, p.height - 40]))(mrView.stage, document.getElementById('canvas').getBoundingClientRect())")


def names(b):
    return b.eval("[...document.querySelectorAll('#labels span')].map(e => e.textContent)")


def parts(b):
    """Of each panel its pixels, every fourth one, as far as all have them."""
    picture, places = b.picture(), panels(b)
    width, height = (int(min(p[k] for p in places)) - 4 for k in (2, 3))
    return [[picture.pixel(x0 + x, y0 + y) for y in range(0, height, 4) for x in range(0, width, 4)] for x0, y0, _, _ in places]


def places(b):
    """What is drawn of mesh in either panel: places of vertices."""
    return b.eval("[mrView.held.drawn, mrView.drawn].map(d => Array.from(d.get('mesh').drawn.geometry.attributes.position.array))")


def differ(a, b):
    """How many pixels, as a share of those that are drawn in either."""
    def far(p, q):
        return max(abs(x - y) for x, y in zip(p, q)) > 24

    drawn = sum(far(p, GROUND) or far(q, GROUND) for p, q in zip(a, b))
    return sum(far(p, q) for p, q in zip(a, b)) / max(drawn, 1)


def film(b):
    b.open("film.html")
    alone = b.picture()
    b.press("h")
    check(names(b) == ["kept: bumpy \u00b7 1 / 4", "bumpy \u00b7 1 / 4"], "names: %s" % names(b))
    kept, now = parts(b)
    check(differ(kept, now) < 0.03, "the same frame looks otherwise beside itself: %.3f" % differ(kept, now))
    b.press("ArrowLeft")
    check(names(b) == ["kept: bumpy \u00b7 1 / 4", "bumpy-0003 \u00b7 4 / 4"], "names: %s" % names(b))
    still, last = parts(b)
    check(still == kept, "what is kept does not stay")
    check(differ(still, last) > 0.1, "what goes on stays: %.3f" % differ(still, last))
    (x0, y0, w, h), (x1, y1, _, _) = panels(b)
    b.drag(x1 + w / 2, y1 + 20, x1 + w / 2 + 90, y1 + 60)
    turned = parts(b)
    check(differ(turned[0], kept) > 0.1, "the camera turns one of both")
    # The same place of both: each tells of its own frame.
    frames = b.eval("""(async () => Promise.all([0, 3].map(async i => Array.from(await mrView.frames[i].columns.get("mesh\\0position").values()))))()""")
    for (x, y), positions in zip(((x0, y0), (x1, y1)), frames):
        b.click(x + w / 2, y + (h - 40) / 2)
        card = b.picked()
        vertex, at = int(card["vertex"]), [float(v) for v in card["at"].split("  ")]
        check(length(sub(at, positions[3 * vertex:3 * vertex + 3])) < 1e-5, "the card of %s tells another frame's place" % card)
        marked = b.eval("[mrView.held.drawn, mrView.drawn].map(d => d.get('mesh').drawn.mark.visible)")
        check(marked == [x == x0, x != x0], "marks: %s" % marked)
    b.press("Escape")
    b.choose("color", "region")
    kept, now = parts(b)
    orange = [sum(p[0] > p[2] + 60 for p in part) for part in (kept, now)]
    check(min(orange) > 30, "colours: %s orange pixels" % orange)
    b.press("b")
    check(names(b) == ["kept: bumpy \u00b7 1 / 4", "bumpy-0003 \u00b7 4 / 4 \u00b7 mesh", "bumpy-0003 \u00b7 4 / 4 \u00b7 base"], "layers beside: %s" % names(b))
    b.press("b")
    b.press("2")
    b.choose("color", "")
    b.press("ArrowRight")
    b.press("h")
    b.choose("view", "0.5,0.35,1")
    check(names(b) == [] and b.picture() == alone, "nothing kept: another picture than at first; %s" % names(b))


def pose(b):
    """The rest is kept; the gizmo is in the other panel, and there it is dragged."""
    b.open("pose.html")
    b.press("h")
    b.eval("(e => { e.value = 'mr-pose -H 1 --translate 0.2,0.1,0'; e.dispatchEvent(new Event('change')) })(document.getElementById('line'))")
    b.settle()
    rest, posed = parts(b)
    check(differ(rest, posed) > 0.1, "the pose goes into both, or none: %.3f" % differ(rest, posed))
    b.press("1")
    held = parts(b)[0]
    check(held == rest, "the gizmo is drawn at what is kept")
    place = b.eval("(({ stage }) => (p => { const v = stage.gizmo.at.position.clone().project(stage.camera); return [p.left + (v.x + 1) / 2 * p.width, p.top + (1 - v.y) / 2 * p.height] })(stage.place()))(mrView)")
    before = json.dumps(b.eval("document.getElementById('line').value"))
    up = b.eval("mrView.stage.place().height")
    b.mouse("mouseMoved", place[0], place[1] - up / 12)
    b.drag(place[0], place[1] - up / 12, place[0], place[1] - up / 12 - 40)
    after = json.dumps(b.eval("document.getElementById('line').value"))
    check(before != after and "--translate 0.2," in after, "dragged up: %s became %s" % (before, after))
    check(parts(b)[0] == rest, "a drag moves what is kept")
    # What is posed is kept in its pose.
    b.press("Escape")
    b.press("h")
    b.press("h")
    check(names(b) == ["kept: bumpy \u00b7 posed", "bumpy"], "names: %s" % names(b))
    kept, now = parts(b)
    check(differ(kept, now) < 0.03, "the pose is not kept: %.3f" % differ(kept, now))
    posed = places(b)  # the pictures change their size, as the line of commands does
    b.eval("document.getElementById('reset').click()")
    b.settle()
    check(places(b)[0] == posed[0], "reset moves what is kept")
    check(places(b)[1] != posed[1], "reset leaves the pose")
    # So are its regions, while others are painted.
    b.choose("color", "region")
    kept = parts(b)[0]
    b.press("k")
    b.press("0")
    _, (x, y, w, h) = panels(b)
    b.click(x + w / 2, y + (h - 40) / 2)
    after = parts(b)
    check(after[0] == kept and differ(*after) > 0.3, "painted: what is kept changes, or the other does not: %.3f" % differ(*after))
    (x, y, w, h), _ = panels(b)
    before = b.eval("document.getElementById('paint-undo').disabled")
    b.press("9")
    b.click(x + w / 2, y + (h - 40) / 2)
    check(parts(b) == after and not before, "a click at what is kept paints")


def levels(b):
    b.open("levels.html")
    b.press("h")
    b.press("PageDown")
    check(names(b) == ["kept: sphere \u00b7 level 2", "sphere \u00b7 level 1"], "names: %s" % names(b))
    faces = b.eval("[mrView.held.drawn, mrView.drawn].map(d => d.get('mesh').drawn.triangles.length / 3)")
    check(faces[0] == 4 * faces[1], "levels: %s faces" % faces)


def models(b):
    """Another model, which is elsewhere, comes to the same place; its own coordinates are told."""
    b.open("models.html")
    b.press("h")
    b.press("n")
    check(names(b) == ["kept: torus \u00b7 1 / 2", "cube \u00b7 2 / 2"], "names: %s" % names(b))
    kept, now = parts(b)
    drawn = [sum(max(abs(x - y) for x, y in zip(p, GROUND)) > 24 for p in part) / len(part) for part in (kept, now)]
    check(min(drawn) > 0.05, "models: shares of the panels %s" % drawn)
    (x, y, w, h), _ = panels(b)
    points = columns("torus.mrs")["mesh", "position"]
    for k in range(8):  # somewhere on the ring
        b.click(x + w / 2 + w * (0.1 + 0.02 * k), y + (h - 40) / 2)
        card = b.picked()
        if card:
            break
    check(card and length(sub([float(v) for v in card["at"].split("  ")], points[int(card["vertex"])])) < 1e-4, "the card tells %s" % card)
    check(float(card["clicked"].split("  ")[0]) > 90, "clicked at %s" % card["clicked"])


def phone(b):
    """One above the other, both above what lies at the foot; nothing is wider than the window."""
    b.size(390, 844, True)
    b.open("film.html")
    b.eval("document.getElementById('hold').click()")
    b.settle()
    b.press("ArrowRight")
    (x0, y0, w, h), (x1, y1, _, _) = panels(b)
    foot = b.eval("document.getElementById('foot').getBoundingClientRect().top")
    check(x0 == x1 and y1 > y0 and y1 + h <= foot, "phone: panels at %s, the foot at %g" % (panels(b), foot))
    low, high = box([p + (0,) for p in b.eval("[...document.querySelectorAll('#labels span')].map(e => (r => [r.right, r.bottom])(e.getBoundingClientRect()))") for p in [tuple(p)]])
    check(high[0] <= 390 and high[1] < foot and b.eval("document.documentElement.scrollWidth") <= 390, "phone: names end at %s" % high)
    b.size(1280, 800)


with Browser() as browser:
    for test in (film, pose, levels, models, phone):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
