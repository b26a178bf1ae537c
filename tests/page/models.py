"""models.py -- see models.sh: the pages on the command line."""
import sys

from browser import Browser
from checks import check, end

GROUND = (244, 243, 240)

with Browser() as b:
    for page in sys.argv[1:]:
        b.open(page)
        names = b.eval("[...document.getElementById('color').options].map(o => o.value)")
        left, top, width, height = b.canvas()
        for name in names:
            b.choose("color", name)
            share = b.picture().share((left, top, width, height),
                lambda p: max(abs(x - y) for x, y in zip(p, GROUND)) > 16)
            check(0.01 < share < 0.9, "%s by %s: %.3f of the picture are drawn" % (page, name or "plain", share))
        check(b.text("message") == "", "%s says '%s'" % (page, b.text("message")))
        check(b.said == [], "%s: to the console, or asks for: %s" % (page, b.said))
end()
