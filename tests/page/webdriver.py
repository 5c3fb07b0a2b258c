"""A headless Chromium, driven through chromedriver with nothing but Python's standard library.

    with Browser() as browser:
        browser.open("report.html")
        browser.click("button.swap")
        assert browser.run("return document.title") == "..."
        assert browser.pixel(100, 200) == (255, 0, 0)

Every wait has an end: a browser that hangs becomes a BrowserError. Works for root, too.
"""

import base64
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import tempfile
import threading
import time
import urllib.error
import urllib.request
import zlib

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # how WebDriver marks an element in JSON
# Names of keys in WebDriver's private area of Unicode.
KEYS = {"Enter": "\ue007", "Tab": "\ue004", "Control": "\ue009",
        "ArrowLeft": "\ue012", "ArrowRight": "\ue014"}


class BrowserError(Exception):
    pass


def missing_program():
    """The name of what has to be installed, or None."""
    for program in ("chromium", "chromedriver"):
        if shutil.which(program) is None:
            return program
    return None


def decode_png(data):
    """Rows of (r, g, b) from a PNG of 8 bits per channel, RGB or RGBA, not interlaced."""
    width, height, depth, colour = struct.unpack(">IIBB", data[16:26])
    if depth != 8 or colour not in (2, 6):
        raise BrowserError(f"a screenshot of depth {depth} and colour type {colour}")
    size = 3 if colour == 2 else 4
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, rows, above = zlib.decompress(packed), [], bytes(width * size)
    for y in range(height):
        begin = y * (width * size + 1)
        row = unfilter(raw[begin], bytearray(raw[begin + 1:begin + 1 + width * size]), above, size)
        rows.append([tuple(row[i:i + 3]) for i in range(0, len(row), size)])
        above = row
    return rows


def unfilter(kind, row, above, size):
    """PNG specification, section 9."""
    for i in range(len(row)):
        left = row[i - size] if i >= size else 0
        corner = above[i - size] if i >= size else 0
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + above[i]) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            guess = left + above[i] - corner
            near = min((left, above[i], corner), key=lambda value: abs(guess - value))
            row[i] = (row[i] + near) & 255
    return row


class Browser:
    def __init__(self, width=1200, height=900, time_limit=20.0):
        self.time_limit = time_limit
        self.folder = tempfile.mkdtemp(prefix="penumbra-page-")
        self.driver = None
        self.session = ""
        try:
            self._start(width, height)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    # ---- the life of the browser

    def _start(self, width, height):
        environment = dict(os.environ, HOME=self.folder)
        # A process group of its own, which ends as a whole.
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE,
                                       stderr=subprocess.STDOUT, text=True, env=environment,
                                       cwd=self.folder, start_new_session=True)
        self.address = f"http://127.0.0.1:{self._port()}"
        options = {"binary": shutil.which("chromium"),
                   "args": ["--headless=new", "--no-sandbox", "--disable-gpu",
                            "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
                            "--disable-background-networking", "--disable-component-update",
                            "--force-device-scale-factor=1", f"--window-size={width},{height}",
                            f"--user-data-dir={self.folder}/profile"]}
        answer = self._post("/session", {"capabilities": {"alwaysMatch": {
            "browserName": "chrome", "goog:chromeOptions": options,
            "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}})
        self.session = "/session/" + answer["sessionId"]
        self._post(self.session + "/timeouts", {"script": int(1000 * self.time_limit),
                                                "pageLoad": int(1000 * self.time_limit)})

    def _port(self):
        found = []

        def read():
            for line in self.driver.stdout:
                port = re.search(r"started successfully on port (\d+)", line)
                if port and not found:
                    found.append(int(port.group(1)))

        threading.Thread(target=read, daemon=True).start()
        self.wait_for(lambda: found or self.driver.poll() is not None, "chromedriver to start")
        if not found:
            raise BrowserError("chromedriver ended at once")
        return found[0]

    def close(self):
        if self.session:
            try:
                self._request("DELETE", self.session, None, 5)
            except BrowserError:
                pass
        if self.driver:
            try:
                os.killpg(self.driver.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            self.driver.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _request(self, method, path, body, time_limit=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data, method=method,
                                         headers={"Content-Type": "application/json"})
        # No proxy of the surroundings stands before this machine's own port.
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=time_limit or self.time_limit + 10) as response:
                return json.load(response)["value"]
        except urllib.error.HTTPError as error:
            raise BrowserError(json.load(error)["value"]["message"].splitlines()[0]) from None
        except OSError as error:
            raise BrowserError(f"chromedriver does not answer: {error}") from None

    def _post(self, path, body):
        return self._request("POST", path, body)

    # ---- the page

    def open(self, file):
        """A page of the file system, as if somebody had double-clicked it."""
        self._post(self.session + "/url", {"url": "about:blank"})
        self.requests()  # those of the browser's own first page
        self._post(self.session + "/url", {"url": pathlib.Path(file).resolve().as_uri()})

    def run(self, script, *arguments):
        """The value that the body of a function returns; arguments[0] and so on are its own."""
        return self._post(self.session + "/execute/sync",
                          {"script": script, "args": list(arguments)})

    def wait_for(self, condition, what):
        """Asks again and again; returns the first answer that holds."""
        end = time.monotonic() + self.time_limit
        while True:
            answer = condition()
            if answer:
                return answer
            if time.monotonic() > end:
                raise BrowserError(f"waited {self.time_limit} s for {what}")
            time.sleep(0.02)

    def wait_until(self, script, *arguments):
        return self.wait_for(lambda: self.run(script, *arguments), script)

    def find(self, selector):
        answer = self._post(self.session + "/element", {"using": "css selector", "value": selector})
        return answer[ELEMENT]

    def click(self, selector):
        """A real click, in the middle: fails where something else lies above the element."""
        self._post(f"{self.session}/element/{self.find(selector)}/click", {})

    def box(self, selector):
        """left, top, width, height in the window."""
        return self.run("const r = document.querySelector(arguments[0]).getBoundingClientRect();"
                        "return [r.left, r.top, r.width, r.height];", selector)

    # ---- hands

    def _act(self, *sources):
        self._post(self.session + "/actions", {"actions": list(sources)})
        self._request("DELETE", self.session + "/actions", None)

    def press(self, *keys):
        """Keys, one after the other, to what has the focus: characters or names out of KEYS."""
        actions = []
        for key in keys:
            value = KEYS.get(key, key)
            actions += [{"type": "keyDown", "value": value}, {"type": "keyUp", "value": value}]
        self._act({"type": "key", "id": "keyboard", "actions": actions})

    def press_with(self, held, key):
        """A key while another one is held down."""
        held, key = KEYS.get(held, held), KEYS.get(key, key)
        actions = [{"type": kind, "value": value} for kind, value in (
            ("keyDown", held), ("keyDown", key), ("keyUp", key), ("keyUp", held))]
        self._act({"type": "key", "id": "keyboard", "actions": actions})

    def drag(self, begin, end):
        """With the left button from one point of the window to another."""
        (x0, y0), (x1, y1) = begin, end
        move = {"type": "pointerMove", "duration": 0, "origin": "viewport"}
        self._act({"type": "pointer", "id": "mouse", "actions": [
            dict(move, x=round(x0), y=round(y0)), {"type": "pointerDown", "button": 0},
            dict(move, x=round((x0 + x1) / 2), y=round((y0 + y1) / 2)),
            dict(move, x=round(x1), y=round(y1)), {"type": "pointerUp", "button": 0}]})

    def click_at(self, x, y):
        self.drag((x, y), (x, y))

    def scroll(self, x, y, delta):
        """Turns the wheel above a point of the window; positive is towards the user."""
        self._act({"type": "wheel", "id": "wheel", "actions": [
            {"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": delta,
             "duration": 0, "origin": "viewport"}]})

    # ---- eyes

    def pixels(self, x, y, width=1, height=1):
        """Rows of (r, g, b) of a part of the window, as the screen shows it."""
        scroll = self.run("return [scrollX, scrollY]")
        clip = {"x": int(x) + scroll[0], "y": int(y) + scroll[1], "width": width, "height": height,
                "scale": 1}
        answer = self._post(self.session + "/goog/cdp/execute", {
            "cmd": "Page.captureScreenshot", "params": {"format": "png", "clip": clip}})
        return decode_png(base64.b64decode(answer["data"]))

    def pixel(self, x, y):
        return self.pixels(x, y)[0][0]

    def screenshot(self, file):
        """The window as a PNG file, for people."""
        answer = self._request("GET", self.session + "/screenshot", None)
        pathlib.Path(file).write_bytes(base64.b64decode(answer))

    # ---- ears

    def complaints(self):
        """What the page wrote to the console as an error since the last call."""
        entries = self._post(self.session + "/se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if entry["level"] == "SEVERE"]

    def requests(self):
        """The addresses that pages asked for since the last call, their own files included."""
        found = []
        for entry in self._post(self.session + "/se/log", {"type": "performance"}):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
        return found
