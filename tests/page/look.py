"""look.py -- see look.sh, which made the pages."""
import math

from browser import Browser
from checks import check, columns, end

LIGHT, DARK = (244, 243, 240), (23, 25, 29)


def far(a, b):
    return max(abs(x - y) for x, y in zip(a, b)) > 24


def bluish(p):
    return p[2] > p[0] + 30


def orange(p):
    return p[0] > p[2] + 60


def sphere(b):
    """All of the silhouette, and nothing but it: half the diagonal of the box is in view, at an angle of 15 degrees."""
    b.open("sphere.html")
    left, top, width, height = b.canvas()
    picture = b.picture()
    radius = height / 2 * math.tan(math.asin(math.sin(math.radians(15)) / math.sqrt(3))) / math.tan(math.radians(15))
    for k in range(36):
        x, y = math.cos(k * math.pi / 18), math.sin(k * math.pi / 18)
        for share, inside in ((0.1, True), (0.5, True), (0.97, True), (1.03, False), (1.2, False)):
            pixel = picture.pixel(left + width / 2 + share * radius * x, top + height / 2 + share * radius * y)
            check(far(pixel, LIGHT) == inside, "sphere: at %g of the radius, %d degrees: %s" % (share, 10 * k, pixel))


def layers(b):
    """The latest first; switches."""
    b.open("film.html")
    rows = b.eval("[...document.querySelectorAll('#layers label')].map(e => [e.querySelector('bdi').textContent, "
        "e.querySelector('.size').textContent, e.querySelector('input').checked])")
    values = columns("film.mrs")
    want = [[name, "{:,} faces".format(len(values[name, "triangles"])), name == "mesh"] for name in ("mesh", "base")]
    check(rows == want, "layers: %s, not %s" % (rows, want))
    mesh = b.picture()
    b.press("1")
    check(b.text("message") == "No layer is switched on.", "no layer: the page says '%s'" % b.text("message"))
    b.press("2")
    base = b.picture()
    check(mesh != base, "the base looks like the mesh")
    b.press("1")
    b.press("2")
    check(b.picture() == mesh, "the mesh alone looks otherwise than at first")


def look(b):
    """Flat, edges, views, the other axis: each another picture, and the first one again behind it.  On the page as it
    was left."""
    first = b.picture()
    for key, back in (("s", "s"), ("e", "e"), ("g", "g")):
        b.press(key)
        check(b.picture() != first, "key %s changes nothing" % key)
        b.press(back)
        check(b.picture() == first, "key %s twice changes something" % key)
    b.press("v")
    front = b.picture()
    check(front != first and b.eval("document.getElementById('view').selectedOptions[0].text") == "front",
        "no view from the front")
    b.choose("up", "z")
    check(b.picture() != front, "z upwards changes nothing")
    b.choose("up", "y")
    check(b.picture() == front, "y upwards again is another view")
    left, top, width, height = b.canvas()
    b.drag(left + 200, top + 200, left + 400, top + 250)
    check(b.picture() != front and b.eval("document.getElementById('picked').hidden"), "a drag turns nothing, or picks")


def color(b):
    """By region and by numbers; the legend and its range.  On the page as it was left."""
    plain = b.picture()
    b.choose("color", "region")
    picture = b.picture()
    kinds = b.eval("[...document.querySelectorAll('#kinds li')].map(e => e.textContent)")
    check(kinds == ["fixed", "free", "handle 1"], "regions: %s" % kinds)
    check(picture.share(b.canvas(), bluish) > 0.02 and picture.share(b.canvas(), orange) > 0.005,
        "regions have no colours")
    b.choose("color", "detail_height")
    heights = [h for (h,) in columns("film.mrs")["mesh", "detail_height"]]
    most = max(-min(heights), max(heights)) if min(heights) < 0 else max(heights)
    shown = b.eval("document.getElementById('high').valueAsNumber")
    check(abs(shown - most) < 1e-4 * most, "greatest: %g, not %g" % (shown, most))
    picture = b.picture()
    check(picture != plain, "numbers have no colours")
    b.choose("high", most / 4)
    check(b.picture() != picture, "another range, the same picture")
    b.eval("document.getElementById('fit-range').click()")
    b.settle()
    check(b.picture() == picture, "the range is not found again")
    b.choose("color", "")
    check(b.picture() == plain, "plain is not as before")


def groups(b):
    b.open("groups.html")
    said = b.text("name"), b.text("caption"), b.eval("document.title"), b.eval("mrView.painter.takeAway.name")
    check(said == ("A <b>", "Red & green.", "A <b>", "two-groups"), "title, caption, name: %s" % (said,))
    b.choose("color", "group")
    kinds = b.eval("[...document.querySelectorAll('#kinds li')].map(e => e.textContent)")
    check(kinds == ["red <b>", "green"], "groups: %s" % kinds)
    picture = b.picture()
    check(picture.share(b.canvas(), lambda p: p[1] > p[0] + 30 or p[0] > p[2] + 60) > 0.1, "groups have no colours")


def film(b):
    """Frames by slider, keys and play; camera and switches stay, until there is another model.  On the page as it was
    left."""
    first = b.picture()
    check(b.text("number") == "1 / 4" and b.text("name") == "bumpy", "film: %s %s" % (b.text("number"), b.text("name")))
    b.press("ArrowLeft")
    check(b.text("number") == "4 / 4" and b.text("name") == "bumpy-0003", "before the first: " + b.text("name"))
    last = b.picture()
    stage = b.canvas()
    differ = sum(last.pixel(x, y) != first.pixel(x, y) for x in range(int(stage[0]), 1270, 4) for y in range(0, 700, 4))
    check(differ > 200, "the last frame looks like the first: %d pixels" % differ)
    b.eval("(e => { e.value = 1; e.dispatchEvent(new Event('input')) })(document.getElementById('time'))")
    b.settle()
    check(b.text("name") == "bumpy-0001", "slider: " + b.text("name"))
    b.press(" ")
    check(b.wait("document.getElementById('name').textContent === 'bumpy-0003'", 60), "play does not go on")
    b.press(" ")
    stopped = b.text("number")
    b.settle()
    check(b.text("number") == stopped, "play does not stop")
    b.open("two.html")
    check(b.text("name") == "torus", "two: " + b.text("name"))
    names = b.eval("[...document.querySelectorAll('#model option')].map(e => e.textContent)")
    check(names == ["torus: original", "cube", "torus: smooth"], "names of models: %s" % names)
    b.press("ArrowRight")
    check(b.text("name") == "cube" and b.picture().share(b.canvas(), lambda p: far(p, LIGHT)) > 0.1,
        "the other model is not in view")


def elsewhere(b):
    """Dark, on a phone, points, nothing to see."""
    b.open("film.html")
    b.dark(True)
    b.settle()
    left, top, width, height = b.canvas()
    check(b.picture().pixel(left + 20, top + 20) == DARK, "dark: %s" % (b.picture().pixel(left + 20, top + 20),))
    b.dark(False)
    b.size(390, 844, True)
    b.settle()
    b.choose("color", "region")
    b.press("f")
    left, top, width, height = b.canvas()
    b.click(left + width / 2, top + height / 2)
    boxes = b.eval("Object.fromEntries(['side', 'film', 'picked'].map(id => [id, (r => [r.left, r.top, r.right, "
        "r.bottom])(document.getElementById(id).getBoundingClientRect())]))")
    for name, (x0, y0, x1, y1) in boxes.items():
        check(0 <= x0 < x1 <= 390 and 0 <= y0 < y1 <= 844, "phone: %s at %s" % (name, (x0, y0, x1, y1)))
    for one, other in (("side", "film"), ("side", "picked"), ("film", "picked")):
        a, c = boxes[one], boxes[other]
        check(a[2] <= c[0] or c[2] <= a[0] or a[3] <= c[1] or c[3] <= a[1], "phone: %s lies over %s" % (one, other))
    check(b.eval("document.documentElement.scrollWidth") <= 390, "phone: wider than the window")
    check(b.picture().share((left, top, width, height), orange) > 0.003, "phone: no handle in view")
    b.size(1280, 800)
    b.open("points.html")
    check(b.picture().share(b.canvas(), lambda p: far(p, LIGHT)) > 0.02, "no points are drawn")
    check(b.eval("document.getElementById('shading').hidden"), "points have edges")
    b.open("void.html")
    check(b.text("message") == "This frame has neither a surface nor points.", "void: the page says '%s'"
        % b.text("message"))


with Browser() as browser:
    for test in (sphere, layers, color, look, film, groups, elsewhere):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
with Browser(flags=["--disable-3d-apis"]) as browser:
    browser.open("sphere.html")
    check("WebGL is missing" in browser.text("message"), "without WebGL the page says '%s'" % browser.text("message"))
    check(not any(s.startswith("exception") for s in browser.said), "without WebGL: %s" % browser.said)
end()
