"""The page of a path of Dextar in a browser: python3 path_test.py PATH.html. Exit status 77 where there is no Chromium.

models/dextar.cuik: from (0.5, 1) with both knees outside to (0.7, 1) in another assembly mode. Links of lengths 0.9, motors in (0, 0), (1.18, 0).
"""
import math

import page_case

LINK = 0.9


class PathPage(page_case.PageCase):
    def setUp(self):
        self.run_js("corank.show.player.seek(0)")

    def frame(self, share):
        """At a share of the way: the coordinates, and whether the point lies in the tube."""
        return self.run_js(
            f"""(() => {{
          const {{curve}} = corank.show, at = curve.at({share} * curve.length);
          return {{moved: at.moved, piece: at.piece, residual: at.residual,
                  values: Object.fromEntries(corank.model.coordinates.map((c) =>
                    [c.name, c.cosine === undefined ? at.x[c.index] : Math.atan2(at.x[c.sine], at.x[c.cosine])]))}};
        }})()"""
        )

    def drawn_joints(self):
        """The places of the joints in the panel's drawing, in pixels."""
        return self.run_js(
            """[...document.querySelectorAll("#panel .picture svg .joint")].map((j) => {
          const box = j.getBoundingClientRect();
          return [box.left + box.width / 2, box.top + box.height / 2];
        })"""
        )

    def test_the_ends_are_the_configurations_that_were_asked_for(self):
        start, end = self.frame(0)["values"], self.frame(1)["values"]
        for values, x in ((start, 0.5), (end, 0.7)):
            self.assertAlmostEqual(values["J3x"], x, delta=1e-9)
            self.assertAlmostEqual(values["J3y"], 1, delta=1e-9)
        ends = self.run_js("corank.show.ends")
        for k, share in enumerate((0, 1)):
            x = self.run_js(f"Array.from(corank.show.curve.at({share} * corank.show.curve.length).x)")
            for a, b in zip(x, ends[k]):
                self.assertAlmostEqual(a, b, delta=1e-9)

    def test_every_frame_lies_in_the_tube_and_none_jumps(self):
        frames = [self.frame(k / 150) for k in range(151)]
        self.assertTrue(all(f["moved"] for f in frames))
        self.assertLess(max(f["residual"] for f in frames), 1e-9)
        self.assertEqual({f["piece"] for f in frames}, set(range(self.run_js("corank.show.curve.pieces.length"))))
        for before, after in zip(frames, frames[1:]):
            for name, value in after["values"].items():
                step = value - before["values"][name]
                self.assertLess(abs(math.remainder(step, 2 * math.pi)), 0.25, name)

    def test_the_drawing_keeps_its_links_lengths(self):
        lengths = []
        for share in (0, 0.3, 0.7, 1):
            self.run_js(f"corank.show.player.seek({share} * corank.show.curve.length)")
            joints = self.drawn_joints()
            self.assertEqual(len(joints), 5)
            pairs = sorted(math.dist(a, b) for i, a in enumerate(joints) for b in joints[:i])
            lengths.append(pairs)
        # Of ten distances four are links, in every frame alike.
        alike = lambda pairs, d: sum(abs(d - other) < 0.5 for other in pairs)
        link = max(lengths[0], key=lambda d: alike(lengths[0], d))
        for pairs in lengths:
            self.assertGreaterEqual(alike(pairs, link), 4)

    def test_plays_to_and_fro_and_stops(self):
        self.browser.click(*self.middle(".player .play"))
        self.run_js(
            "new Promise((done) => { const look = () => corank.show.player.t > 0.05 ? done() : setTimeout(look, 20); look(); })"
        )
        self.browser.click(*self.middle(".player .play"))
        self.assertFalse(self.run_js("corank.show.player.playing"))
        self.run_js(
            "corank.show.player.seek(corank.show.curve.length); corank.show.player.direction = 1; corank.show.player.advance(0.1)"
        )
        self.assertEqual(self.run_js("corank.show.player.direction"), -1)

    def test_the_speed_is_what_is_chosen(self):
        steps = self.run_js(
            """["1", "4", "0.25", "1"].map((speed) => {
          document.querySelector(".player .speed").value = speed;
          return corank.show.player.stepOf(0.05);
        })"""
        )
        self.assertGreater(steps[0], 0)
        for step, times in zip(steps, (1, 4, 0.25, 1)):
            self.assertAlmostEqual(step, times * steps[0], delta=1e-12)

    def test_the_slider_the_plot_and_the_table_go_to_a_place(self):
        half = self.run_js("corank.show.curve.length / 2")
        self.run_js(
            "(() => { const s = document.querySelector('.player input'); s.value = 500; s.dispatchEvent(new Event('input')); })()"
        )
        self.assertAlmostEqual(self.run_js("corank.show.player.t"), half, delta=1e-6)
        right = self.run_js("document.querySelector('.radius .axis').getBoundingClientRect().right")
        left = self.run_js("document.querySelector('.radius .axis').getBoundingClientRect().left")
        _, y = self.middle(".radius svg")
        self.browser.click(left + 0.25 * (right - left), y)
        self.assertAlmostEqual(self.run_js("corank.show.player.t"), 0.5 * half, delta=0.03 * half)
        self.browser.click(*self.middle("#waypoints tbody tr:nth-child(3) td"))
        self.assertEqual(
            self.run_js(
                "[corank.show.player.t === corank.show.curve.starts[2], document.querySelector('#waypoints .current').dataset.node]"
            ),
            [True, "2"],
        )

    def test_a_click_next_to_the_path_in_a_portrait_goes_there(self):
        self.run_js("document.querySelector('#output-portrait').scrollIntoView({block: 'center'})")
        x, y = self.run_js(
            """(() => {
          const portrait = corank.show.portraits[0], {plane} = portrait.picture, box = portrait.overlay.getBoundingClientRect();
          const {x} = corank.show.curve.at(0.5 * corank.show.curve.length);
          return [box.left + plane.toX(x[0]), box.top + plane.toY(x[1])];
        })()"""
        )
        self.browser.click(x, y)
        share = self.run_js("corank.show.player.t / corank.show.curve.length")
        shown = self.run_js("Array.from(corank.show.current.x)")
        there = self.run_js("Array.from(corank.show.curve.at(0.5 * corank.show.curve.length).x)")
        self.assertLess(math.dist(shown[:2], there[:2]), 0.03, share)

    def test_the_line_has_no_jump_where_an_angle_begins_anew(self):
        gaps = self.run_js(
            """corank.show.trace.stretches(corank.show.portraits[1].picture.axes)
          .flatMap((s) => s.slice(1).map(([x, y], i) => Math.hypot(x - s[i][0], y - s[i][1])))"""
        )
        self.assertLess(max(gaps), 0.3)

    def test_a_set_is_hidden_by_its_box_in_the_legend(self):
        self.run_js("document.querySelector('input.toggle[value=forward]').click()")
        self.assertEqual(self.run_js("corank.show.portraits.map(({hidden}) => [...hidden])"), [["forward"], ["forward"]])
        self.run_js("document.querySelector('input.toggle[value=forward]').click()")

    def test_the_plot_shows_each_pieces_radius_in_one_scale(self):
        path = self.run_js("document.querySelector('.radius .step').getAttribute('d')")
        self.assertEqual(path.count("L"), 2 * self.run_js("corank.show.curve.pieces.length") - 1)
        least = min(self.run_js("corank.show.curve.pieces.map(({radius}) => radius)"))
        self.assertIn(f"{least:.3g}", self.run_js("document.querySelector('.facts').textContent"))


if __name__ == "__main__":
    page_case.main()
