"""A PUMA's report in a browser: python3 arm_test.py REPORT/index.html. Exit status 77 where there is no Chromium.

Its inverse singularities in the plane of its arm, y = -d3, are the union of surfaces, in one of which sin(theta5) = 0.
"""
import page_case


class Arm(page_case.PageCase):
    def test_portraits_begin_with_coordinates_that_move(self):
        axes = self.run_js("corank.portraits[0].picture.axes.map((axis) => axis.name)")
        self.assertEqual(axes, ["hand_x", "hand_z"])

    def test_a_point_is_found_in_every_box(self):
        found = self.run_js(
            """(() => {
          const [set] = corank.model.sets;
          return Array.from({length: 100}, (_, t) => {
            corank.panel.pinBox(set, Math.floor((t * set.count) / 100));
            return corank.panel.current.moved;
          });
        })()"""
        )
        self.assertEqual(found, [True] * 100)

    def test_a_configuration_is_on_the_part_that_its_box_is_of(self):
        worst = self.run_js(
            """(async () => {
          const [set] = corank.model.sets, conditions = new Set(), worst = [0, 0];
          for (let t = 0; t < 100; ++t) {
            const box = Math.floor((t * set.count) / 100);
            corank.panel.pinBox(set, box);
            const {x} = corank.panel.current, value = (monomials) =>
              monomials.reduce((sum, [a, ...factors]) => {
                for (let k = 0; k < factors.length; k += 3) a *= x[factors[k]] ** factors[k + 1];
                return sum + a;
              }, 0);
            conditions.add(set.parts[box]);
            for (const f of set.conditions.equations[set.parts[box]]) worst[0] = Math.max(worst[0], Math.abs(value(f)));
          }
          return [worst[0], conditions.size, set.conditions.equations.every((list) => list.length > 0)];
        })()"""
        )
        self.assertLess(worst[0], 1e-9)
        self.assertGreater(worst[1], 1, "parts")
        self.assertTrue(worst[2])


if __name__ == "__main__":
    page_case.main()
