"""The spherical five-bar's report in a browser: python3 spherical_test.py REPORT/index.html. Exit status 77 where there is no Chromium.

models/spherical_five_bar.cuik: four triangles with a corner in the origin; cos(E1, W) = cos(E2, W) = 5/13.
"""
import math

import page_case


class Spherical(page_case.PageCase):
    def setUp(self):
        if not self.run_js("Boolean(document.createElement('canvas').getContext('webgl2'))"):
            self.skipTest("this browser offers no WebGL")
        self.run_js("corank.panel.pinBox(corank.model.sets.find((s) => s.name === 'forward'), 40)")
        self.browser.drawn()

    def places(self):
        """The points of the drawing as they stand in the scene, in the model's lengths."""
        return self.run_js(
            """(() => {
          const {at, middle, scale} = corank.panel.picture;
          return Object.fromEntries(corank.model.drawing.points.map(({name}, i) => [name, at[i].clone().divideScalar(scale).add(middle).toArray()]));
        })()"""
        )

    def test_platforms_are_translucent_sheets(self):
        sheets = self.run_js(
            """(() => {
          const sheets = [];
          corank.panel.picture.orbit.scene.traverse((o) => {
            if (o.isMesh && o.geometry.type === "BufferGeometry") sheets.push([o.geometry.index.count, o.material.opacity, o.visible]);
          });
          return sheets;
        })()"""
        )
        self.assertEqual(len(sheets), 4)
        for corners, opacity, visible in sheets:
            self.assertEqual((corners, visible), (3, True))
            self.assertTrue(0 < opacity < 1)

    def test_moves_along_the_singular_curve_as_a_rigid_linkage(self):
        seen = set()
        for share in (0, 200, 400, 600, 800):
            self.run_js(
                f"(() => {{ const s = document.querySelector('.player input'); s.value = {share}; s.dispatchEvent(new Event('input')); }})()"
            )
            p = self.places()
            for end in ("E1", "E2"):
                self.assertAlmostEqual(sum(a * b for a, b in zip(p[end], p["W"])), 5 / 13, delta=1e-5)
            # w and both cranks' ends lie in a plane through the origin.
            a, b, c = p["E1"], p["E2"], p["W"]
            volume = sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))
            self.assertAlmostEqual(volume, 0, delta=1e-5)
            seen.add(tuple(round(x, 3) for x in c))
        self.assertEqual(len(seen), 5)

    def test_the_arrow_stands_on_the_last_joint_at_right_angles_to_its_axis(self):
        arrows = self.run_js(
            "corank.panel.picture.velocities.map((v, i) => v && [corank.model.drawing.points[i].name, v.toArray()]).filter(Boolean)"
        )
        self.assertEqual([name for name, _ in arrows], ["W"])
        velocity, w = arrows[0][1], self.places()["W"]
        self.assertGreater(math.hypot(*velocity), 0.1)
        self.assertAlmostEqual(sum(a * b for a, b in zip(velocity, w)), 0, delta=1e-5)

    def test_the_first_picture_turns_too(self):
        self.assertEqual(self.run_js("document.querySelectorAll('#mechanism .solid canvas').length"), 1)
        eye = "corank.hero.orbit.camera.position.toArray()"
        before = self.run_js(eye)
        x, y = self.middle("#mechanism .solid canvas")
        self.browser.drag(x, y, 60, 20)
        self.browser.drawn()
        self.assertNotEqual(self.run_js(eye), before)


if __name__ == "__main__":
    page_case.main()
