"""What the tests of the studio in a browser share. They are run as python3 FILE PROGRAM MODELS, with tests/browser in PYTHONPATH."""
import json
import pathlib
import sys
import unittest

import chromium
import running

PROGRAM, MODELS = sys.argv[1], pathlib.Path(sys.argv[2])

# Waits until a condition on the studio `s` holds, a frame at a time; false after a minute.
UNTIL = """new Promise((done) => {
  const s = corank.studio, end = performance.now() + 60000;
  const look = () => (CONDITION ? done(true) : performance.now() > end ? done(false) : requestAnimationFrame(look));
  look();
})"""
SETTLED = "s.model && !s.link.waiting && s.asked.number === s.link.number && s.ended === s.link.number"


class StudioCase(unittest.TestCase):
    """One server and one browser for all tests of a class."""

    model = "dextar.cuik"

    @classmethod
    def setUpClass(cls):
        cls.studio = running.Studio(PROGRAM, str(MODELS / cls.model))
        cls.browser = chromium.Browser(1440, 900)
        cls.browser.go(cls.studio.address)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.studio.__exit__()

    def js(self, script):
        return self.browser.run(script)

    def until(self, condition):
        self.assertTrue(self.js(UNTIL.replace("CONDITION", condition)), condition)

    def settle(self):
        self.until(SETTLED)

    def setUp(self):
        path = MODELS / self.model
        start = {"file": path.name, "text": path.read_text(encoding="utf-8"), "fine": False}
        self.js(f"corank.studio.begin({json.dumps(start)})")
        self.settle()

    def type(self, text):
        """As a user changes the model's text."""
        self.js(
            f"""(() => {{
          const area = document.getElementById("text");
          area.value = {json.dumps(text)};
          area.dispatchEvent(new Event("input"));
        }})()"""
        )

    def slide(self, name, place):
        self.js(
            f"""(() => {{
          const {{slider}} = corank.studio.sliders.rows.get({name!r});
          slider.value = {place};
          slider.dispatchEvent(new Event("input"));
        }})()"""
        )


def main():
    """Exit status 77 where there is no Chromium."""
    if not chromium.find():
        print("skipped: there is no Chromium on this machine", file=sys.stderr)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=1)
