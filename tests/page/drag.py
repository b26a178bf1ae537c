"""drag.py -- see drag.sh, which made the pages."""
import math
import shlex

from browser import Browser
from checks import Camera, box, check, columns, end, length, sub
from painted import give, push, text_of
from posed import line, places, same_layers, pose_by

GIZMO = 0.6 / 7  # of the distance from the eye: what three.js has as 1


def same(b, stream, line, what):
    same_layers(b, stream, line, what, ("base", "mesh"))


def button(b, name):
    b.eval("document.getElementById('%s').click()" % name)
    b.settle()


def undo(b):
    for kind in ("keyDown", "keyUp"):
        b.call("Input.dispatchKeyEvent", type=kind, key="z", code="KeyZ", modifiers=2)
    b.settle()


def centroid(values, handle):
    rows = [p for p, (r,) in zip(values["mesh", "position"], values["mesh", "region"]) if r == handle + 2]
    return [sum(p[c] for p in rows) / len(rows) for c in range(3)]


def option(b, name):
    """The numbers of an option of the line."""
    words = shlex.split(line(b))
    return [float(w) for w in words[words.index(name) + 1].split(",")] if name in words else []


def pull(b, x0, y0, x1, y1):
    b.mouse("mouseMoved", x0, y0)
    check(b.eval("mrView.stage.gizmo.controls.axis"), "there is nothing to drag at %g, %g" % (x0, y0))
    b.drag(x0, y0, x1, y1)


def gizmo(b):
    """Opens at the first handle, coloured by region; moved, turned and scaled by the mouse, one after another: one
    command, and each of them undone."""
    values = columns("rest.mrs")
    b.open("rest.html")
    camera, at = Camera(values["mesh", "position"], b.canvas()), centroid(values, 1)
    unit = GIZMO * length(sub(camera.eye, at))
    check(line(b) == "" and b.eval("document.getElementById('poseline').hidden"), "there is a pose before there is "
        "one: " + line(b))
    check(b.eval("mrView.posing.handle") == 1 and b.text("hint") == "drag to turn"
        and b.eval("document.getElementById('color').value") == "region", "it does not open in posing")
    b.press("m")

    def pixel(right, up, along=(0, 0, 0)):
        """A place of the gizmo: so far in the picture, and along the axes of the world."""
        return camera.pixel([x + unit * (right * r + up * u + a) for x, r, u,
            a in zip(at, camera.right, camera.up, along)])

    x, y = pixel(0, 0, (0.7, 0, 0))
    pull(b, x, y, x + 60, y + 8)
    move = option(b, "--translate")
    check(len(move) == 3 and move[0] > 0.02 and move[1] == move[2] == 0, "moved along x: " + line(b))
    same(b, "rest.mrs", line(b), "moved")
    check(b.eval("document.getElementById('hint').hidden"), "the hint stays")
    moved, at = line(b), [p + t for p, t in zip(at, move)]
    b.press("t")
    pull(b, *pixel(1.25 * math.cos(0.6), 1.25 * math.sin(0.6)), *pixel(1.25 * math.cos(1.1), 1.25 * math.sin(1.1)))
    turn = option(b, "--rotate")
    check(len(turn) == 4 and abs(turn[3] - 28.6) < 4 and all(abs(a - c) < 0.2 for a, c in zip(turn, camera.back)),
        "turned: " + line(b))
    same(b, "rest.mrs", line(b), "turned")
    turned = line(b)
    b.press("x")
    axis = b.eval("mrView.stage.gizmo.at.matrixWorld.elements.slice(0, 3)")
    pull(b, *pixel(0, 0, [0.7 * a for a in axis]), *pixel(0, 0, axis))
    scale = option(b, "--scale")
    check(len(scale) == 3 and abs(scale[0] - 1 / 0.7) < 0.05 and scale[1:] == [1, 1], "scaled: " + line(b))
    same(b, "rest.mrs", line(b), "scaled")
    scaled = line(b)
    pose_by(b, scaled.replace(" | mr-decode", " | mr-pose -H 3 -r 1,0,0,-30"))
    same(b, "rest.mrs", line(b), "two handles")
    check(line(b).count("mr-pose") == 2, "two handles: " + line(b))
    for want in (scaled, turned, moved, ""):
        undo(b)
        check(line(b) == want, "undone: %s, not %s" % (line(b), want))
    same(b, "rest.mrs", "mr-pose -H 1 | mr-decode", "undone")
    button(b, "redo")
    button(b, "redo")
    check(line(b) == turned, "redone: " + line(b))
    same(b, "rest.mrs", turned, "redone")
    button(b, "reset")
    check(line(b) == "", "reset: " + line(b))


def touch(b):
    """The same with a finger, on a phone."""
    b.size(390, 844, True)
    b.open("rest.html")
    values = columns("rest.mrs")
    camera, at = Camera(values["mesh", "position"], b.canvas()), centroid(values, 1)
    b.press("m")
    unit = GIZMO * length(sub(camera.eye, at))
    x, y = camera.pixel([at[0], at[1] + 0.7 * unit, at[2]])
    for kind, dy in (("touchStart", 0), ("touchMove", 12), ("touchMove", 24), ("touchEnd", None)):
        b.call("Input.dispatchTouchEvent", type=kind, touchPoints=[] if dy is None else [{"x": x, "y": y + dy}])
    move = option(b, "--translate")
    check(len(move) == 3 and move[1] < -0.02 and move[0] == move[2] == 0, "moved along y by a finger: " + line(b))
    same(b, "rest.mrs", line(b), "moved by a finger")
    b.choose("view", "-1,0,0")
    check(b.eval("mrView.stage.gizmo.controls.children[0].gizmo.translate.children.find(c => c.tag === 'fwd' && c.name "
        "=== 'Y').visible"), "the y arrow points down")
    b.size(1280, 800)


LINES = ["mr-pose -H 1 --rotate 0,0,1,40 --translate 0.1,0.2,0 | mr-pose -H 3 --scale 1.4 | mr-decode",
         "mr-pose -H 1 -s 1.2,0.8,1 -r 1,1,0,-75 | mr-pose -H 3 -t 0,-0.2,0 | mr-decode",
         "mr-pose -H 3 -r 0,1,0,300 | mr-decode"]


def lines(b):
    """All that a drag can do."""
    b.open("rest.html")
    for text in LINES:
        pose_by(b, text)
        same(b, "rest.mrs", text, text)
        same(b, "rest.mrs", line(b), "the page's own line for " + text)
    check(not b.eval("document.getElementById('far').hidden") and b.text("degrees") == "300",
          "no word on a turn by 300 degrees: " + b.text("degrees"))
    names = b.eval("[...document.getElementById('color').options].map(o => o.textContent)")
    check(names == ["plain", "region", "detail_height"], "columns to colour by: %s" % names)


def far(b):
    """Far from the origin, with offsets, posed by the stream: shown so at once, and posed on from there; a click
    chooses a handle."""
    values = columns("posed.mrs")
    check(any(x for o in values["mesh", "detail_offset"] for x in o), "there is no offset to be tried")
    b.open("posed.html")
    same(b, "posed.mrs", "mr-decode", "posed by the stream")
    for text in ("mr-pose -H 3 -r 0,1,0,25 | mr-pose -H 1 -t 0.1,0,0.1 -s 0.9 | mr-decode",
        "mr-pose -H 1 -r 1,0,0,50 | mr-decode"):
        pose_by(b, text)
        same(b, "posed.mrs", text, "far: " + text)
    at = [p for p, (r,) in zip(places(b, "mesh"), values["mesh", "region"]) if r == 3]
    camera = Camera(values["mesh", "position"], b.canvas())
    for p in sorted(at, key=lambda p: length(sub(p, camera.eye)))[:5]:
        b.click(*camera.pixel(p))
        if b.picked().get("region") == "handle 1":
            break
    check(b.eval("mrView.posing.handle") == 1, "a click on handle 1 does not choose it: %s" % b.picked())
    where = [float(w) for w in b.picked()["at"].split()]
    check(length(sub(where, places(b, "mesh")[int(b.picked()["vertex"])])) < 1e-5, "picked: %s" % b.picked())


def painted(b):
    """From painting to dragging: what the page solves for is what the pipe does."""
    b.open("plain.html")
    p = columns("plain.mrs")["mesh", "position"]
    b.press("p")
    check(b.eval("document.getElementById('drag').disabled"), "there is nothing to drag yet")
    give(b, {v: 3 if y > 0.9 else 6 if x > 0.8 else 1 for v, (x, y, _) in enumerate(p) if y > -0.9})
    with open("painted.regions", "w") as file:
        file.write(text_of(b))
    push(b, "drag")
    check(b.eval("mrView.posing.handle") == 1, "it does not go from painting to posing")
    text = "mr-pose -H 1 -r 1,1,0,40 -t 0.1,0.2,0 | mr-pose -H 4 -r 0,0,1,30 | mr-decode"
    pose_by(b, text)
    same(b, "plain.mrs", "mr-smooth | mr-select --from painted.regions | mr-solve --basis | mr-encode | " + text,
        "painted")


def two(b):
    """Another model is posed by its own basis, in every layer that is switched on; what was dragged before stays
    behind."""
    b.open("two.html")
    pose_by(b, LINES[0])
    b.press("ArrowRight")
    check(line(b) == "" and places(b, "mesh") == [], "the pose of another model: " + line(b))
    pose_by(b, LINES[0])
    same(b, "far.mrs", LINES[0], "the second model")
    mesh = b.picture()
    b.eval("document.querySelectorAll('#layers input')[1].click()")
    b.settle()
    check(b.eval("mrView.stage.layers.length") == 2 and b.picture() != mesh, "its switch shows no base")
    drawn = b.eval("mrView.drawn.get('base').drawn.position.every((x, i) => x === mrView.posing.placesOf('base')[i])")
    check(drawn, "the base that is switched on is not posed")
    b.press("ArrowRight")
    check(line(b) == "" and b.text("name") == "bumpy", "back at %s: %s" % (b.text("name"), line(b)))


with Browser() as browser:
    for test in (gizmo, touch, lines, far, painted, two):
        browser.draw(test is two)
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
