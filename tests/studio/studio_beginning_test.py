"""What a newcomer does in the studio, and what becomes of its page without a server."""
import math
import unittest

import chromium
import running
from studio_case import MODELS, PROGRAM, SETTLED, UNTIL, main


class Beginning(unittest.TestCase):
    """What a newcomer does, and what becomes of a page without a server."""

    def test_a_five_bar_is_drawn_and_its_portrait_is_there(self):
        with running.Studio(PROGRAM) as studio, chromium.Browser(1440, 900) as browser:
            browser.go(studio.address)
            self.assertTrue(browser.run("document.getElementById('gallery').open"))
            browser.run("document.getElementById('draw').click()")
            browser.drawn()
            places = {"A": (4, 1), "B": (7, 1), "C": (2.7, 3), "D": (8.4, 3.1), "E": (5.4, 4.8)}

            def click(joint):
                x, y = places[joint]
                browser.click(
                    *browser.run(
                        f"""(() => {{
              const board = document.querySelector(".board");
              const at = new DOMPoint({x}, board.viewBox.baseVal.height - {y}).matrixTransform(board.getScreenCTM());
              return [at.x, at.y];
            }})()"""
                    )
                )

            for tool, joints in (
                ("joint", "ABCDE"),
                ("link", "ACBDCEDE"),
                ("ground", "AB"),
                ("motor", "AB"),
                ("output", "E"),
            ):
                browser.run(f"document.querySelector('[data-tool={tool}]').click()")
                for joint in joints:
                    click(joint)
            browser.run("document.getElementById('drawing-done').click()")
            self.assertTrue(browser.run(UNTIL.replace("CONDITION", SETTLED)))
            constants = browser.run("Object.fromEntries(corank.studio.constants.map(({name, value}) => [name, value]))")
            self.assertEqual(constants["xB"], 3)
            self.assertAlmostEqual(constants["lAC"], math.hypot(1.3, 2), delta=1e-3)
            self.assertTrue(browser.run("corank.studio.model.sets.every(({complete}) => complete)"))
            self.assertGreater(browser.run("corank.studio.model.sets.find(({name}) => name === 'forward').count"), 0)
            self.assertEqual(browser.messages, [])

    def test_a_drawing_says_what_it_lacks(self):
        with running.Studio(PROGRAM) as studio, chromium.Browser(1440, 900) as browser:
            browser.go(studio.address)
            browser.run("document.getElementById('draw').click()")
            lacks = browser.run(
                """(() => {
          const board = corank.studio.board, said = [];
          const use = () => (board.use(), said.push(board.problem.textContent));
          use();
          board.joints = [{x: 1, y: 1}, {x: 2, y: 2}, {x: 3, y: 1}];
          board.links = [[0, 1], [1, 2]];
          use();
          board.ground = [0];
          use();
          board.motors = [2];
          use();
          board.output = 1;
          use();
          return said;
        })()"""
            )
            for said, word in zip(lacks, ("links", "ground", "motor", "output", "joins nothing")):
                self.assertIn(word, said)

    def test_two_tabs_have_models_of_their_own(self):
        with running.Studio(PROGRAM, str(MODELS / "dextar.cuik")) as studio:
            with chromium.Browser(1000, 800) as first, chromium.Browser(1000, 800) as second:
                for browser in (first, second):
                    browser.go(studio.address)
                second.run("corank.studio.setConstant('d', '1.4')")
                for browser, value in ((first, 1.18), (second, 1.4)):
                    self.assertTrue(browser.run(UNTIL.replace("CONDITION", SETTLED)))
                    self.assertEqual(browser.run("corank.studio.constants.find(({name}) => name === 'd').value"), value)
                self.assertEqual(len(studio.children()), 2)

    def test_a_server_that_is_killed_and_started_again(self):
        with running.Studio(PROGRAM, str(MODELS / "dextar.cuik")) as studio, chromium.Browser(1000, 800) as browser:
            browser.go(studio.address)
            self.assertTrue(browser.run(UNTIL.replace("CONDITION", SETTLED)))
            studio.end(9)
            self.assertTrue(browser.run(UNTIL.replace("CONDITION", "s.linkState === 'lost'")))
            self.assertFalse(browser.run("document.getElementById('banner').hidden"))
            self.assertIn("J3x", browser.run("corank.studio.editor.text"))
            with running.Studio(PROGRAM, "--port", str(studio.port)):
                self.assertTrue(browser.run(UNTIL.replace("CONDITION", "s.linkState === 'ended'")))
                self.assertIn("Another run", browser.run("document.getElementById('banner').textContent"))


if __name__ == "__main__":
    main()
