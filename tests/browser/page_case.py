"""What every page is tested for in a browser, and how: the page is the first word of the command line."""
import sys
import unittest

import chromium

PAGE = sys.argv[1] if len(sys.argv) > 1 else ""


class PageCase(unittest.TestCase):
    """One browser, in which all tests of a class find the page as the one before left it."""

    own = ("file:", "data:")  # what the page may ask for: itself, and what it holds

    @classmethod
    def setUpClass(cls):
        cls.browser = chromium.Browser(1360, 1000)
        cls.browser.open(PAGE)
        cls.browser.drawn()
        cls.browser.run("document.documentElement.style.scrollBehavior = 'auto'")

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def run_js(self, script):
        return self.browser.run(script)

    def middle(self, selector, block="center"):
        """The middle of an element, which is scrolled into sight: to the middle of the window or, "nearest", only if need be."""
        return self.run_js(
            f"""(() => {{
          const element = document.querySelector({selector!r});
          element.scrollIntoView({{block: "{block}"}});
          const box = element.getBoundingClientRect();
          return [box.left + box.width / 2, box.top + box.height / 2];
        }})()"""
        )

    def test_asks_nothing_of_the_network_and_throws_nothing(self):
        own = [url for url in self.browser.requests if url.startswith(self.own)]
        self.assertEqual(own, self.browser.requests)
        self.assertEqual(len([url for url in own if url.startswith("file:")]), 1)
        self.assertEqual(self.browser.messages, [])

    def test_a_phone_shows_the_page_without_scrolling_sideways(self):
        with chromium.Browser(390, 844, dark=True, touch=True, beside=self.browser) as phone:
            phone.open(PAGE)
            phone.drawn()
            self.assertLessEqual(phone.run("document.documentElement.scrollWidth"), 390)
            self.assertEqual(phone.run("document.documentElement.dataset.theme"), "dark")
            self.assertEqual(phone.messages, [])


def main():
    """Runs the tests of the calling program. Exit status 77 where there is no Chromium."""
    if not chromium.find():
        print("skipped: there is no Chromium on this machine", file=sys.stderr)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=1)
