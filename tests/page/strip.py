"""strip.py -- see strip.sh, which made the pages."""
from browser import Browser
from checks import check, end

MADE = "[...document.querySelectorAll('#strip button')].map(e => e.firstChild.width === 192)"
NAMES = ["film: bumpy", "torus", "<img src=x onerror=alert(1)>: knot", "points: cube"]

# Of each picture: the share that is drawn, how bright that is, and where its middle is, all of 1.
PICTURES = """[...document.querySelectorAll('#strip canvas')].map(c => {
	const copy = new OffscreenCanvas(c.width, c.height).getContext('2d', { willReadFrequently: true });
	copy.drawImage(c, 0, 0);
	const d = copy.getImageData(0, 0, c.width, c.height).data;
	let n = 0, light = 0, x = 0, y = 0, edge = 0;
	for (let i = 0; i < d.length; i += 4)
		if (d[i + 3] > 128) {
			const at = i / 4, u = at % c.width, v = Math.floor(at / c.width);
			n++; light += d[i] + d[i + 1] + d[i + 2]; x += u; y += v;
			edge += u === 0 || v === 0 || u === c.width - 1 || v === c.height - 1;
		}
	return { share: 4 * n / d.length, light: light / n / 765, x: x / n / c.width, y: y / n / c.height, edge };
})"""


def current(b):
    return b.eval("[...document.querySelectorAll('#strip [aria-current]')].map(e => e.textContent)")


def few(b):
    b.open("few.html")
    check(b.eval("[...document.querySelectorAll('#strip bdi')].map(e => e.textContent)") == NAMES, "names: %s" % b.eval("document.getElementById('strip').textContent"))
    check(b.eval("document.querySelectorAll('img').length") == 0, "a name is markup")
    check(b.wait(MADE + ".every(Boolean)"), "pictures are not made: %s" % b.eval(MADE))
    pictures = b.eval(PICTURES)
    for name, p in zip(NAMES, pictures):
        check(0.06 < p["share"] < 0.6, "%s: %.3f of the picture are drawn" % (name, p["share"]))
        check(0.3 < p["light"] < 0.95, "%s: its light is %.2f" % (name, p["light"]))
        check(abs(p["x"] - 0.5) < 0.1 and abs(p["y"] - 0.5) < 0.1, "%s: its middle is at %.2f, %.2f" % (name, p["x"], p["y"]))
        check(p["edge"] == 0, "%s: cut off" % name)
    check(len({round(p["share"], 3) for p in pictures}) == 4, "pictures are the same: %s" % pictures)
    steps = [("a click on the third", "document.querySelectorAll('#strip button')[2].click()", 2, "5 / 6"),
             ("N", "n", 3, "6 / 6"), ("N behind the last", "n", 0, "1 / 6"), ("Shift N", "N", 3, "6 / 6"),
             ("the frame before", "ArrowLeft", 2, "5 / 6"), ("a click on the first", "document.querySelectorAll('#strip button')[0].click()", 0, "1 / 6"),
             ("a frame of the same", "ArrowRight", 0, "2 / 6")]
    for what, act, model, number in steps:
        if len(act) > 12:
            b.eval(act)
            b.settle()
        elif act == "N":
            b.call("Input.dispatchKeyEvent", type="keyDown", key="N", text="N", modifiers=8)
            b.call("Input.dispatchKeyEvent", type="keyUp", key="N", modifiers=8)
            b.settle()
        else:
            b.press(act)
        check(current(b) == [NAMES[model]] and b.text("number") == number, "%s: %s, frame %s" % (what, current(b), b.text("number")))
    check(b.text("name") == "film: bumpy-0001", "the name of a delta: " + b.text("name"))


def keyboard(b):
    """By Tab alone: each picture, in its order; Enter shows it."""
    b.eval("document.getElementById('after').focus(); document.getElementById('time').focus()")
    for name in NAMES:
        b.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", code="Tab", windowsVirtualKeyCode=9)
        b.call("Input.dispatchKeyEvent", type="keyUp", key="Tab", code="Tab", windowsVirtualKeyCode=9)
        check(b.eval("document.activeElement.textContent") == name, "Tab: %s, not %s" % (b.eval("document.activeElement.textContent"), name))
    b.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter", windowsVirtualKeyCode=13, text="\r")
    b.call("Input.dispatchKeyEvent", type="keyUp", key="Enter", code="Enter", windowsVirtualKeyCode=13)
    b.settle()
    check(current(b) == [NAMES[3]], "Enter: %s" % current(b))


def upwards(b):
    """Of the other axis the pictures are others, and what is on the stage is drawn as before."""
    before = b.eval(PICTURES)
    shown = b.picture()
    b.choose("up", "z")
    check(b.wait("(%s)[0].share.toFixed(4) !== '%.4f'" % (PICTURES, before[0]["share"])), "z upwards: the first picture is as before")
    b.choose("up", "y")
    check(b.wait("(%s).every((p, i) => Math.abs(p.share - %s[i]) < 1e-6)" % (PICTURES, [p["share"] for p in before])), "y upwards again: other pictures")
    b.settle()
    left, top, width, height = b.canvas()
    after = b.picture()
    differ = sum(after.pixel(x, y) != shown.pixel(x, y) for x in range(int(left), int(left + width), 5) for y in range(int(top), int(top + height), 5))
    check(differ == 0, "the stage has changed: %d pixels" % differ)


def many(b):
    """Those in view have pictures, others when they come into view; the page is at hand meanwhile."""
    b.open("many.html")
    visible = b.eval("Math.ceil(document.getElementById('strip').clientWidth / document.querySelector('#strip button').offsetWidth)")
    check(b.wait("%s.slice(0, %d).every(Boolean)" % (MADE, visible - 1)), "pictures in view are not made")
    b.settle()
    made = b.eval(MADE)
    check(sum(made) < visible + 6 and not any(made[30:]), "%d pictures are made, %d are in view" % (sum(made), visible))
    b.eval("document.querySelectorAll('#strip button')[59].click()")
    check(b.wait(MADE + "[59]"), "the last has no picture")
    right = b.eval("document.querySelector('#strip [aria-current]').getBoundingClientRect().right")
    check(1000 < right <= 1280, "the last is not in view: it ends at %g" % right)
    check(not b.eval(MADE)[30], "one between is made")


def places(b):
    """The strip lies over nothing, on a phone too; a page of one model has none."""
    for width, height in ((1280, 800), (390, 844)):
        b.size(width, height, width < 600)
        b.open("few.html")
        b.wait(MADE + "[0]")
        boxes = b.eval("['canvas', 'foot', 'side', 'strip'].map(id => (r => [r.left, r.top, r.right, r.bottom])(document.getElementById(id).getBoundingClientRect()))")
        strip = boxes.pop()
        check(0 <= strip[0] < strip[2] <= width and 0 <= strip[1] < strip[3] <= height, "the strip is at %s" % strip)
        for name, r in zip(("canvas", "foot", "side"), boxes):
            check(r[2] <= strip[0] or strip[2] <= r[0] or r[3] <= strip[1] or strip[3] <= r[1], "%d pixels wide: the strip lies over %s" % (width, name))
        check(b.eval("document.documentElement.scrollWidth") <= width, "wider than the window")
    b.size(1280, 800)
    b.open("one.html")
    check(b.eval("document.getElementById('strip').hidden && document.querySelectorAll('#strip button').length === 0"), "a strip of one model")
    check(b.canvas()[3] == 800, "the canvas of one model is %g high" % b.canvas()[3])
    check(b.text("name") == "bumpy", "name: " + b.text("name"))


with Browser() as browser:
    for test in (few, keyboard, upwards, many, places):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
