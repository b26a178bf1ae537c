"""drag_control.py -- see drag-control.sh, which made the pages."""

from browser import Browser
from checks import check, columns, end, length, sub
from posed import line, same_layers, pose_by


def same(b, stream, line, what):
    """Whether control mesh and surface of the page are what the line makes of the stream, and are drawn so."""
    same_layers(b, stream, line, what, ("control", "mesh"))
    drawn = b.eval("""[...mrView.stage.layers].map(([name, d]) =>
        name + (d.position.length === mrView.posing.placesOf(name).length &&
        d.position.every((x, i) => x === mrView.posing.placesOf(name)[i])))""")
    check(drawn and all(name.endswith("true") for name in drawn), "%s: drawn otherwise: %s" % (what, drawn))


def level(b):
    return b.eval("document.getElementById('level').valueAsNumber")


def show_both(b):
    """The control mesh and the surface over it."""
    b.eval("mrView.change({ visible: new Set(['control', 'mesh']) })")
    b.settle()


def gizmo(b):
    """Dragged by the mouse; then on other levels, there and back, by the slider's key and by the line."""
    values = columns("rest.mrs")
    b.open("rest.html")
    show_both(b)
    most = level(b)
    check(most >= 2 and line(b) == "", "at rest: level %d, line %s" % (most, line(b)))
    rows = [p for p, (r,) in zip(values["control", "position"], values["control", "region"]) if r == 3]
    at = [sum(p[c] for p in rows) / len(rows) for c in range(3)]
    b.press("1")
    check(b.eval("mrView.posing.handle") == 1, "the key 1 chooses no handle")
    grip = b.eval("mrView.stage.gizmo.at.position.toArray().map((x, i) => x + mrView.centre[i])")
    check(length(sub(grip, at)) < 1e-5, "the gizmo is at %s, the handle at %s" % (grip, at))
    x, y = b.eval("""(() => {
        const { gizmo, camera, canvas } = mrView.stage, p = gizmo.at.position.clone();
        const r = canvas.getBoundingClientRect();
        p.x += 0.7 * camera.position.distanceTo(p) * 0.6 / 7;
        p.project(camera);
        return [r.left + (p.x + 1) / 2 * r.width, r.top + (1 - p.y) / 2 * r.height];
    })()""")
    b.mouse("mouseMoved", x, y)
    b.drag(x, y, x + 60, y + 8)
    dragged = line(b)
    check(dragged.startswith("mr-pose -H 1 --translate ") and dragged.endswith(" | mr-decode"), "dragged: " + dragged)
    same(b, "rest.mrs", dragged, "dragged")
    two = "mr-pose -H 1 --rotate 0,0,1,40 --translate 0.1,0.2,0 | mr-pose -H 3 --scale 1.4 | mr-decode"
    pose_by(b, two)
    check(line(b) == two, "the line of two handles: " + line(b))
    same(b, "rest.mrs", two, "two handles")
    b.press("PageDown")
    check(level(b) == most - 1 and line(b) == two + " --level %d" % (most - 1), "a level down: " + line(b))
    same(b, "rest.mrs", line(b), "a level down")
    pose_by(b, two + " --level 0")
    check(level(b) == 0, "the line's level: %d" % level(b))
    same(b, "rest.mrs", line(b), "level 0 by the line")
    pose_by(b, dragged)
    check(level(b) == most and line(b) == dragged, "back: %d, %s" % (level(b), line(b)))
    same(b, "rest.mrs", dragged, "back on the finest level")


def far(b):
    """Far from the origin, and posed by the stream: shown so, and posed on from there; a click on the surface chooses
    a handle."""
    b.open("posed.html")
    show_both(b)
    same(b, "posed.mrs", "mr-decode", "posed by the stream")
    text = "mr-pose -H 1 -r 1,0,0,50 -t 0.1,0,0.1 | mr-decode"
    pose_by(b, text)
    same(b, "posed.mrs", text, "far")
    b.eval("mrView.change({ visible: new Set(['mesh']) })")
    b.settle()
    b.open("rest.html")
    b.eval("mrView.change({ visible: new Set(['mesh']) })")
    b.settle()
    surface = b.eval(
        "mrView.drawn.get('mesh').drawn.position.reduce((o, x, i, p) => (i % 3 === 1 && x > p[3 * o + 1] ? (i - 1) / "
        "3 : o), 0)")
    check(b.eval("mrView.posing.deformer.regionAt(%d).then(r => r)" % surface) == 3,
        "the top of the surface is not handle 1")


with Browser() as browser:
    for test in (gizmo, far):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
