"""The colours of aspects in Dextar's report: python3 aspects_test.py REPORT/index.html. Exit status 77 where there is no Chromium.

Its determinants' factors are sin(θ4 − θ3), sin(θ3 − θ2) and sin(θ5 − θ4): an aspect keeps their signs.
"""
import page_case


class AspectColours(page_case.PageCase):
    def setUp(self):
        self.run_js("document.querySelectorAll('input.aspect').forEach((box) => { if (!box.checked) box.click(); })")

    def by_aspect(self, section, on):
        self.run_js(
            f"(() => {{ const box = document.querySelector('#{section} input.by-aspect'); if (box.checked !== {str(on).lower()}) box.click(); }})()"
        )

    def only(self, number):
        self.run_js(
            f"document.querySelectorAll('#space input.aspect').forEach((box) => {{ if ((box.value === '{number}') !== box.checked) box.click(); }})"
        )

    def test_a_box_off_the_loci_has_the_aspect_of_its_signs(self):
        boxes = self.run_js(
            """(() => {
          const {aspects, coordinates} = corank.model, {set} = aspects, found = [];
          const angle = (box, name) => {
            const {cosine, sine} = coordinates.find((c) => c.name === name);
            return Math.atan2(set.middle(box, sine), set.middle(box, cosine));
          };
          for (let box = 0; box < set.count; ++box) {
            const [t2, t3, t4, t5] = ["theta2", "theta3", "theta4", "theta5"].map((name) => angle(box, name));
            found.push([aspects.of[box], Math.sin(t4 - t3), Math.sin(t3 - t2), Math.sin(t5 - t4)]);
          }
          return found;
        })()"""
        )
        labels = self.run_js("corank.model.aspects.labels")
        self.assertEqual(len(labels), 10)
        clear = [(number, signs) for number, *signs in boxes if min(map(abs, signs)) > 0.2]
        self.assertGreater(len(clear), len(boxes) / 3)
        for number, signs in clear:
            self.assertGreater(number, 0)
            self.assertEqual(labels[number - 1].split()[1:], ["+" if s > 0 else "−" for s in signs])
        known = sum(number > 0 for number, *_ in boxes)
        self.assertGreater(known, 0.97 * len(boxes))
        self.assertEqual({number for number, *_ in boxes} - {0}, set(range(1, 11)))

    def test_an_aspect_is_hidden_in_all_pictures_at_once(self):
        self.only(3)
        self.by_aspect("portraits", True)
        self.assertEqual(
            self.run_js("[...document.querySelectorAll('#portraits input.aspect')].map((b) => b.checked).indexOf(true)"), 2
        )
        numbers = self.run_js(
            """(() => {
          const cloud = corank.space.clouds?.find(({set}) => !set.singular);
          return cloud ? [...new Set(Array.from(cloud.owners, (box) => corank.model.aspects.of[box]))] : null;
        })()"""
        )
        self.assertIn(numbers, ([3], None))
        over = self.run_js(
            "corank.portraits[0].picture.candidates([0.6, 0.8]).filter(({set}) => !set.singular).map(({box}) => corank.model.aspects.of[box])"
        )
        self.assertEqual(set(over), {3})
        self.by_aspect("portraits", False)

    def test_a_place_under_one_aspect_has_its_colour_in_the_portrait(self):
        self.by_aspect("portraits", True)
        for number, at in ((1, (-0.2, 0.8)), (3, (0.6, 0.9))):
            self.only(number)
            pixel = self.run_js(
                f"""(() => {{
              const {{base, picture, ratio}} = corank.portraits[0];
              return [...base.getContext("2d").getImageData(picture.plane.toX({at[0]}) * ratio, picture.plane.toY({at[1]}) * ratio, 1, 1).data];
            }})()"""
            )
            colour = self.run_js(f"corank.model.aspects.colours[{number - 1}]")
            wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
            # Over white paper: each channel is as much darker as the colour is, in one proportion.
            shares = [(255 - p) / (255 - w) for p, w in zip(pixel, wanted) if w < 230]
            self.assertGreater(min(shares), 0.3)
            self.assertLess(max(shares) - min(shares), 0.1)
        self.by_aspect("portraits", False)

    def test_a_picked_box_says_its_aspect(self):
        box = self.run_js("corank.model.aspects.of.findIndex((number) => number === 5)")
        self.run_js(f"corank.panel.pinBox(corank.model.aspects.set, {box})")
        self.assertIn("aspect 5", self.run_js("document.querySelector('#panel .headline').textContent"))

    def test_boxes_in_space_take_the_colours_and_lose_them(self):
        if self.run_js("document.getElementById('space').dataset.webgl") == "none":
            self.skipTest("this browser offers no WebGL")
        colours = """(() => {
          const {object} = corank.space.clouds.find(({set}) => !set.singular), tint = object.geometry.attributes.tint;
          return new Set(Array.from({length: tint.count}, (_, i) => [tint.getX(i), tint.getY(i), tint.getZ(i)].join())).size;
        })()"""
        self.by_aspect("space", True)
        self.assertGreaterEqual(self.run_js(colours), 10)
        self.by_aspect("space", False)
        self.assertEqual(self.run_js(colours), 1)
        self.assertTrue(self.run_js("document.querySelector('#space .aspects-legend').hidden"))
        self.by_aspect("space", True)


if __name__ == "__main__":
    page_case.main()
