"""Dextar's report in a browser: python3 page_test.py REPORT/index.html. Exit status 77 where there is no Chromium.

Dextar: l2 = l3 = l4 = l5 = 0.9, J5 = (0, 0), J1 = (1.18, 0). J3 reaches the points within 1.8 of both J5 and J1.
"""
import math
import sys

import chromium
import page_case

REACH, BASE = 1.8, 1.18


class Dextar(page_case.PageCase):
    own = page_case.PageCase.own + ("blob:",)

    def setUp(self):
        self.run_js("corank.panel.unpin(), scrollTo(0, 0)")

    def place(self, portrait, x, y):
        """The place on the screen of (x, y) in a portrait, which is scrolled into sight."""
        return self.run_js(
            f"""(() => {{
          const portrait = corank.portraits[{portrait}];
          portrait.frame.scrollIntoView({{block: "center"}});
          const box = portrait.overlay.getBoundingClientRect();
          return [box.left + portrait.picture.plane.toX({x}), box.top + portrait.picture.plane.toY({y})];
        }})()"""
        )

    def shown(self):
        return self.run_js(
            "corank.panel.current && {set: corank.panel.current.set.name, box: corank.panel.current.box, "
            "x: [...corank.panel.current.x]}"
        )

    def arrows(self):
        return self.run_js("document.querySelectorAll('#panel svg .velocity').length")

    def test_asks_nothing_of_the_network_and_throws_nothing(self):
        super().test_asks_nothing_of_the_network_and_throws_nothing()
        print(
            f"\nready {self.run_js('document.documentElement.dataset.ready')} ms after the page was asked for",
            file=sys.stderr,
        )

    def test_speaks_of_arrows_and_of_drawing_only_where_something_is_drawn(self):
        text = """(points) => {
          const panel = corank.panel, set = panel.model.sets.find((s) => s.name === "inverse"), kept = panel.model.drawing.points;
          panel.model.drawing.points = points ?? kept;
          const values = Object.fromEntries(panel.model.coordinates.map(({name}) => [name, 0]));
          const text = [true, false].map((moved) => panel.describe({set, box: 0, residual: 1e-12, moved}, values)).join();
          panel.model.drawing.points = kept;
          return text;
        }"""
        drawn, bare = self.run_js(f"({text})()"), self.run_js(f"({text})([])")
        self.assertIn("Arrows: ", drawn)
        self.assertEqual(drawn.count("Drawn at"), 2)
        self.assertNotIn("Arrows", bare)
        self.assertNotIn("Drawn", bare)

    def test_takes_arrows_from_the_models_own_rates_where_it_has_such(self):
        arrows = self.run_js(
            """(() => {
          const panel = corank.panel, model = panel.model, set = model.sets.find((s) => s.name === "inverse");
          panel.pinBox(set, 0);
          const points = model.drawing.points.map((p) => ({...p, moves: p.name === "J3" ? ["v", 0] : [0, "locked"]}));
          const like = (thing, changes) => Object.assign(Object.create(Object.getPrototypeOf(thing)), thing, changes);
          const moved = {...model, rates: ["locked", "v"], drawing: {...model.drawing, points}};
          const own = like(panel, {model: moved, picture: like(panel.picture, {model: moved})});
          const x = panel.current.x.map((value, k) => (k === set.configuration ? 0.5 : value));
          own.show({...panel.current, x, set: like(set, {columns: [1], scales: [2]})});
          const arrows = document.querySelectorAll("#panel svg .velocity").length;
          panel.show(panel.current);
          panel.unpin();
          return arrows;
        })()"""
        )
        self.assertEqual(arrows, 1)

    def test_output_portrait_has_boxes_over_the_reach_of_both_arms_and_over_nothing_else(self):
        sigma = self.run_js("corank.model.sets.find((s) => s.name === 'cspace').sigma")
        places = [(0.1 * i + 0.003, 0.1 * k + 0.007) for i in range(-12, 31) for k in range(-20, 21)]
        over = self.run_js(
            f"{[list(place) for place in places]}.map(([x, y]) => corank.portraits[0].picture.boxesOver('cspace', x, y))"
        )
        for (x, y), count in zip(places, over):
            inside = REACH - max(math.hypot(x, y), math.hypot(x - BASE, y))
            if inside >= 0:
                self.assertGreater(count, 0, f"no configuration drawn over ({x}, {y})")
            elif -inside > 1.5 * sigma:
                self.assertEqual(count, 0, f"({x}, {y}) is out of reach")

    def test_inverse_locus_lies_on_the_arcs_that_bound_the_reach(self):
        places = []
        for k in range(100):
            for centre, other in ((0, BASE), (BASE, 0)):
                x, y = centre + REACH * math.cos(math.pi * k / 50), REACH * math.sin(math.pi * k / 50)
                if math.hypot(x - other, y) < REACH - 1e-6:
                    places.append([x, y])
        near = self.run_js(f"{places}.map(([x, y]) => corank.portraits[0].picture.near('inverse', x, y, 1e-6).length)")
        self.assertGreater(len(places), 40)
        for place, count in zip(places, near):
            self.assertGreater(count, 0, f"no inverse singularity drawn at {place}")

    def test_hover_draws_the_mechanism_there_in_four_assembly_modes(self):
        self.browser.move(*self.place(0, 0.6, 0.55))
        shown = self.shown()
        self.assertEqual(shown["set"], "cspace")
        self.assertAlmostEqual(shown["x"][0], 0.6, delta=1e-2)
        self.assertAlmostEqual(shown["x"][1], 0.55, delta=1e-2)
        x, y, c2, s2, c3, s3, c4, s4, c5, s5 = shown["x"]
        self.assertAlmostEqual(x, BASE + 0.9 * c2 + 0.9 * c3, delta=1e-9)
        self.assertAlmostEqual(y, 0.9 * s5 - 0.9 * s4, delta=1e-9)
        self.assertEqual(self.run_js("document.querySelectorAll('#panel .mode').length"), 4)
        self.assertGreater(self.run_js("document.querySelectorAll('#panel svg .link').length"), 3)
        self.assertEqual(self.arrows(), 0)

    def test_hover_beyond_reach_says_that_nothing_is_there(self):
        self.browser.move(*self.place(0, -0.5, 1.6))
        self.assertIsNone(self.shown())
        self.assertIn("No configuration has these values", self.run_js("document.getElementById('panel-text').textContent"))

    def test_click_pins_a_forward_singularity_with_its_velocity(self):
        # J2, J4 both 0.9 above the base's ends and J3 between them: stretched where |J2 J4| = 1.8 on the symmetry axis.
        y = math.sqrt(0.9**2 - 0.31**2)
        self.browser.click(*self.place(0, 0.59, y))
        shown = self.shown()
        self.assertEqual(shown["set"], "forward")
        self.assertGreater(self.arrows(), 0)
        self.assertTrue(self.run_js("document.getElementById('panel').classList.contains('pinned')"))
        # The velocity is in the kernel of L_y: links 3 and 4 keep their lengths while J3 moves.
        c3, s3, c4, s4 = shown["x"][4:8]
        u, v = (self.run_js("corank.panel.rates")[name] for name in ("J3x", "J3y"))
        self.assertGreater(math.hypot(u, v), 0.1)
        self.assertAlmostEqual(u * c3 + v * s3, 0, delta=1e-9)
        self.assertAlmostEqual(u * c4 + v * s4, 0, delta=1e-9)
        self.browser.move(*self.place(0, 0.6, -0.55))
        self.assertEqual(self.shown(), shown, "pinned, but the pointer changed it")
        self.browser.press("Escape")
        self.browser.move(*self.place(0, 0.61, -0.55))
        self.assertEqual(self.shown()["set"], "cspace")

    def test_input_portrait_wraps_angles(self):
        for angle in (-3.1415, 3.1415):
            self.assertGreater(self.run_js(f"corank.portraits[1].picture.boxesOver('cspace', {angle}, -0.5)"), 0)

    def test_keyboard_moves_pins_and_steps_through_modes(self):
        self.browser.click(*self.place(0, 0.6, 0.5))
        self.run_js("corank.portraits[0].frame.focus()")
        self.browser.press("Escape")
        before = self.shown()
        for _ in range(4):
            self.browser.press("ArrowUp")
        moved = self.shown()
        self.assertGreater(moved["x"][1], before["x"][1])
        self.browser.press("Enter")
        self.assertTrue(self.run_js("corank.panel.pinned"))
        self.browser.press("n")
        other = self.shown()
        self.assertNotEqual(other["box"], moved["box"])
        self.assertEqual(
            self.run_js("[...document.querySelectorAll('#panel .mode')].findIndex((b) => b.ariaPressed === 'true')"), 1
        )
        self.browser.press("p")
        self.assertEqual(self.shown()["box"], self.run_js("corank.panel.candidates[0].box"))
        self.browser.press("Escape")
        self.assertFalse(self.run_js("corank.panel.pinned"))

    def test_other_axes_may_be_chosen(self):
        self.run_js(
            """(() => {
          const select = corank.portraits[1].selects[0];
          select.value = 0;
          select.dispatchEvent(new Event("change"));
        })()"""
        )
        self.assertEqual(self.run_js("corank.portraits[1].picture.axes.map((axis) => axis.name)"), ["J3x", "theta5"])
        self.run_js(
            "(() => { const s = corank.portraits[1].selects[0]; s.value = 2; s.dispatchEvent(new Event('change')); })()"
        )

    def test_theme_switch_redraws_in_dark(self):
        paper = "getComputedStyle(document.body).backgroundColor"
        light = self.run_js(paper)
        self.run_js("document.getElementById('theme').click()")
        self.assertNotEqual(self.run_js(paper), light)
        self.run_js("document.getElementById('theme').click()")
        self.assertEqual(self.run_js(paper), light)

    def test_a_planar_mechanism_is_drawn_flat(self):
        self.assertEqual(self.run_js("document.querySelectorAll('.solid').length"), 0)
        for picture in ("#mechanism", "#panel .picture"):
            self.assertGreater(self.run_js(f"document.querySelectorAll('{picture} svg .link').length"), 3)

    def test_the_mechanism_moves_along_a_curve_of_singularities(self):
        self.run_js("corank.panel.pinBox(corank.model.sets.find((s) => s.name === 'cspace'), 5)")
        self.assertTrue(self.run_js("document.querySelector('.player').hidden"), "C-space is no curve")
        self.run_js("corank.panel.pinBox(corank.model.sets.find((s) => s.name === 'forward'), 5)")
        before = self.shown()
        lines = "[...document.querySelectorAll('#panel svg .link')].map((line) => line.getAttribute('points')).join()"
        drawn = self.run_js(lines)
        # Without a graphics card, a frame takes most of a second while the boxes in space are in sight.
        self.browser.click(*self.middle(".player .play", "nearest"))
        self.run_js(
            "new Promise((done) => { const look = () => corank.panel.player.t > 0.05 ? done() : setTimeout(look, 20); look(); })"
        )
        self.assertNotEqual(self.run_js(lines), drawn)
        self.assertEqual(self.arrows(), 1)
        # Links 3 and 4 are in one line all the way.
        for share in (0.1, 0.3, 0.5, 0.7, 0.9):
            self.run_js(
                f"(() => {{ const s = document.querySelector('.player input'); s.value = {1000 * share}; s.dispatchEvent(new Event('input')); }})()"
            )
            self.assertFalse(self.run_js("corank.panel.player.playing"), "moving the slider stops it")
            now = self.shown()
            self.assertEqual(now["set"], "forward")
            c3, s3, c4, s4 = now["x"][4:8]
            self.assertAlmostEqual(c3 * s4 - s3 * c4, 0, delta=1e-6)
            self.assertGreater(math.dist(now["x"][:10], before["x"][:10]), 1e-3)

    def test_a_pick_stops_the_motion(self):
        self.run_js("corank.panel.pinBox(corank.model.sets.find((s) => s.name === 'forward'), 5)")
        self.browser.click(*self.middle(".player .play"))
        self.assertTrue(self.run_js("corank.panel.player.playing"))
        self.browser.click(*self.place(0, 0.6, 0.5))
        self.assertFalse(self.run_js("corank.panel.player.playing"))
        self.assertEqual(self.shown()["set"], "cspace")

    def test_who_asks_for_less_motion_has_the_slider_only(self):
        with chromium.Browser(1360, 1000, calm=True, beside=self.browser) as browser:
            browser.open(page_case.PAGE)
            browser.drawn()
            browser.run("corank.panel.pinBox(corank.model.sets.find((s) => s.name === 'forward'), 5)")
            self.assertTrue(browser.run("document.querySelector('.player .play').hidden"))
            self.assertFalse(browser.run("document.querySelector('.player').hidden"))

    def test_space_orbits_and_picks(self):
        if self.run_js("document.getElementById('space').dataset.webgl") == "none":
            self.assertIn("WebGL", self.run_js("document.querySelector('#space .frame').textContent"))
            self.skipTest("this browser offers no WebGL; the page says so")
        self.run_js("document.querySelector('#space .frame').scrollIntoView({block: 'center'})")
        self.browser.drawn()
        painted = """(() => {
          const from = corank.space.orbit.renderer.domElement, canvas = document.createElement("canvas");
          [canvas.width, canvas.height] = [from.width, from.height];
          const context = canvas.getContext("2d");
          context.drawImage(from, 0, 0);
          const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
          let count = 0;
          for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++count;
          return count / (canvas.width * canvas.height);
        })()"""
        self.assertGreater(self.run_js(painted), 0.02)
        left, top, width, height = self.run_js(
            "(() => { const b = corank.space.orbit.renderer.domElement.getBoundingClientRect(); "
            "return [b.left, b.top, b.width, b.height]; })()"
        )
        eye = self.run_js("corank.space.orbit.camera.position.toArray()")
        self.browser.drag(left + width / 2, top + height / 2, 120, 40)
        self.browser.drawn()
        self.assertNotEqual(self.run_js("corank.space.orbit.camera.position.toArray()"), eye)
        far = self.run_js("corank.space.orbit.camera.position.length()")
        self.browser.mouse("mouseWheel", left + width / 2, top + height / 2, deltaX=0, deltaY=-240)
        self.browser.drawn()
        self.assertLess(self.run_js("corank.space.orbit.camera.position.length()"), far)
        # Where some box of the forward locus is seen, a click picks a singular configuration.
        x, y = self.run_js(
            """(() => {
          const {middles} = corank.space.clouds.find(({set}) => set.name === "forward");
          const at = new THREE.Vector3(middles[0], middles[1], middles[2]).project(corank.space.orbit.camera);
          return [(at.x + 1) / 2, (1 - at.y) / 2];
        })()"""
        )
        self.browser.click(left + x * width, top + y * height)
        self.assertNotEqual(self.shown()["set"], "cspace")
        self.assertTrue(self.run_js("corank.panel.pinned"))
        self.assertIn("Picked", self.run_js("document.querySelector('#space .note').textContent"))
        self.run_js("(() => { const f = corank.space.form; f.value = 'boxes'; f.dispatchEvent(new Event('change')); })()")
        self.browser.drawn()
        self.assertGreater(self.run_js(painted), 0.02)


if __name__ == "__main__":
    page_case.main()
