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


if __name__ == "__main__":
    page_case.main()
