"""A spatial four-bar's report in a browser: python3 space_test.py REPORT/index.html. Exit status 77 where there is no Chromium.

tests/data/rssr.cuik: cranks of 0.5 about z in (0, 0, 0.3) and of 0.9 about x in (1, 0, 0), a rod of 1.25 from A to B.
"""
import math

import chromium
import page_case

HEIGHT, CRANK, ROCKER, ROD = 0.3, 0.5, 0.9, 1.25


class SpatialFourBar(page_case.PageCase):
    def setUp(self):
        if not self.run_js("Boolean(document.createElement('canvas').getContext('webgl2'))"):
            self.skipTest("this browser offers no WebGL")
        self.run_js("corank.panel.unpin(); corank.panel.picture.orbit.reset()")

    def pin(self, name, box):
        self.run_js(f"corank.panel.pinBox(corank.model.sets.find((s) => s.name === '{name}'), {box})")
        self.browser.drawn()

    def angles(self):
        return self.run_js(
            "corank.model.coordinates.map((c) => Math.atan2(corank.panel.current.x[c.sine], corank.panel.current.x[c.cosine]))"
        )

    def ends(self):
        """A and B as the angles say, and as they stand in the scene, in the model's lengths."""
        t, p = self.angles()
        drawn = self.run_js(
            """(() => {
          const {at, middle, scale} = corank.panel.picture;
          return ["A", "B"].map((end) => at[corank.model.drawing.points.findIndex(({name}) => name === end)])
            .map((v) => v.clone().divideScalar(scale).add(middle).toArray());
        })()"""
        )
        return [(CRANK * math.cos(t), CRANK * math.sin(t), HEIGHT), (1, ROCKER * math.cos(p), ROCKER * math.sin(p))], drawn

    def pixels(self):
        """How many pixels of the panel's picture are green (the rocker), brown (the ball about A), orange (the effector)."""
        return self.run_js(
            """(() => {
          const from = corank.panel.picture.orbit.renderer.domElement, canvas = document.createElement("canvas");
          [canvas.width, canvas.height] = [from.width, from.height];
          const context = canvas.getContext("2d");
          context.drawImage(from, 0, 0);
          const {data} = context.getImageData(0, 0, canvas.width, canvas.height);
          const counts = {green: 0, brown: 0, orange: 0};
          for (let i = 0; i < data.length; i += 4) {
            const [r, g, b, a] = data.slice(i, i + 4);
            if (a < 200) continue;
            if (g > r + 30 && g > b + 10) ++counts.green;
            if (r > 1.7 * g && r > 2 * b && g < 110) ++counts.brown;
            if (r > 150 && g > 0.5 * r && g < 0.8 * r && b < 0.5 * g) ++counts.orange;
          }
          return counts;
        })()"""
        )

    def test_is_drawn_in_space_in_the_colours_of_its_parts(self):
        self.pin("cspace", 500)
        self.assertEqual(self.run_js("document.querySelectorAll('.solid canvas').length"), 2)
        self.assertEqual(self.run_js("document.querySelectorAll('svg .link, svg .platform').length"), 0)
        self.assertEqual(
            self.run_js("[...document.querySelectorAll('#panel .point-label')].map((t) => t.textContent).sort().join('')"),
            "ABCO",
        )
        counts = self.pixels()
        for colour in ("green", "brown", "orange"):
            self.assertGreater(counts[colour], 40, (colour, counts))
        meshes = self.run_js(
            """(() => {
          const kinds = {};
          corank.panel.picture.orbit.scene.traverse((o) => { if (o.isMesh && o.visible) kinds[o.geometry.type] = (kinds[o.geometry.type] || 0) + 1; });
          return kinds;
        })()"""
        )
        # Ends of three links, the sphere, two ball joints, the effector and its halo; links, the cylinder, hinges, pedestals' feet and plates.
        self.assertEqual(meshes["SphereGeometry"], 6 + 1 + 2 + 2)
        self.assertEqual(meshes["CylinderGeometry"], 3 + 1 + 2 * 3 + 2 * 2)

    def test_follows_what_is_picked(self):
        seen = []
        for box in (0, 300, 700):
            self.pin("cspace", box)
            expected, drawn = self.ends()
            for a, b in zip(expected, drawn):
                self.assertLess(math.dist(a, b), 1e-6)
            self.assertAlmostEqual(math.dist(*expected), ROD, delta=1e-6)
            seen.append(tuple(drawn[1]))
        self.assertEqual(len(set(seen)), 3)

    def test_an_arrow_shows_how_the_rocker_moves_with_the_motor_locked(self):
        self.pin("forward", 0)
        arrows = self.run_js(
            "corank.panel.picture.velocities.map((v, i) => v && {name: corank.model.drawing.points[i].name, v: v.toArray()}).filter(Boolean)"
        )
        self.assertEqual([arrow["name"] for arrow in arrows], ["B"])
        a, b = self.ends()[0]
        along = sum(v * (y - x) for v, x, y in zip(arrows[0]["v"], a, b))
        self.assertAlmostEqual(along, 0, delta=1e-6)
        self.pin("cspace", 10)
        self.assertEqual(self.run_js("corank.panel.picture.velocities.filter(Boolean).length"), 0)

    def test_turns_zooms_and_comes_back(self):
        self.pin("cspace", 500)
        x, y = self.middle("#panel .solid canvas")
        eye = "corank.panel.picture.orbit.camera.position.toArray()"
        first = self.run_js(eye)
        self.run_js("document.activeElement.blur()")
        self.browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-20)
        self.browser.drawn()
        self.assertEqual(self.run_js(eye), first, "the wheel scrolls the page before the picture is taken hold of")
        x, y = self.middle("#panel .solid canvas")
        self.browser.drag(x, y, 90, 30)
        self.browser.drawn()
        self.assertGreater(math.dist(self.run_js(eye), first), 0.1)
        far = math.hypot(*self.run_js(eye))
        self.browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-240)
        self.browser.drawn()
        self.assertLess(math.hypot(*self.run_js(eye)), far)
        self.browser.click(*self.middle("#panel .solid .reset"))
        self.assertLess(math.dist(self.run_js(eye), first), 1e-9)
        self.run_js("document.querySelector('#panel .solid').focus()")
        self.browser.press("ArrowLeft")
        self.assertGreater(math.dist(self.run_js(eye), first), 0.1)

    def test_plays_the_whole_motion_in_order(self):
        self.pin("cspace", 500)
        self.browser.click(*self.middle(".player .play"))
        start = self.angles()
        self.run_js(
            "new Promise((done) => { const look = () => corank.panel.player.t > 0.1 ? done() : setTimeout(look, 20); look(); })"
        )
        self.assertGreater(math.dist(self.angles(), start), 0.01)
        self.pin("cspace", 500)
        self.assertFalse(self.run_js("corank.panel.player.playing"), "a pick stops the motion")
        curve = self.run_js(
            """(() => {
          const {curve} = corank.panel.player, set = corank.model.sets[0];
          const ways = Array.from({length: 200}, (_, k) => curve.at((k * curve.length) / 199));
          return {closed: curve.closed, boxes: new Set(curve.boxes).size, count: set.count, found: ways.every(({moved}) => moved),
                  steps: ways.slice(1).map(({x}, k) => Math.hypot(...[0, 1, 2, 3].map((j) => x[j] - ways[k].x[j])))};
        })()"""
        )
        self.assertTrue(curve["closed"])
        self.assertEqual(curve["boxes"], curve["count"], "every box is on the way, once")
        self.assertTrue(curve["found"])
        self.assertLess(max(curve["steps"]), 2 * min(curve["steps"]), "an even motion")

    def test_isolated_singularities_do_not_play(self):
        self.pin("forward", 0)
        self.assertTrue(self.run_js("document.querySelector('.player').hidden"))

    def test_the_dark_theme_paints_anew(self):
        self.pin("cspace", 500)
        joint = "getComputedStyle(document.querySelector('.solid')).getPropertyValue('--link-solid').trim()"
        light, scene = self.run_js(joint), self.run_js("corank.panel.picture.orbit.scene.uuid")
        self.run_js("document.getElementById('theme').click()")
        self.browser.drawn()
        self.assertNotEqual(self.run_js(joint), light)
        self.assertNotEqual(self.run_js("corank.panel.picture.orbit.scene.uuid"), scene)
        self.assertGreater(self.pixels()["green"], 40)
        self.run_js("document.getElementById('theme').click()")

    def test_without_webgl_it_is_drawn_flat(self):
        with chromium.Browser(1360, 1000, flags=["--disable-3d-apis"]) as browser:
            browser.open(page_case.PAGE)
            browser.drawn()
            self.assertEqual(browser.run("document.querySelectorAll('.solid').length"), 0)
            for kind, count in ((".link", 3), (".ball", 2), (".hinge", 2), (".sphere", 1), (".cylinder", 1)):
                self.assertEqual(browser.run(f"document.querySelectorAll('#panel svg {kind}').length"), count, kind)
            self.assertEqual(browser.messages, [])


if __name__ == "__main__":
    page_case.main()
