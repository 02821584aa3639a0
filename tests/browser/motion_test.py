"""A rhombus' report in a browser: python3 motion_test.py REPORT/index.html. Exit status 77 where there is no Chromium.

tests/data/rhombus.cuik: four links of length 1. With the crank locked at t1 = 0 the rocker still turns, t2 = t3: a self-motion.
"""
import math

import page_case


class SelfMotion(page_case.PageCase):
    def setUp(self):
        self.run_js(
            """(() => {
          const set = corank.model.sets.find((s) => s.name === "forward");
          corank.panel.pinBox(set, set.motions[0].boxes[0]);
        })()"""
        )

    def test_a_self_motion_plays_all_the_way_round(self):
        self.assertFalse(self.run_js("document.querySelector('.player').hidden"))
        curve = self.run_js(
            """(() => {
          const {curve} = corank.panel.player, set = corank.panel.current.set;
          const ways = Array.from({length: 60}, (_, k) => curve.at((k * curve.length) / 60));
          return {closed: curve.closed, boxes: curve.boxes.length, all: set.motions[0].boxes.length,
                  angles: ways.map(({x}) => corank.model.coordinates.map((c) => Math.atan2(x[c.sine], x[c.cosine])))};
        })()"""
        )
        self.assertTrue(curve["closed"])
        self.assertEqual(curve["boxes"], curve["all"])
        turned = 0
        for k, (t1, t2, t3) in enumerate(curve["angles"]):
            self.assertAlmostEqual(t1, 0, delta=1e-6)
            self.assertAlmostEqual(math.remainder(t2 - t3, 2 * math.pi), 0, delta=1e-6)
            turned += math.remainder(t3 - curve["angles"][k - 1][2], 2 * math.pi)
        self.assertAlmostEqual(abs(turned), 2 * math.pi, delta=1e-3)

    def test_a_point_beside_the_self_motion_does_not_play(self):
        self.run_js("corank.panel.pinBox(corank.model.sets.find((s) => s.name === 'cspace-singular'), 0)")
        self.assertTrue(self.run_js("document.querySelector('.player').hidden"))

    def test_solids_are_drawn_to_scale_in_the_plane(self):
        sizes = self.run_js(
            """(() => {
          const svg = document.querySelector("#panel svg"), [ground, end] = [...svg.querySelectorAll(".ground")].map((g) => g.transform.baseVal[0].matrix.e);
          return {unit: end - ground, sphere: Number(svg.querySelector(".sphere").getAttribute("r")),
                  cylinder: Number(svg.querySelector(".cylinder").getAttribute("stroke-width")),
                  colours: [getComputedStyle(svg.querySelector(".sphere")).fill, getComputedStyle(svg.querySelectorAll(".link")[1]).stroke]};
        })()"""
        )
        self.assertAlmostEqual(sizes["sphere"], 0.12 * sizes["unit"], delta=1e-4)
        self.assertAlmostEqual(sizes["cylinder"], 0.1 * sizes["unit"], delta=1e-4)
        self.assertEqual(sizes["colours"], ["rgb(181, 84, 28)", "rgb(47, 125, 91)"])


if __name__ == "__main__":
    page_case.main()
