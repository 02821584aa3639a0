"""The mechanism on the studio's page: dragged, in a plane and in space, and what is said of its way."""
import json
import math

from studio_case import MODELS, StudioCase, main


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


if __name__ == "__main__":
    main()
