"""levels.py -- see levels.sh, which made the pages."""
import glob
import os

from browser import Browser
from checks import box, check, columns, end, length, sub
from painted import give, push


def values(b, name, layer="mesh", frame=0):
    """A column of a layer as the page has it, as rows."""
    flat, n = b.eval("""(async () => {
        const column = mrView.frames[%d].columns.get("%s\\0%s");
        return column ? [Array.from(await column.values()), column.components] : [[], 1];
    })()""" % (frame, layer, name))
    return [tuple(flat[n * i:n * i + n]) for i in range(len(flat) // n)]


def apart(a, b):
    """The largest distance of two lists of places, in diagonals of the first; infinite where they are not as many."""
    low, high = box(a)
    return max(length(sub(p, q)) for p, q in zip(a, b)) / length(sub(high, low)) if len(a) == len(b) else float("inf")


def shown(b):
    """Level by the slider, faces by the switch of the layer."""
    return (b.eval("document.getElementById('level').valueAsNumber"), b.text("level-is"),
            b.eval("[...document.querySelectorAll('#layers label')].map(e => [e.querySelector('bdi').textContent, "
                "e.querySelector('.size').textContent])"))


def each_level(b, name):
    """Vertices and triangles, and the colours, of every level; coarser by the slider, finer by the key."""
    levels, worst = len(glob.glob(name + "-[0-9].mrs")), 0
    b.open(name + ".html")
    check(b.eval("document.getElementById('levels').hidden") == (levels == 1), "%s: the slider of %d levels"
        % (name, levels))
    for j in [*range(levels - 1, -1, -1), *range(1, levels)]:
        if levels > 1:
            before = shown(b)[0]
            if j < before:
                b.eval("(e => { e.value = %d; e.dispatchEvent(new Event('input')) })(document.getElementById('level'))"
                    % j)
                b.settle()
            elif j > before:
                b.press("PageUp")
        want = columns("%s-%d.mrs" % (name, j))
        faces = "{:,} faces".format(len(want["mesh", "triangles"]))
        level, said, rows = shown(b)
        check(levels == 1 or (level, said) == (j, "%d of %d" % (j, levels - 1)), "%s: level %d is shown as %s, %s"
            % (name, j, level, said))
        check(["mesh", faces] in rows, "%s: level %d: layers %s" % (name, j, rows))
        check(values(b, "triangles") == want["mesh", "triangles"], "%s: level %d has other triangles" % (name, j))
        away = apart(want["mesh", "position"], values(b, "position"))
        worst = max(worst, away)
        check(away < 1e-6, "%s: level %d is %g of the diagonal from mr-decode's" % (name, j, away))
        if ("mesh", "color") in want:
            check(values(b, "color") == want["mesh", "color"], "%s: level %d has other colours" % (name, j))
    heights = [h for (h,) in columns(name + ".mrs")["displacement", "height"]]
    off = max(abs(h - g) for h, (g,) in zip(heights, values(b, "height")))
    low, high = box(columns("%s-%d.mrs" % (name, levels - 1))["mesh", "position"])
    check(off < 1e-6 * length(sub(high, low)), "%s: heights differ by %g" % (name, off))
    print("%s: %d levels, %d vertices, at most %.1e of the diagonal from mr-decode's"
        % (name, levels, len(heights), worst))


def pictures(b):
    """A coarser level is another picture, the finest the first again; colours are those of the heights."""
    b.open("smooth.html")
    first = b.picture()
    b.press("PageDown")
    check(b.picture() != first, "a coarser level looks the same")
    b.press("PageUp")
    check(b.picture() == first, "the finest level again looks otherwise")
    b.press("PageUp")
    check(b.picture() == first, "there is a finer level than the finest")
    names = b.eval("[...document.getElementById('color').options].map(o => o.value)")
    check(names == ["", "height", "color"], "smooth: colours by %s" % names)
    b.open("sharp.html")
    b.press("1")
    check(b.eval("[...document.getElementById('color').options].map(o => o.value)") == ["", "height", "color"],
        "creases are a colour")


def stored(b):
    """A mesh that mr-decode made is not stored, and looks the same; another keeps its name, beside the surface."""
    b.open("stored.html")
    whole = b.picture()
    check(b.eval("document.getElementById('levels').hidden"), "a mesh has levels")
    b.open("decoded.html")
    check([name for name, _ in shown(b)[2]] == ["control", "mesh"], "decoded: %s" % shown(b)[2])
    left, top, width, height = (int(x) for x in b.canvas())
    picture = b.picture()
    differ = sum(max(abs(p - q) for p, q in zip(whole.pixel(x, y), picture.pixel(x, y))) > 24
                 for x in range(left, left + width) for y in range(top, top + height))
    check(differ < 0.001 * width * height, "decoded: %d pixels differ from the mesh" % differ)
    b.open("other.html")
    check(sorted(name for name, _ in shown(b)[2]) == ["control", "displacement", "mesh", "points"], "other: %s"
        % shown(b)[2])
    heights, control = (len(columns("scan.mrs")[key]) for key in (("displacement", "height"), ("control", "position")))
    check(len(values(b, "position", "displacement")) == heights, "other: the surface is not there")
    size, all_of_it = os.path.getsize("small.html"), os.path.getsize("stored.html")
    print("a page of %d heights over %d vertices: %d bytes; as a mesh %d" % (heights, control, size, all_of_it))
    check(size < 600000 and size < all_of_it, "the page has %d bytes" % size)


def film(b):
    """A posed control mesh carries the surface along; the level stays from frame to frame."""
    b.open("film.html")
    finest = shown(b)[0]
    b.press("PageDown")
    for frame in range(1, 4):
        b.press("ArrowRight")
        check(shown(b)[0] == finest - 1, "film: frame %d is on level %s" % (frame, shown(b)[0]))
    b.press("PageUp")
    want = columns("posed.mrs")["mesh", "position"]
    check(apart(want, values(b, "position", frame=3)) < 1e-6, "film: the last frame is %g off"
        % apart(want, values(b, "position", frame=3)))
    b.press("ArrowRight")
    check(apart(want, values(b, "position")) > 0.05, "film: the first frame is the last")


def solved(b):
    """Handles that were painted on a level are those of that level."""
    b.open("scan.html")
    b.press("p")
    count = b.eval("mrView.painter.work.rows")
    give(b, {v: 3 if v < 9 else 0 if v > count // 2 else 1 for v in range(count)})
    push(b, "drag")
    for key, there in (("PageDown", False), ("PageUp", True)):
        b.press(key)
        check(b.eval("!document.getElementById('pose').hidden") == there, "after %s handles are %s" % (key,
            "missing" if there else "there"))


with Browser() as browser:
    browser.draw(False)
    for model in ("smooth", "sharp", "open", "both", "ball-sharp", "flat", "far", "scan"):
        each_level(browser, model)
    film(browser)
    solved(browser)
    browser.draw(True)
    pictures(browser)
    stored(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
