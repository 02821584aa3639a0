"""The page of two configurations of Dextar that no path joins: python3 apart_test.py PATH.html. Exit status 77 where there is no Chromium."""
import page_case


class ApartPage(page_case.PageCase):
    def test_both_configurations_are_drawn_and_differ(self):
        drawn = self.run_js(
            "[...document.querySelectorAll('#panel .picture svg')].map((svg) => svg.querySelectorAll('.joint').length)"
        )
        self.assertEqual(drawn, [5, 5])
        self.assertEqual(self.run_js("document.querySelectorAll('.player').length"), 0)
        self.assertNotEqual(
            *self.run_js("[...document.querySelectorAll('#panel .picture svg')].map((svg) => svg.innerHTML)")
        )

    def test_the_signs_that_differ_stand_out(self):
        rows = self.run_js(
            "[...document.querySelectorAll('.signs tr.unlike')].map((r) => [...r.querySelectorAll('td')].map((d) => d.textContent))"
        )
        self.assertGreaterEqual(len(rows), 1)
        for a, b in rows:
            self.assertEqual({a, b}, {"+", "−"})

    def test_the_ends_lie_in_both_portraits(self):
        inside = self.run_js(
            """corank.show.portraits.map(({picture}) => corank.show.ends.every((x) =>
          picture.plane.holds(picture.axes.map((c) => c.cosine === undefined ? x[c.index] : Math.atan2(x[c.sine], x[c.cosine])))))"""
        )
        self.assertEqual(inside, [True, True])


if __name__ == "__main__":
    page_case.main()
