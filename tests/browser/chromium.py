"""Drives a headless Chromium through a pipe with the DevTools protocol: Python's standard library and Debian's chromium, no more."""
import base64
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import tempfile


def find():
    """The program, or None where there is none."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Browser:
    """One page. Everything the page asks of the network is in `requests`, what it prints or throws in `messages`."""

    def __init__(self, width=1280, height=900, dark=False, scale=1, touch=False, calm=False, flags=(), beside=None):
        """`beside`: a page whose process shows this one, too, which shares nothing else with it."""
        self.session, self.beside, self.context = None, beside, None
        self.requests, self.messages, self.loaded = [], [], 0
        if beside:
            self.commands, self.answers, self.numbers, self.pages = (
                beside.commands,
                beside.answers,
                beside.numbers,
                beside.pages,
            )
            self.context = self.call("Target.createBrowserContext")["browserContextId"]
        else:
            self._start(flags)
        where = {"browserContextId": self.context} if self.context else {}
        target = self.call("Target.createTarget", url="about:blank", **where)["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.pages[self.session] = self
        for domain in ("Page", "Network", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=touch)
        self.call(
            "Emulation.setEmulatedMedia",
            features=[
                {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
                {"name": "prefers-reduced-motion", "value": "reduce" if calm else "no-preference"},
            ],
        )
        if touch:
            self.call("Emulation.setTouchEmulationEnabled", enabled=True)

    def _start(self, flags):
        self.folder = tempfile.mkdtemp(prefix="corank-chromium-")
        command_read, command_write = os.pipe()
        answer_read, answer_write = os.pipe()

        def pipes():  # Chromium reads commands from 3 and writes answers to 4
            for source, target in ((command_read, 3), (answer_write, 4)):
                os.dup2(os.dup(source) if source in (3, 4) else source, target, inheritable=True)

        # Descriptors above 4, so that neither pipe lies where the other has to go.
        command_read, answer_write = (self._above(command_read), self._above(answer_write))
        self.process = subprocess.Popen(
            [
                find(),
                "--headless=new",
                "--remote-debugging-pipe",
                "--no-first-run",
                "--hide-scrollbars",
                "--mute-audio",
                "--disable-background-networking",
                "--disable-component-update",
                "--enable-unsafe-swiftshader",
                "--disable-gpu-compositing",  # nor a process of its own: a fifth less processor time
                "--in-process-gpu",
                *flags,
                f"--user-data-dir={self.folder}",
                *(["--no-sandbox"] if os.geteuid() == 0 else []),
                "about:blank",
            ],
            preexec_fn=pipes,
            close_fds=False,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(command_read)
        os.close(answer_write)
        self.commands = os.fdopen(command_write, "wb", buffering=0)
        self.answers = os.fdopen(answer_read, "rb")
        self.numbers, self.pages = itertools.count(1), {}

    @staticmethod
    def _above(descriptor):
        high = os.dup(descriptor)
        while high <= 4:
            high = os.dup(high)
        os.close(descriptor)
        return high

    def __enter__(self):
        return self

    def __exit__(self, *_):
        del self.pages[self.session]
        self.session = None
        if self.beside:
            self.call("Target.disposeBrowserContext", browserContextId=self.context)
            return
        try:
            self.call("Browser.close")
        except (OSError, EOFError, RuntimeError):
            pass
        self.process.wait()
        self.answers.close()
        self.commands.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _read(self):
        text = bytearray()
        while (byte := self.answers.read(1)) != b"\0":
            if not byte:
                raise EOFError("the browser ended")
            text += byte
        message = json.loads(text)
        method, values = message.get("method"), message.get("params", {})
        page = self.pages.get(message.get("sessionId"), self)
        if method == "Network.requestWillBeSent":
            page.requests.append(values["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            details = values["exceptionDetails"]
            page.messages.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Log.entryAdded" and values["entry"]["level"] == "error":
            page.messages.append(values["entry"]["text"])
        elif method == "Page.loadEventFired":
            page.loaded += 1
        return message

    def call(self, method, **values):
        number = next(self.numbers)
        command = {"id": number, "method": method, "params": values}
        if self.session:
            command["sessionId"] = self.session
        self.commands.write(json.dumps(command).encode() + b"\0")
        while True:
            message = self._read()
            if message.get("id") == number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]

    def open(self, path):
        self.go(pathlib.Path(path).resolve().as_uri())

    def go(self, url):
        before = self.loaded
        self.call("Page.navigate", url=url)
        while self.loaded == before:
            self._read()

    def run(self, script):
        """The value of a JavaScript expression; promises are awaited."""
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def drawn(self):
        """Waits until the browser has drawn two frames."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0))))")

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def move(self, x, y):
        self.mouse("mouseMoved", x, y)

    def click(self, x, y):
        self.move(x, y)
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1)

    def drag(self, x, y, dx, dy):
        self.mouse("mousePressed", x, y, button="left", clickCount=1)
        for k in range(1, 6):
            self.mouse("mouseMoved", x + dx * k / 5, y + dy * k / 5, button="left", buttons=1)
        self.mouse("mouseReleased", x + dx, y + dy, button="left", clickCount=1)

    def press(self, key, shift=False):
        text = {"text": key} if len(key) == 1 else {"text": "\r"} if key == "Enter" else {}
        for kind in ("keyDown", "keyUp"):
            self.call(
                "Input.dispatchKeyEvent",
                type=kind,
                key=key,
                modifiers=8 if shift else 0,
                **(text if kind == "keyDown" else {}),
            )

    def screenshot(self, path, whole=False):
        """As .png or, smaller, as .webp."""
        kind = pathlib.Path(path).suffix[1:]
        more = {"quality": 80} if kind == "webp" else {}
        answer = self.call("Page.captureScreenshot", format=kind, captureBeyondViewport=whole, **more)
        pathlib.Path(path).write_bytes(base64.b64decode(answer["data"]))

    def photograph(self, selector, path):
        """A picture of one element."""
        x, y, width, height = self.run(
            f"""(() => {{
          const box = document.querySelector({json.dumps(selector)}).getBoundingClientRect();
          return [box.left + scrollX, box.top + scrollY, box.width, box.height];
        }})()"""
        )
        self.drawn()
        answer = self.call(
            "Page.captureScreenshot",
            format="png",
            captureBeyondViewport=True,
            clip={"x": x, "y": y, "width": width, "height": height, "scale": 1},
        )
        pathlib.Path(path).write_bytes(base64.b64decode(answer["data"]))
