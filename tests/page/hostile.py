"""hostile.py -- see hostile.sh, which made the page."""
from browser import Browser
from checks import check, end

FRAMES = [("<script>alert(1)<\\script>", "<b>bold<|b>", "<img/src=x/onerror=e>"),
          ("\ufffdgnp.exe\"'--><!--]]>", "\"onclick=alert()", "__proto__"),
          ("<script>window.ran=1<\u2215script>", "constructor", "</textarea>")]
GROUPS = ["</script><img src=x onerror=alert(1)>", "\ufffd\ufffd'\"&lt;"]

with Browser() as b:
    b.open("hostile.html")
    for name, layer, column in FRAMES:
        check(b.text("name") == name and b.eval("document.title") == name, "frame: %s, not %s" % (b.text("name"), name))
        check(b.eval("document.querySelector('#layers bdi').textContent") == layer, "layer: not " + layer)
        options = b.eval("[...document.getElementById('color').options].map(o => o.textContent)")
        check(options == ["plain", "group", column], "columns: %s" % options)
        b.choose("color", column)
        check(b.eval("document.getElementById('high').valueAsNumber") == 3, "column %s gives no colours" % column)
        b.choose("color", "group")
        kinds = b.eval("[...document.querySelectorAll('#kinds li')].map(e => e.textContent)")
        check(kinds == GROUPS, "groups: %s" % kinds)
        left, top, width, height = b.canvas()
        b.click(left + width / 2 + 20, top + height / 2)
        said = b.picked()
        check(said.get("layer") == layer and said.get("group") in GROUPS, "picked: %s" % said)
        check(b.text("history") == "<script>alert(1)</script> --\ufffd>", "history: " + b.text("history"))
        check(b.eval("document.querySelectorAll('img, b, script:not([class])').length") == 1,
            "there are elements of the data")
        b.press("ArrowRight")
    check(b.eval("typeof window.ran") == "undefined", "a name was run")
    check(b.said == [], "the page says to the console or asks for: %s" % b.said)
end()
