"""browser.py -- Chromium without a window, by its DevTools protocol over a pipe: opens a page, clicks, reads, takes pictures.

A page may say nothing to the console and ask for no address but its own: what it does of either is in `said`.
"""
import base64
import json
import os
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run", "--disable-extensions",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--mute-audio",
         "--remote-debugging-pipe"]


def draws():
    """Whether the browser starts on this machine and has WebGL, which a container may keep from it."""
    page = "data:text/html,<script>document.write('WebGL ' + !!document.createElement('canvas').getContext('webgl'))</script>"
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        flags = [flag for flag in FLAGS if flag != "--remote-debugging-pipe"] + ["--user-data-dir=" + profile]
        said = subprocess.run([PROGRAM, *flags, "--dump-dom", page], capture_output=True, timeout=60, check=False).stdout
    return b"WebGL true" in said


class Browser:
    def __init__(self, width=1280, height=800, flags=()):
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
        elif kind == "Network.requestWillBeSent" and not what["request"]["url"].startswith(("data:", "about:", "blob:")):
            if what["request"]["url"] != self.url:
                self.said.append("request: " + what["request"]["url"])

    def size(self, width, height, mobile=False, scale=1):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)

    def dark(self, on):
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if on else "light"}])

    def eval(self, script):
        got = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in got:
            raise RuntimeError(script + ": " + got["exceptionDetails"].get("exception", {}).get("description", "failed"))
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
        self.url = "file://" + os.path.abspath(path)
        began = time.monotonic()
        self.call("Page.navigate", url=self.url)
        if not self.wait("document.readyState === 'complete' && !(document.getElementById('message')?.textContent ?? 'Reading').startsWith('Reading')",
                         seconds):
            raise RuntimeError(path + ": not drawn after %d s" % seconds)
        self.settle()
        return time.monotonic() - began

    def settle(self):
        """What was asked for is done, and two pictures later."""
        self.wait("!document.querySelector('[aria-busy]')")
        self.eval("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30))))")

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
        return self.eval("(b => [b.left, b.top, b.width, b.height])(document.getElementById('canvas').getBoundingClientRect())")

    def picked(self):
        """The card of the picked vertex: what it says of what."""
        return self.eval("Object.fromEntries([...document.querySelectorAll('#picked dt')].map(e => [e.textContent, e.nextSibling.textContent]))")

    def picture(self, path=None):
        """What the window shows: Picture."""
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return Picture(data)


class Picture:
    """A PNG of 8 bits: pixel(x, y) is red, green, blue."""

    def __init__(self, data):
        self.width, self.height, depth, color = struct.unpack(">IIBB", data[16:26])
        assert depth == 8 and color in (2, 6)
        n = self.n = 3 if color == 2 else 4
        at, packed = 8, b""
        while at < len(data):
            size, kind = struct.unpack(">I4s", data[at:at + 8])
            packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
            at += 12 + size
        raw, stride = zlib.decompress(packed), n * self.width
        self.rows, before = [], bytearray(stride)
        for y in range(self.height):
            how, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            if how == 1:
                for i in range(n, stride):
                    line[i] = line[i] + line[i - n] & 255
            elif how == 2:
                line = bytearray((a + b) & 255 for a, b in zip(line, before))
            elif how == 3:
                for i in range(stride):
                    line[i] = line[i] + ((line[i - n] if i >= n else 0) + before[i] >> 1) & 255
            elif how == 4:
                for i in range(stride):
                    a, b, c = line[i - n] if i >= n else 0, before[i], before[i - n] if i >= n else 0
                    p = a + b - c
                    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                    line[i] = line[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c) & 255
            self.rows.append(line)
            before = line

    def pixel(self, x, y):
        return tuple(self.rows[int(y)][self.n * int(x):self.n * int(x) + 3])

    def share(self, box, test):
        """Of the pixels of a box, left, top, width, height, those of which the test is true: a share of 1."""
        x0, y0, w, h = (int(v) for v in box)
        hits = sum(bool(test(self.pixel(x, y))) for y in range(y0, y0 + h, 2) for x in range(x0, x0 + w, 2))
        return hits / max(len(range(0, h, 2)) * len(range(0, w, 2)), 1)
