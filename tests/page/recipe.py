"""recipe.py -- see recipe.sh, which made the pages."""
import os
import shutil
import subprocess

from browser import Browser
from checks import check, columns, end
from painted import give, lasso, push, regions_of, text_of
from posed import type_line


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
    done = subprocess.run(["sh", "script.sh", *operands], cwd="run", stdin=stdin, capture_output=True, text=True, check=False)
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
    for key in keys:
        b.press(key)
    left, top, width, height = b.canvas()
    for key, button in (("p", None), ("1", "clear"), ("0", "fill"), ("l", "through")):
        b.press(key)
        if button:
            push(b, button)
    for key, y0, y1 in (("3", 0.05, 0.3), ("x", 0.75, 0.95)):
        b.press(key)
        lasso(b, [(left + x * width, top + y * height) for x, y in ((0.1, y0), (0.9, y0), (0.9, y1), (0.1, y1))])
    regions = regions_of(b)
    check(set(regions) == {0, 1, 5}, "%s: painted %s" % (page, sorted(set(regions))))
    b.eval("document.getElementById('take').open = true")
    b.settle()
    return regions


FORM = [("mesh", "position"), ("mesh", "triangles"), ("base", "triangles")]


def scripts(b):
    """From the file alone: the same model, the painted regions, and a basis where the stream has a base."""
    model = os.path.abspath("a model.off")
    for name in ("base", "edit"):
        regions = paint(b, name + ".html")
        script = saved(b, "save-script", "a-model.sh")
        code, said = run(script, model)
        check(code == 0, "%s: the script fails: %s" % (name, said))
        check(regions_in("run/a-model-painted.mrs") == regions, name + ": the script gives other regions")
        check(same("run/a-model-painted.mrs", "base.mrs", *FORM), name + ": the script gives another model")
        check(len(columns("run/a-model-painted.mrs")["base", "response"][0]) == 16, name + ": there is no basis of handles 0 to 3")
        check(("mesh", "detail_face") in columns("run/a-model-painted.mrs"), name + ": there are no details")
        check(("mr-solve --basis --rotations linear |" in script) == (name == "edit"), name + ": the solver is told otherwise")
    shutil.copy("a model.off", "run")
    check(subprocess.run(["sh", "script.sh"], cwd="run", check=False, stderr=subprocess.DEVNULL).returncode == 2, "the script reads a file that the history names")
    regions = paint(b, "plain.html")
    code, said = run(saved(b, "save-script", "a-model.sh"), model)
    check(code == 0 and regions_in("run/a-model-painted.mrs") == regions and same("run/a-model-painted.mrs", "plain.mrs", *FORM[:2]), "plain: %d %s" % (code, said))
    regions = paint(b, "silent.html")
    script = saved(b, "save-script", "a-model.sh")
    check("since the stream has no history" in script, "silent: the script does not say what it reads")
    code, said = run(script, os.path.abspath("silent.mrs"))
    check(code == 0 and regions_in("run/a-model-painted.mrs") == regions, "silent: %d %s" % (code, said))
    regions = paint(b, "shape.html")
    code, said = run(saved(b, "save-script", "torus.sh"))
    check(code == 0 and regions_in("run/torus-painted.mrs") == regions and same("run/torus-painted.mrs", "shape.mrs", *FORM[:2]), "shape: %d %s" % (code, said))
    regions = paint(b, "control.html")
    code, said = run(saved(b, "save-script", "bumpy.sh"))
    check(code == 0 and regions_in("run/bumpy-painted.mrs", "control") == regions, "control: %d %s" % (code, said))
    check(("control", "response") in columns("run/bumpy-painted.mrs"), "control: there is no basis")


def levels(b):
    """Of a level of the surface that the page makes: its regions, on what mr-decode makes of the same level."""
    for steps, level in ((0, 2), (1, 1)):
        regions = paint(b, "scan.html", ["PageDown"] * steps)
        saved(b, "save-regions", "bumpy.regions")
        line = b.text("basis-line")
        code, said = run(saved(b, "save-script", "bumpy.sh"))
        subprocess.run(["mr-decode", "-q", "--level", str(level), "scan.mrs", "-o", "level.mrs"], check=True)
        check(code == 0 and regions_in("run/bumpy-painted.mrs") == regions and same("run/bumpy-painted.mrs", "level.mrs", *FORM[:2]), "level %d: %d %s" % (level, code, said))
        check(line.startswith("mr-decode --from control --level %d bumpy.mrs | mr-smooth | mr-remesh | mr-select " % level), "level %d: the line is %s" % (level, line))


def poses(b):
    """The pose that the page shows comes with the regions of the stream, and not with painted ones."""
    line = "mr-pose -H 1 --rotate 0,0,1,20 --translate 0.1,0,0.05 | mr-decode"
    for page, name, edited in (("handled", "bumpy", "control"), ("rest", "a-model", "base")):
        b.open(page + ".html")
        type_line(b, line)
        b.eval("document.getElementById('take').open = true")
        b.settle()
        check(b.eval("document.getElementById('basis').hidden"), page + ": the page asks for a basis that it has")
        code, said = run(saved(b, "save-script", name + ".sh"), *([os.path.abspath("a model.off")] if edited == "base" else []))
        check(code == 0, "%s: the script fails: %s" % (page, said))
        subprocess.run(line.replace("mr-pose", "mr-pose -q", 1) + " -q -o posed.mrs", shell=True, stdin=open(page + ".mrs", "rb"), check=True)
        check(same("run/%s-painted.mrs" % name, "posed.mrs", *FORM[:2], (edited, "position")), page + ": the script gives another pose")
    b.press("p")
    b.press("x")
    give(b, {0: 3, 1: 1, 2: 0})
    b.press("z")
    check("mr-pose" in saved(b, "save-script", "a-model.sh"), "pose: after undo there is no pose")
    b.press("y")
    script = saved(b, "save-script", "a-model.sh")
    check("mr-pose" not in script and not b.eval("document.getElementById('basis').hidden"), "pose: it is of other regions")


def lines(b):
    """The line for a basis, run on the saved regions: a page of the painted handles."""
    for name in ("plain", "base", "control"):
        regions = paint(b, name + ".html")
        kind = "bumpy" if name == "control" else "a-model"
        saved(b, "save-regions", kind + ".regions")
        line = b.text("basis-line")
        check(not b.eval("document.getElementById('basis').hidden") and line.endswith(" -o %s-painted.mrs && mr-view -i %s-painted.mrs %s-painted.html" % (kind, kind, kind)), "%s: the line is %s" % (name, line))
        shutil.rmtree("run", ignore_errors=True)
        os.mkdir("run")
        shutil.copy(name + ".mrs", "run/%s.mrs" % kind)
        shutil.copy("saved/%s.regions" % kind, "run")
        subprocess.run(["sh", "-c", line], cwd="run", check=True, stderr=subprocess.DEVNULL)
        b.open("run/%s-painted.html" % kind)
        check(regions_of(b) == regions, name + ": the page of the line has other regions")


def files(b):
    """A saved file comes back by mr-select."""
    regions = paint(b, "plain.html")
    text = saved(b, "save-regions", "a-model.regions")
    check(text == text_of(b), "saved and copied regions differ")
    subprocess.run(["mr-select", "--from", "saved/a-model.regions", "plain.mrs", "-o", "back.mrs"], check=True)
    check(regions_in("back.mrs") == regions, "mr-select reads other regions")


def hostile(b):
    """Histories and names are words of a script, never commands."""
    b.open("evil.html")
    for i in range(16):
        b.press("p")
        push(b, "fill")
        script = b.eval("mrView.painter.takeAway.script()")
        check(len(b.eval("document.getElementById('number').textContent").split("/")) == 2 and "END\n" in script, "evil: frame %d has no script" % i)
        run(script, os.path.abspath("evil.mrs"))
        pwned = [name for folder, _, names in os.walk(".") for name in names if name.startswith("pwned")]
        check(pwned == [], "evil: frame %d has run something: %s" % (i, script))
        check(not os.path.exists("run/pwned"), "evil: frame %d" % i)
        b.press("ArrowRight")


os.makedirs("saved", exist_ok=True)
with Browser() as browser:
    browser.draw(False)
    browser.call("Page.setDownloadBehavior", behavior="allow", downloadPath=os.path.abspath("saved"))
    for test in (scripts, levels, poses, lines, files, hostile):
        test(browser)
    check(browser.said == [], "the page says to the console or asks for: %s" % browser.said)
end()
