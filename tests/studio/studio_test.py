"""The studio in a browser: python3 studio_test.py PROGRAM MODELS, with tests/browser in PYTHONPATH. Exit status 77 where there is
no Chromium."""
import json
import math
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


# A planar four-bar linkage, whose input meets two forward singularities.
FOUR_BAR = """
[LINKS]
ground : point A (0, 0, 0) point D (4, 0, 0)
crank : point A (0, 0, 0) point B (2, 0, 0)
coupler : point B (0, 0, 0) point C (2.5, 0, 0)
rocker : point C (0, 0, 0) point D (3, 0, 0)
[JOINTS]
revolute a : ground A + (0, 0, 1) crank A + (0, 0, 1) actuated
revolute b : crank B + (0, 0, 1) coupler B + (0, 0, 1)
revolute c : coupler C + (0, 0, 1) rocker C + (0, 0, 1)
revolute d : ground D + (0, 0, 1) rocker D + (0, 0, 1)
"""


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


class Design(StudioCase):
    def test_shows_every_set_complete(self):
        sets = self.js("corank.studio.model.sets.map(({name, count, complete}) => [name, count > 0, complete])")
        self.assertEqual(
            sets,
            [["cspace", True, True], ["forward", True, True], ["inverse", True, True], ["cspace-singular", False, True]],
        )
        self.assertIn("every solution is in a box", self.js("document.getElementById('status').textContent"))
        # J2, J3, J4 in a row over (0, 0): the locus passes where the picture says.
        self.assertGreater(self.js("corank.studio.sights.views[0][1].picture.boxesOver('cspace', 0.59, 1.2)"), 0)
        self.assertEqual(self.js("corank.studio.sights.views[0][1].picture.boxesOver('cspace', 0.59, 1.9)"), 0)

    def test_finer_boxes_come_where_they_are_wanted(self):
        coarse = self.js("corank.studio.model.sets.map(({count}) => count)")
        self.js("document.querySelector('#sets .fine').click()")
        self.settle()
        fine = self.js("corank.studio.model.sets.map(({count}) => count)")
        for few, many in zip(coarse[:3], fine):
            self.assertGreater(many, few)

    def test_asks_its_own_server_only_and_throws_nothing(self):
        own = (f"http://127.0.0.1:{self.studio.port}/", "data:", "blob:")
        self.assertEqual([url for url in self.browser.requests if not url.startswith(own)], [])
        self.assertEqual(self.browser.messages, [])

    def test_an_error_is_shown_at_its_line_as_one_types(self):
        text = self.js("corank.studio.editor.text")
        lines = text.split("\n")
        line = next(k for k, words in enumerate(lines) if words.startswith("J3x ="))
        lines[line] = lines[line].replace("l3", "l33")
        self.type("\n".join(lines))
        self.until("s.editor.error")
        self.assertEqual(self.js("corank.studio.editor.error.line"), line + 1)
        self.assertIn("l33", self.js("document.getElementById('problem').textContent"))
        self.assertEqual(self.js("document.querySelector('.gutter b').textContent"), str(line + 1))
        self.js("document.getElementById('problem').click()")
        start = self.js("document.getElementById('text').selectionStart")
        self.assertEqual("\n".join(lines)[:start].count("\n"), line)
        self.type(text)
        self.until("!s.editor.error")
        self.settle()
        self.assertFalse(self.js("document.body.classList.contains('broken')"))

    def test_a_models_text_is_text_whatever_it_looks_like(self):
        self.type('% <img src=x onerror="corank.harm = true">\n' + self.js("corank.studio.editor.text"))
        self.settle()
        self.assertIsNone(self.js("corank.harm ?? null"))
        self.assertIn("<img", self.js("document.querySelector('.shown').textContent"))

    def test_no_picture_is_stale_while_a_slider_moves(self):
        pictures = self.js(
            """(async () => {
          const s = corank.studio, {slider} = s.sliders.rows.get("l2"), seen = [], {sights} = s, draw = sights.draw;
          sights.draw = function (model) {
            draw.call(sights, model);
            seen.push({shown: s.shown.number, newest: s.link.number, value: s.shown.constants.l2, asked: s.asked.request.constants.l2});
          };
          for (let k = 0; k < 90; ++k) {
            slider.value = 300 + 250 * Math.sin(k / 12);
            slider.dispatchEvent(new Event("input"));
            await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
          }
          delete sights.draw;
          return seen;
        })()"""
        )
        self.settle()
        self.assertGreater(len(pictures), 0)
        for picture in pictures:
            self.assertEqual(picture["shown"], picture["newest"])
            self.assertEqual(picture["value"], picture["asked"])
        shown, wanted = self.js("[corank.studio.shown.constants, corank.studio.design.now.constants]")
        self.assertEqual(shown, wanted)
        # C-space of the robot that the slider ends at: both arms stretched.
        l2 = float(shown["l2"])
        self.assertAlmostEqual(self.js("corank.studio.constants.find((c) => c.name === 'l2').value"), l2, delta=1e-12)
        self.assertEqual(len(self.studio.children()), 1)
        self.assertLess(running.resident(self.studio.children()[0]), 1 << 30)

    def test_tolerances_and_ranges_of_constants(self):
        self.js(
            """(() => {
          const {tolerance, low, high} = corank.studio.sliders.rows.get("d");
          tolerance.value = "0.001"; tolerance.dispatchEvent(new Event("change"));
          low.value = "1"; low.dispatchEvent(new Event("change"));
          high.value = "1.5"; high.dispatchEvent(new Event("change"));
        })()"""
        )
        self.settle()
        self.assertEqual(self.js("corank.studio.design.now.constants"), {"d": "1.18±0.001"})
        self.slide("d", 500)
        self.settle()
        self.assertEqual(self.js("corank.studio.design.now.constants"), {"d": "1.25±0.001"})
        self.assertIn("'d=1.25±0.001'", self.js("corank.studio.command()"))

    def test_undo_and_redo(self):
        before = self.js("corank.studio.editor.text")
        self.type(before.replace("d := 1.18", "d := 1.3"))
        self.settle()
        self.slide("l2", 600)
        self.settle()
        self.js("document.getElementById('undo').click()")
        self.assertEqual(self.js("corank.studio.design.now.constants"), {})
        self.js("document.getElementById('undo').click()")
        self.settle()
        self.assertEqual(self.js("corank.studio.editor.text"), before)
        self.js("document.getElementById('redo').click()")
        self.js("document.getElementById('redo').click()")
        self.settle()
        self.assertIn("d := 1.3", self.js("corank.studio.editor.text"))
        self.assertIn("l2", self.js("corank.studio.shown.constants"))

    def test_sets_are_switched_on_and_off(self):
        self.js("document.querySelector('#sets input[value=cspace]').click()")
        self.settle()
        self.assertEqual(
            self.js("corank.studio.model.sets.map(({name}) => name)"), ["forward", "inverse", "cspace-singular"]
        )
        self.js("document.querySelector('#sets input[value=\"forward-nodes\"]').click()")
        self.settle()
        self.assertIn("forward-nodes", self.js("corank.studio.model.sets.map(({name}) => name)"))
        self.assertEqual(
            self.js("corank.studio.command()"),
            "corank report dextar.cuik --sets forward,inverse,cspace-singular,forward-nodes",
        )

    def test_aspects_in_colour(self):
        self.colour("aspects")
        self.settle()
        self.assertEqual(self.js("corank.studio.model.aspects.labels.length"), 10)
        self.assertEqual(self.js("document.querySelectorAll('#portraits input.aspect').length"), 10)

    def colour(self, by):
        self.js(
            f"""(() => {{
          const select = document.querySelector("#sets .colours");
          select.value = {by!r};
          select.dispatchEvent(new Event("change", {{bubbles: true}}));
        }})()"""
        )

    def test_an_error_of_a_requirement_is_told(self):
        self.js("corank.studio.design.change('require', {require: ['amplification(speed) <= 2']})")
        self.until("s.editor.error")
        self.assertEqual(self.js("corank.studio.editor.error.line"), 0)
        self.assertIn("requirement: found 'speed'", self.js("document.getElementById('problem').textContent"))

    def test_requirements_are_shaded(self):
        self.js(
            """(() => {
          const field = document.getElementById("require");
          field.value = "J3y >= 0; J3x <= 3";
          field.dispatchEvent(new Event("change"));
        })()"""
        )
        self.colour("requirements")
        self.settle()
        wrong = self.js(
            """(() => {
          const {set, of, labels} = corank.studio.model.aspects, y = set.variables.indexOf("J3y"), wrong = [];
          const counts = {"met": 0, "not met": 0, "open": 0};
          for (let box = 0; box < set.count; ++box) {
            const label = labels[of[box] - 1], met = set.lower(box, y) >= 0, violated = set.upper(box, y) < 0;
            ++counts[label];
            if ((violated && label === "met") || (met && label === "not met")) wrong.push(box);
          }
          return {wrong, counts};
        })()"""
        )
        self.assertEqual(wrong["wrong"], [])
        self.assertGreater(wrong["counts"]["met"], 0)
        self.assertGreater(wrong["counts"]["not met"], 0)
        self.assertIn("--require 'J3y >= 0' --require 'J3x <= 3'", self.js("corank.studio.command()"))
        self.assertIn("requirements", self.js("corank.studio.model.sets.map(({name}) => name)"))

    def test_what_is_shared_opens_as_it_was(self):
        self.slide("l2", 700)
        self.settle()
        shared = self.js(
            """(async () => {
          const make = URL.createObjectURL;
          let blob;
          URL.createObjectURL = (file) => make.call(URL, (blob = file));
          document.getElementById("share").click();
          URL.createObjectURL = make;
          return blob.text();
        })()"""
        )
        constants = self.js("corank.studio.design.now.constants")
        self.js("document.getElementById('reset').click()")
        self.settle()
        self.js(f"corank.studio.take([new File([{json.dumps(shared)}], 'dextar.studio.json')])")
        self.until("Object.keys(s.design.now.constants).length > 0")
        self.settle()
        self.assertEqual(self.js("corank.studio.shown.constants"), constants)

    def test_a_report_of_what_is_seen(self):
        self.js("document.querySelector('#sets input[value=cspace]').click()")
        self.slide("l2", 700)
        self.settle()
        html = self.js(
            """(async () => {
          const make = URL.createObjectURL;
          const file = await new Promise((found) => {
            URL.createObjectURL = (blob) => (found(blob), make.call(URL, blob));
            document.getElementById("report").click();
          });
          URL.createObjectURL = make;
          return file.text();
        })()"""
        )
        self.settle()
        value = self.js("corank.studio.design.now.constants.l2")
        self.assertIn(f"corank report dextar.cuik --sets forward,inverse,cspace-singular -D l2={value}", html)
        self.assertIn('id="boxes-forward"', html)

    def drop(self, files):
        self.js(
            f"""(() => {{
          const data = new DataTransfer();
          for (const [name, text] of Object.entries({json.dumps(files)})) data.items.add(new File([text], name));
          document.body.dispatchEvent(new DragEvent("drop", {{dataTransfer: data, bubbles: true, cancelable: true}}));
        }})()"""
        )
        self.until(f"s.design.now.file === {next(iter(files))!r}")
        self.settle()
        self.assertIsNone(self.js("corank.studio.editor.error ?? null"))
        self.assertGreater(self.js("corank.studio.model.sets.find(({name}) => name === 'forward').count"), 0)

    def test_a_urdf_file_with_its_companion_is_dropped(self):
        folder = MODELS.parent / "tests" / "data" / "urdf"
        self.drop({name: (folder / name).read_text(encoding="utf-8") for name in ("five_bar.urdf", "five_bar.loops")})
        self.assertTrue(self.js("corank.studio.command()").startswith("corank report five_bar.urdf --loops five_bar.loops"))

    def test_a_world_is_dropped(self):
        self.drop({"four_bar.world": FOUR_BAR})
        self.assertTrue(self.js("corank.studio.command()").startswith("corank report four_bar.world"))

    def test_everything_that_is_operated_has_a_name(self):
        nameless = self.js(
            """[...document.querySelectorAll("button, input, select, textarea, [tabindex], [role]")]
          .filter((e) => e.type !== "file" && !e.closest("[hidden]"))
          .filter((e) => !(e.getAttribute("aria-label") || e.getAttribute("aria-labelledby") || e.labels?.length || e.title ||
            e.textContent.trim() || ["toolbar", "status", "group", "alert"].includes(e.getAttribute("role"))))
          .map((e) => e.outerHTML.slice(0, 120))"""
        )
        self.assertEqual(nameless, [])

    def test_files_that_are_no_models_are_refused(self):
        self.js("corank.studio.take([new File(['x'], 'a.txt')])")
        self.until("s.editor.error")
        self.assertIn("expected a file that ends in", self.js("document.getElementById('problem').textContent"))


class Motion(StudioCase):
    def joint(self, selector=".effector"):
        return self.js(
            f"""(() => {{
          const box = corank.studio.sights.panel.picture.svg.querySelector({selector!r}).getBoundingClientRect();
          return [box.left + box.width / 2, box.top + box.height / 2];
        }})()"""
        )

    def test_a_joint_is_dragged_along_c_space(self):
        for dx, dy in ((20, -5), (-30, 15), (0, 12), (15, 10)):
            before = self.joint()
            self.browser.drag(*before, dx, dy)
            self.browser.drawn()
            after = self.joint()
            self.assertAlmostEqual(after[0] - before[0], dx, delta=0.5)
            self.assertAlmostEqual(after[1] - before[1], dy, delta=0.5)
            self.assertLess(self.js("corank.studio.sights.bench.residualNow"), 1e-9)
            x = self.js("[...corank.studio.sights.bench.x]")
            j3x, j3y, c2, s2, c3, s3 = x[:6]
            self.assertAlmostEqual(1.18 + 0.9 * c2 + 0.9 * c3, j3x, delta=1e-9)
            self.assertAlmostEqual(0.9 * s2 + 0.9 * s3, j3y, delta=1e-9)

    def signs(self):
        """Of sin(θ5 − θ4), sin(θ3 − θ4) and sin(θ3 − θ2): which way the elbows and the end are bent."""
        c2, s2, c3, s3, c4, s4, c5, s5 = self.js("[...corank.studio.sights.bench.x]")[2:]
        return [math.copysign(1, x) for x in (s5 * c4 - c5 * s4, s3 * c4 - c3 * s4, s3 * c2 - c3 * s2)]

    def test_a_path_keeps_its_mode_until_it_meets_a_singularity(self):
        way = self.js(
            """(() => {
          const {bench} = corank.studio.sights, way = [];
          for (let k = 0; k <= 200; ++k) {
            const angle = k / 20, goal = {J3x: 0.59 + 0.15 * Math.cos(angle), J3y: 1.25 + 0.1 * Math.sin(angle)};
            const {residual, distance, crossed} = bench.moveNow(bench.motion.ofValues(goal));
            way.push({residual, distance, crossed});
          }
          return way;
        })()"""
        )
        signs = self.signs()
        for at in way[1:]:
            self.assertLess(at["residual"], 1e-9)
            self.assertLess(at["distance"], 1e-9)
            self.assertEqual(at["crossed"], [])
        for y in (0.3, 0.25):
            self.js(
                f"corank.studio.sights.bench.moveNow(corank.studio.sights.bench.motion.ofValues({{J3x: 0.59, J3y: {y}}}))"
            )
            self.assertIn("forward singularity", self.js("document.getElementById('warning').textContent"))
        self.assertNotEqual(self.signs(), signs)
        # Another robot has met none, and is seen over axes of its own.
        text = (MODELS / "three_slider.cuik").read_text(encoding="utf-8")
        self.js(f"corank.studio.begin({{file: 'three_slider.cuik', text: {json.dumps(text)}, fine: false}})")
        self.settle()
        self.assertEqual(self.js("document.getElementById('warning').textContent"), "")
        self.assertTrue(self.js("document.querySelector('#panel .player').hidden"))
        for role, k in (("output", 0), ("input", 1)):
            axes = self.js(f"corank.studio.sights.views[{k}][1].picture.axes.map((axis) => axis.role)")
            self.assertIn(role, axes)

    def test_the_end_of_a_range_is_said(self):
        text = self.js("corank.studio.editor.text").replace("J3y    : [-l4-l5, l4+l5]", "J3y    : [-l4-l5, 1.3]")
        self.type(text)
        self.settle()
        self.js("corank.studio.sights.bench.moveNow(corank.studio.sights.bench.motion.ofValues({J3x: 0.59, J3y: 1.4}))")
        self.assertIn("J3y is at an end of its range", self.js("document.getElementById('warning').textContent"))

    def test_the_end_of_the_workspace_stops_it(self):
        result = self.js(
            """(() => {
          const {bench} = corank.studio.sights, {x, residual, distance} = bench.moveNow(bench.motion.ofValues({J3x: 0.59, J3y: 3}));
          return {y: x[1], residual, distance};
        })()"""
        )
        self.assertLess(result["residual"], 1e-9)
        # Both arms stretched: J3y = 11 sqrt(239)/100.
        self.assertLess(result["y"], 0.11 * math.sqrt(239) + 1e-9)
        self.assertGreater(result["y"], 1.6)

    def test_clearance_is_a_bound_that_corank_proves(self):
        # doc/clearance.md: the radius about (0.5, 1) is in [0.157818, 0.159413].
        self.js("corank.studio.sights.bench.moveNow(corank.studio.sights.bench.motion.ofValues({J3x: 0.5, J3y: 1}))")
        nearest = self.js("corank.studio.sights.bench.nearest")
        self.assertLess(nearest, 0.159413)
        self.assertGreater(nearest, 0)
        self.assertIn("≥ 0.", self.js("document.getElementById('clearance').textContent"))

    def test_modes_are_switched_at_the_same_place(self):
        self.js(
            "(() => { const b = corank.studio.sights.bench; b.begin(); b.moveNow(b.motion.ofValues({J3x: 0.59, J3y: 1})); b.end(); })()"
        )
        self.assertEqual(self.js("corank.studio.sights.panel.candidates.filter(({set}) => !set.singular).length"), 4)
        modes = set()
        for k in range(self.js("corank.studio.sights.panel.candidates.length")):
            self.js(f"document.querySelectorAll('#panel .mode')[{k}].click()")
            self.assertLess(self.js("corank.studio.sights.bench.residualNow"), 1e-9)
            if self.js(f"!corank.studio.sights.panel.candidates[{k}].set.singular"):
                x = self.js("[...corank.studio.sights.bench.x]")
                self.assertAlmostEqual(x[0], 0.59, delta=1e-9)
                self.assertAlmostEqual(x[1], 1, delta=1e-9)
                modes.add(tuple(round(value, 6) for value in x))
        self.assertEqual(len(modes), 4)

    def test_the_mechanism_keeps_its_place_while_the_model_changes(self):
        before = self.js("[...corank.studio.sights.bench.x]")
        signs = self.signs()
        self.slide("l2", 350)
        self.settle()
        after = self.js("[...corank.studio.sights.bench.x]")
        self.assertNotEqual(before, after)
        self.assertLess(max(abs(a - b) for a, b in zip(before, after)), 0.3)
        self.assertEqual(self.signs(), signs)
        self.assertLess(self.js("corank.studio.sights.bench.residualNow"), 1e-9)

    def test_the_keyboard_moves_it_too(self):
        before = self.js("[...corank.studio.sights.bench.x]")
        self.js("corank.studio.sights.views[0][1].frame.focus()")
        for kind in ("keyDown", "keyUp"):
            self.browser.call("Input.dispatchKeyEvent", type=kind, key="ArrowRight", modifiers=1)
        after = self.js("[...corank.studio.sights.bench.x]")
        self.assertGreater(after[0], before[0])
        self.assertAlmostEqual(after[1], before[1], delta=1e-9)


class InSpace(StudioCase):
    model = "platforms/stewart.cuik"

    def place(self, name):
        """Of a joint, in pixels of the window."""
        return self.js(
            f"""(() => {{
          const {{picture}} = corank.studio.sights.panel, k = picture.points.findIndex(({{label}}) => label[0] === {name!r});
          return picture.onScreen(picture.points)[k];
        }})()"""
        )

    def test_a_joint_is_dragged_as_it_is_seen(self):
        for dx, dy in ((8, -6), (-10, 4), (3, 8)):
            before = self.place("P")
            self.browser.drag(*before, dx, dy)
            self.browser.drawn()
            after = self.place("P")
            self.assertAlmostEqual(after[0] - before[0], dx, delta=0.5)
            self.assertAlmostEqual(after[1] - before[1], dy, delta=0.5)
            self.assertLess(self.js("corank.studio.sights.bench.residualNow"), 1e-9)

    def test_a_pointer_on_nothing_turns_the_view(self):
        before = self.js("[...corank.studio.sights.bench.x]")
        eye = self.js("corank.studio.sights.panel.picture.orbit.camera.position.toArray()")
        frame = self.js(
            "(({left, bottom}) => [left, bottom])(corank.studio.sights.panel.picture.frame.getBoundingClientRect())"
        )
        self.browser.drag(frame[0] + 10, frame[1] - 10, 40, 0)
        self.browser.drawn()
        self.assertNotEqual(self.js("corank.studio.sights.panel.picture.orbit.camera.position.toArray()"), eye)
        self.assertEqual(self.js("[...corank.studio.sights.bench.x]"), before)


class Rocking(StudioCase):
    """A spatial linkage, whose equations depend on each other."""

    model = "spatial/rssr.cuik"

    def test_the_input_stops_at_a_forward_singularity(self):
        stuck = self.js(
            """(() => {
          const {bench} = corank.studio.sights, {motion} = bench, way = [];
          for (let k = 0; k < 63; ++k) {
            const {distance, crossed} = bench.moveNow(motion.ofValues({t: 0.1 * k}));
            way.push([distance > 1e-6, crossed.includes("forward")]);
          }
          return way;
        })()"""
        )
        self.assertIn([True, True], stuck)
        self.assertIn([False, False], stuck)


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
    if not chromium.find():
        print("skipped: there is no Chromium on this machine", file=sys.stderr)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=1)
