"""recipe.py -- see recipe.sh, which made the pages."""
import os
import shutil
import subprocess

from browser import Browser
from checks import check, columns, end
from painted import give, push, regions_of, text_of


def saved(b, button, name):
    """The file that a button downloads."""
    path = os.path.join("saved", name)
    if os.path.exists(path):
        os.remove(path)
    push(b, button)
    check(wait_for(b, path), "%s saves no %s, but %s" % (button, name, os.listdir("saved")))
    with open(path, newline="") as file:
        return file.read()


def wait_for(b, path):
    for _ in range(100):
        if os.path.exists(path):
            return True
        b.settle()
    return False


def run(script, *operands, stdin=subprocess.DEVNULL):
    """Runs a script in a folder of its own: exit code and what it says."""
    shutil.rmtree("run", ignore_errors=True)
    os.mkdir("run")
    with open("run/script.sh", "w") as file:
        file.write(script)
    done = subprocess.run(["sh", "script.sh", *operands], cwd="run", stdin=stdin, capture_output=True, text=True,
        check=False)
    return done.returncode, done.stdout + done.stderr


def regions_in(path, layer="mesh"):
    return [r[0] for r in columns(path)[layer, "region"]]


def same(a, b, *names):
    """Whether columns are the same, bit for bit."""
    one, other = columns(a), columns(b)
    return all(one[name] == other[name] for name in names)


def paint(b, page, keys=()):
    """A head and fixed feet, the rest free; keys: to press before."""
    b.open(page)
    for key in ("p", *keys):
        b.press(key)
    n = len(regions_of(b))
    give(b, {v: 5 if v < n // 4 else 0 if v > 3 * n // 4 else 1 for v in range(n)})
    regions = regions_of(b)
    check(set(regions) == {0, 1, 5}, "%s: painted %s" % (page, sorted(set(regions))))
    b.eval("document.getElementById('take').open = true")
    b.settle()
    return regions


FORM = [("mesh", "position"), ("mesh", "triangles")]


def saves(b, page, stream, name, layer="mesh", keys=()):
    """The script of painted regions, run on the stream: these regions, the same model, and a page to drag their
    handles in."""
    regions = paint(b, page + ".html", keys)
    code, said = run(saved(b, "save-script", name + ".sh"), os.path.abspath(stream))
    check(code == 0, "%s: the script fails: %s" % (page, said))
    made = "run/%s-painted" % name
    check(regions_in(made + ".mrs", layer) == regions, page + ": the script gives other regions")
    check(len(columns(made + ".mrs")["base" if layer == "mesh" else layer, "response"][0]) % 4 == 0, page
        + ": there is no basis")
    b.open(made + ".html")
    check(layer != "mesh" or not b.eval("document.getElementById('pose').hidden"), page
        + ": the page of the script has no handles to drag")
    return made + ".mrs"


def scripts(b):
    """Of streams with a base, an edit, neither, of a shape, of a control mesh, of levels that the page makes."""
    for name, model in (("base", "a-model"), ("edit", "a-model"), ("plain", "a-model"), ("shape", "torus")):
        made = saves(b, name, name + ".mrs", model)
        check(same(made, name + ".mrs", *FORM), name + ": the script gives another model")
    saves(b, "control", "control.mrs", "bumpy", "control")
    for steps, level in ((0, 2), (1, 1)):
        made = saves(b, "scan", "scan.mrs", "bumpy", keys=["PageDown"] * steps)
        subprocess.run(["mr-decode", "-q", "--level", str(level), "scan.mrs", "-o", "level.mrs"], check=True)
        check(same(made, "level.mrs", *FORM), "level %d: the script gives another model" % level)
    check(subprocess.run(["sh", "script.sh"], cwd="run", check=False, stderr=subprocess.DEVNULL).returncode == 2,
        "the script needs no stream")


def files(b):
    """A saved file comes back by mr-select."""
    regions = paint(b, "plain.html")
    text = saved(b, "save-regions", "a-model.regions")
    check(text == text_of(b), "saved and copied regions differ")
    subprocess.run(["mr-select", "--from", "saved/a-model.regions", "plain.mrs", "-o", "back.mrs"], check=True)
    check(regions_in("back.mrs") == regions, "mr-select reads other regions")


def hostile(b):
    """No word of a history or a name is in a script."""
    b.open("evil.html")
    b.press("p")
    push(b, "fill")
    script = b.eval("mrView.painter.takeAway.script()")
    check("END\n" in script, "evil: there is no script")
    run(script, os.path.abspath("evil.mrs"))
    pwned = [name for folder, _, names in os.walk(".") for name in names if name.startswith("pwned")]
    check(pwned == [], "evil: something is run: " + script)


os.makedirs("saved", exist_ok=True)
with Browser() as browser:
    browser.draw(False)
    browser.call("Page.setDownloadBehavior", behavior="allow", downloadPath=os.path.abspath("saved"))
    for test in (scripts, files, hostile):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
