"""browser.py -- Chromium without a window, by its DevTools protocol over a pipe: opens a page, clicks, reads, takes
pictures.

It draws by software, which takes most of the time of a test: half as fine as others do, unless a test asks for more,
and not at all
where a test asks for no picture.  A page may say nothing to the console and ask for no address but its own, and those
of its models beside it, PAGE.N.js: what it does else is in `said`.
"""
import base64
import functools
import json
import os
import re
import shutil
import struct
import subprocess
import tempfile
import time
import urllib.parse
import zlib

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run", "--disable-extensions",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--mute-audio",
         "--remote-debugging-pipe"]


def draws():
    """Whether the browser starts on this machine and has WebGL, which a container may keep from it."""
    page = ("data:text/html,<script>document.write("
            "'WebGL ' + !!document.createElement('canvas').getContext('webgl'))</script>")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        flags = [flag for flag in FLAGS if flag != "--remote-debugging-pipe"] + ["--user-data-dir=" + profile]
        said = subprocess.run([PROGRAM, *flags, "--dump-dom", page], capture_output=True, timeout=60,
            check=False).stdout
    return b"WebGL true" in said


# What three.js draws by.
DRAWS_NOTHING = "for (const name of ['drawElements', 'drawArrays']) WebGLRenderingContext.prototype[name] = () => {};"

# Until nothing is under way three times in a row, a picture apart; a minute at most.
SETTLE = """new Promise(done => {
    const end = performance.now() + 60000;
    let calm = 0;
    const look = () => {
        calm = document.querySelector("[aria-busy]") || (window.mrView && mrView.stage.asked) ? 0 : calm + 1;
        if (calm > 2 || performance.now() > end)
            setTimeout(done, 10);
        else
            requestAnimationFrame(() => setTimeout(look));
    };
    look();
})"""


class Browser:
    def __init__(self, width=1280, height=800, flags=(), scale=0.5):
        self.profile = tempfile.mkdtemp()
        ours, theirs = os.pipe(), os.pipe()  # to the browser, from it

        def connect():
            os.dup2(ours[0], 10)
            os.dup2(theirs[1], 11)
            os.dup2(10, 3)
            os.dup2(11, 4)

        self.process = subprocess.Popen(
            [PROGRAM, *FLAGS, *flags, "--user-data-dir=" + self.profile, "about:blank"], preexec_fn=connect,
            close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(ours[0])
        os.close(theirs[1])
        self.to, self.fro = ours[1], theirs[0]
        self.buffer, self.number, self.session, self.said, self.loaded = b"", 0, None, [], False
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.scale, self.undrawn = scale, None
        self.size(width, height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.session = None
            self.call("Browser.close")
        except (OSError, RuntimeError):
            self.process.kill()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, **params):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        while True:
            got = self.read()
            if got.get("id") == self.number:
                if "error" in got:
                    raise RuntimeError(method + ": " + got["error"]["message"])
                return got["result"]
            self.hear(got)

    def read(self):
        while b"\0" not in self.buffer:
            got = os.read(self.fro, 1 << 20)
            if not got:
                raise RuntimeError("the browser has gone")
            self.buffer += got
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def hear(self, event):
        kind, what = event.get("method"), event.get("params", {})
        if kind == "Runtime.consoleAPICalled":
            self.said.append("console: " + " ".join(str(a.get("value", a.get("description"))) for a in what["args"]))
        elif kind == "Runtime.exceptionThrown":
            details = what["exceptionDetails"]
            self.said.append("exception: " + details.get("exception", {}).get("description", details["text"]))
        elif kind == "Log.entryAdded":
            self.said.append("log: " + what["entry"]["text"])
        elif kind == "Page.javascriptDialogOpening":
            self.said.append("dialog: " + what["message"])
        elif kind == "Network.requestWillBeSent" and not what["request"]["url"].startswith(("data:", "about:",
            "blob:")):
            beside = re.escape(self.url[:-len("html")]) + "[0-9]+[.]js"
            if what["request"]["url"] != self.url and not re.fullmatch(beside, what["request"]["url"]):
                self.said.append("request: " + what["request"]["url"])

    def size(self, width, height, mobile=False, scale=None):
        self.scale = scale or self.scale
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=self.scale,
            mobile=mobile)

    def draw(self, on):
        """Whether pages that are opened from now on draw."""
        if on and self.undrawn:
            self.call("Page.removeScriptToEvaluateOnNewDocument", identifier=self.undrawn)
            self.undrawn = None
        elif not on and not self.undrawn:
            self.undrawn = self.call("Page.addScriptToEvaluateOnNewDocument", source=DRAWS_NOTHING)["identifier"]

    def dark(self, on):
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if on else "light"}])

    def eval(self, script):
        got = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in got:
            raise RuntimeError(script + ": " + got["exceptionDetails"].get("exception", {}).get("description",
                "failed"))
        return got["result"].get("value")

    def wait(self, condition, seconds=60):
        """Until an expression is true; False where it does not become so."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.eval(condition):
                return True
            time.sleep(0.05)
        return False

    def open(self, path, seconds=60):
        """Seconds until the page has drawn its first picture."""
        self.url = "file://" + urllib.parse.quote(os.path.abspath(path))
        began = time.monotonic()
        self.call("Page.navigate", url=self.url)
        if not self.wait(
            "document.readyState === 'complete' && !(document.getElementById('message')?.textContent ?? "
            "'Reading').startsWith('Reading')",
                         seconds):
            raise RuntimeError(path + ": not drawn after %d s" % seconds)
        self.settle()
        return time.monotonic() - began

    def settle(self):
        """What was asked for is done, and two pictures later."""
        self.eval(SETTLE)

    def text(self, name):
        return self.eval("document.getElementById(%s).textContent" % json.dumps(name))

    def choose(self, name, value):
        self.eval("(e => { e.value = %s; e.dispatchEvent(new Event('change')) })(document.getElementById(%s))"
                  % (json.dumps(value), json.dumps(name)))
        self.settle()

    def press(self, key):
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)
        self.settle()

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1, **more)

    def click(self, x, y):
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)
        self.settle()

    def drag(self, x0, y0, x1, y1):
        self.mouse("mousePressed", x0, y0)
        for i in range(1, 6):
            self.mouse("mouseMoved", x0 + (x1 - x0) * i / 5, y0 + (y1 - y0) * i / 5, buttons=1)
        self.mouse("mouseReleased", x1, y1)
        self.settle()

    def canvas(self):
        """Its place in the window: left, top, width, height."""
        return self.eval(
            "(b => [b.left, b.top, b.width, b.height])(document.getElementById('canvas').getBoundingClientRect())")

    def picked(self):
        """The card of the picked vertex: what it says of what."""
        return self.eval(
            "Object.fromEntries([...document.querySelectorAll('#picked dt')].map(e => [e.textContent, "
            "e.nextSibling.textContent]))")

    def picture(self, path=None):
        """What the window shows: Picture."""
        assert not self.undrawn, "the page draws nothing"
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png",
            optimizeForSpeed=path is None)["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return Picture(data, self.scale)


def add(_, line, before, __):
    """Bytes of two rows, each modulo 256: every other one at once, with room for a carry."""
    even, a, b = int.from_bytes(b"\0\xff" * (len(line) // 2 + 1), "big"), int.from_bytes(line,
        "big"), int.from_bytes(before, "big")
    both = (a & even) + (b & even) & even | ((a >> 8 & even) + (b >> 8 & even) & even) << 8
    return both.to_bytes(len(line) + 2, "big")[2:]


def undo(how, line, before, n):
    """A row of a PNG as bytes, by the filter that it was packed with."""
    line = bytearray(line)
    for i, above in enumerate(before):
        left, corner = (line[i - n], before[i - n]) if i >= n else (0, 0)
        ways = [(abs(above - corner), left), (abs(left - corner), above), (abs(left + above - 2 * corner), corner)]
        line[i] = line[i] + (0, left, above, left + above >> 1, min(ways, key=lambda way: way[0])[1])[how] & 255
    return bytes(line)


class Picture:
    """A PNG of 8 bits, by rows: equal to another of the same pixels; pixel(x, y) is red, green, blue at a place of the
    window."""

    def __init__(self, data, scale):
        self.data, self.scale = data, scale
        self.width, self.height, depth, color = struct.unpack(">IIBB", data[16:26])
        assert depth == 8 and color in (2, 6)
        self.n = 3 if color == 2 else 4

    def __eq__(self, other):  # what is drawn alike is packed alike
        return self.data == other.data

    __hash__ = None

    @functools.cached_property
    def rows(self):
        at, packed = 8, b""
        while at < len(self.data):
            size, kind = struct.unpack(">I4s", self.data[at:at + 8])
            packed += self.data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
            at += 12 + size
        raw, stride = zlib.decompress(packed), self.n * self.width + 1
        rows, before = [], bytes(stride - 1)
        for at in range(0, stride * self.height, stride):
            before = (add if raw[at] == 2 else undo)(raw[at], raw[at + 1:at + stride], before, self.n)
            rows.append(before)
        return rows

    def pixel(self, x, y):
        row, at = self.rows[int(y * self.scale)], self.n * int(x * self.scale)
        return tuple(row[at:at + 3])

    def share(self, box, test):
        """Of the pixels of a box, left, top, width, height, those of which the test is true: a share of 1."""
        x0, y0, w, h = (int(v) for v in box)
        hits = sum(bool(test(self.pixel(x, y))) for y in range(y0, y0 + h, 2) for x in range(x0, x0 + w, 2))
        return hits / max(len(range(0, h, 2)) * len(range(0, w, 2)), 1)
