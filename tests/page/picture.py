"""picture.py -- the picture of the page in README.md: usage: picture.py demo/index.html OUT.png

An edit of `make demo`, its handle chosen and moved.
"""
import json
import sys

from browser import Browser
from posed import pose_by

MODEL = "armadillo-arms: armadillo"
POSE = "mr-pose -H 1 --rotate 0,0,1,40 --translate -8,-14,0 | mr-pose -H 2 --rotate 0,0,1,30 --translate 14,22,0"

with Browser(1200, 760, scale=1) as b:
    b.open(sys.argv[1])
    if not b.eval("""(e => [...e.options].some((o, i) => o.textContent === %s &&
        (e.selectedIndex = i, e.dispatchEvent(new Event("change")))))(document.getElementById("model"))"""
                  % json.dumps(MODEL)):
        sys.exit("%s: there is no %s" % (sys.argv[1], MODEL))
    b.settle()
    b.choose("color", "region")
    pose_by(b, POSE)
    b.choose("view", "0,0,1")
    left, top, width, height = b.canvas()
    for _ in range(3):  # away, so that the bars below hide nothing of it
        b.call("Input.dispatchMouseEvent", type="mouseWheel", x=left + width / 2, y=top + height / 4, deltaX=0,
            deltaY=120)
        b.settle()
    b.eval("document.querySelector('#handles button:last-child').click(); document.getElementById('turn').click()")
    b.settle()
    if b.said:
        sys.exit(str(b.said))
    b.picture(sys.argv[2])
