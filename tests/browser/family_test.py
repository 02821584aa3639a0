"""A family of Dextars in a browser: python3 family_test.py FAMILY/index.html. Exit status 77 where there is no Chromium.

l2 = 1.6, 1.3667, 1.1333, 0.9; l3 = l4 = l5 = 0.9, J1 = (1.18, 0): J3 comes no nearer to J1 than l2 - 0.9.
"""
import math

import page_case

BASE, MEMBERS = 1.18, 4
HOLES = [0.7 * (1 - k / 3) for k in range(MEMBERS)]


class Family(page_case.PageCase):
    def setUp(self):
        self.run_js("corank.family.choose(0)")

    def current(self):
        """What every part of the page says is shown; they have to agree."""
        state = self.run_js(
            """(() => ({
          family: corank.family.current,
          slider: Number(document.getElementById("slider").value),
          small: [...document.querySelectorAll("#small .member")].findIndex((b) => b.ariaPressed === "true"),
          row: [...document.querySelectorAll("#counts tbody tr")].findIndex((r) => r.classList.contains("current")),
          cards: [...document.querySelectorAll("#result .cards")].findIndex((c) => !c.hidden),
        }))()"""
        )
        self.assertEqual(len(set(state.values())), 1, state)
        return state["family"]

    def inked(self, x, y):
        """How many pixels about (x, y) of the large picture are not its paper."""
        return self.run_js(
            f"""(() => {{
          const {{canvas, pictures, current}} = corank.family, {{plane, ratio}} = pictures[current];
          const at = [plane.toX({x}) * ratio, plane.toY({y}) * ratio].map(Math.round);
          const {{data}} = canvas.getContext("2d").getImageData(at[0] - 2, at[1] - 2, 5, 5);
          let count = 0;
          for (let i = 0; i < data.length; i += 4) count += Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40;
          return count;
        }})()"""
        )

    def test_arrow_keys_move_the_slider_and_all_that_belongs_to_it(self):
        self.run_js("document.getElementById('slider').focus()")
        self.assertEqual(self.current(), 0)
        self.browser.press("ArrowRight")
        self.assertEqual(self.current(), 1)
        self.assertIn("2 of 4", self.run_js("document.getElementById('slider').getAttribute('aria-valuetext')"))
        self.browser.press("End")
        self.assertEqual(self.current(), MEMBERS - 1)
        self.assertEqual(self.run_js("document.querySelector('#large .value').textContent"), "l2 = 0.9")
        self.browser.press("ArrowRight")
        self.assertEqual(self.current(), MEMBERS - 1)
        self.browser.press("ArrowLeft")
        self.assertEqual(self.current(), MEMBERS - 2)
        self.browser.press("Home")
        self.assertEqual(self.run_js("document.querySelector('#large .value').textContent"), "l2 = 1.6")

    def test_the_slider_follows_the_pointer(self):
        x, y = self.middle("#slider")
        width = self.run_js("document.getElementById('slider').getBoundingClientRect().width")
        self.browser.drag(x - width / 2 + 8, y, width - 16, 0)
        self.assertEqual(self.current(), MEMBERS - 1)

    def test_small_pictures_are_chosen_by_click_and_by_key(self):
        self.browser.click(*self.middle("#small .member:nth-child(3)"))
        self.assertEqual(self.current(), 2)
        self.browser.press("ArrowLeft")
        self.assertEqual(self.current(), 1)
        self.assertEqual(self.run_js("document.activeElement.dataset.member"), "1")

    def test_all_pictures_have_the_same_axes(self):
        limits = self.run_js("corank.family.pictures.map(({limits}) => limits)")
        self.assertEqual(len(limits), MEMBERS)
        for each in limits:
            self.assertEqual(each, limits[0])
        sizes = self.run_js("[...document.querySelectorAll('#small canvas')].map((c) => [c.width, c.height])")
        self.assertEqual(sizes, [sizes[0]] * MEMBERS)

    def test_no_box_lies_over_the_hole_and_the_locus_on_its_rim(self):
        for member, hole in enumerate(HOLES):
            self.run_js(f"corank.family.choose({member})")
            for k in range(36):
                t = math.pi * (k + 0.5) / 18
                x, y = BASE + hole * math.cos(t), hole * math.sin(t)
                if math.hypot(x, y) < 1.79:
                    near = self.run_js(f"corank.family.pictures[{member}].near('inverse', {x}, {y}, 1e-6).length")
                    self.assertGreater(near, 0, f"no inverse singularity drawn at {(x, y)} of member {member}")
                x, y = BASE + (hole - 0.2) * math.cos(t), (hole - 0.2) * math.sin(t)
                if hole > 0.2:
                    over = self.run_js(f"corank.family.pictures[{member}].boxesOver('cspace', {x}, {y})")
                    self.assertEqual(over, 0, f"({x}, {y}) is out of reach of member {member}")

    def test_the_hole_shrinks_to_a_point_in_the_picture(self):
        rim = BASE + HOLES[0] * math.cos(1.4), HOLES[0] * math.sin(1.4)
        self.assertEqual(self.inked(BASE, 0), 0)
        self.assertGreater(self.inked(*rim), 0)
        self.run_js(f"corank.family.choose({MEMBERS - 1})")
        self.assertGreater(self.inked(BASE, 0), 0)
        self.assertEqual(self.inked(*rim), 0)

    def test_a_folded_arm_over_one_point_is_marked(self):
        spots = self.run_js("corank.family.spots")
        for member, own in enumerate(spots):
            places = {(round(spot["x"], 2), round(spot["y"], 2)) for spot in own}
            expected = {(0.0, 0.0)}  # J3 on J5, where l4 = l5
            if HOLES[member] == 0:
                expected.add((BASE, 0.0))
            self.assertEqual({(x + 0.0, y + 0.0) for x, y in places}, expected)

    def test_sets_can_be_hidden(self):
        self.assertGreater(self.inked(BASE - HOLES[0], 0), 0)
        self.browser.click(*self.middle("input.toggle[value=inverse]"))
        self.browser.drawn()
        self.assertEqual(self.inked(BASE - HOLES[0], 0), 0)
        self.browser.click(*self.middle("input.toggle[value=inverse]"))
        self.browser.drawn()
        self.assertGreater(self.inked(BASE - HOLES[0], 0), 0)

    def test_the_theme_changes_and_draws_anew(self):
        pixel = "[...corank.family.canvas.getContext('2d').getImageData(corank.family.canvas.width - 30, 30, 1, 1).data]"
        light = self.run_js(pixel)
        self.browser.click(*self.middle("#theme"))
        self.assertEqual(self.run_js("document.documentElement.dataset.theme"), "dark")
        self.assertLess(sum(self.run_js(pixel)[:3]), sum(light[:3]))
        self.browser.click(*self.middle("#theme"))


if __name__ == "__main__":
    page_case.main()
