"""demo.py -- see demo.sh, which made the page and its streams."""
import glob
import subprocess

from browser import Browser
from checks import box, check, columns, end, length, sub
from posed import pose_by

GROUND = (244, 243, 240)
POSE = "mr-pose -H 1 --rotate 0,0,1,20 --translate 0.1,0.2,0"


def posed(b, stream):
    """The line: of what the page does with it, and of what the pipe does."""
    pose_by(b, POSE)
    line = b.text("line")
    with open(stream, "rb") as file, open("made.mrs", "wb") as made:
        subprocess.run(["sh", "-c", line], stdin=file, stdout=made, stderr=subprocess.DEVNULL, check=True)
    want = columns("made.mrs")["mesh", "position"]
    flat = b.eval("Array.from(mrView.posing.placesOf('mesh'), (x, i) => x + mrView.centre[i % 3])")
    low, high = box(want)
    off = max(length(sub(p, flat[3 * i:3 * i + 3])) for i, p in enumerate(want)) / length(sub(high, low))
    check(len(flat) == 3 * len(want) and off < 1e-5, "%s: %g of the diagonal off" % (stream, off))


with Browser() as browser:
    files = sorted(glob.glob("demo/edits/*.mrs")) + sorted(glob.glob("demo/scans/*.mrs"))
    browser.open("demo/index.html")
    titles = browser.eval("[...document.querySelectorAll('#model option')].map(e => e.textContent)")
    check(len(files) >= 7 and [t.split(":")[0] for t in titles] == [f.split("/")[-1][:-4] for f in files],
        "models: %s, of %s" % (titles, files))
    for i, stream in enumerate(files):
        browser.eval("(e => { e.selectedIndex = %d; e.dispatchEvent(new Event('change')) "
            "})(document.getElementById('model'))" % i)
        browser.settle()
        share = browser.picture().share(browser.canvas(), lambda p: max(abs(x - y) for x, y in zip(p, GROUND)) > 16)
        check(0.03 < share < 0.9 and browser.text("message") == "", "%s: %.3f of the picture are drawn; %s"
            % (stream, share, browser.text("message")))
        handles = browser.eval(
            "document.getElementById('pose').hidden ? 0 : document.querySelectorAll('#handles button').length")
        edit = "/edits/" in stream and ".posed" not in stream
        check((handles > 0) == edit, "%s: %d handles" % (stream, handles))
        check(browser.eval(
            "document.querySelector('#layers input:checked').parentElement.querySelector('bdi').textContent") == "mesh",
                stream + ": the mesh is not shown first")
        if edit:
            posed(browser, stream)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
