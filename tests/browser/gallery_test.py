"""The gallery's page in a browser: python3 gallery_test.py GALLERY/index.html. Exit status 77 where there is no Chromium.

The entries three_slider and alias_3rpr: three robots, and a picture.
"""
import page_case


class Gallery(page_case.PageCase):
    def test_each_robot_is_drawn_at_its_configuration(self):
        parts = self.run_js(
            "[...document.querySelectorAll('svg[data-robot]')].map((svg) => svg.querySelectorAll('*').length)"
        )
        self.assertEqual(len(parts), 3)
        self.assertGreater(min(parts), 8)
        self.assertFalse(self.run_js("document.querySelector('main').innerHTML.includes('NaN')"))

    def test_a_singular_robot_has_an_arrow_and_its_point_moves(self):
        self.assertEqual(self.run_js("document.querySelectorAll('#three_slider svg .velocity').length"), 1)
        self.assertEqual(self.run_js("document.querySelectorAll('#alias_3rpr svg .velocity').length"), 0)

    def test_pictures_are_in_the_page(self):
        sizes = self.run_js("[...document.querySelectorAll('.locus img')].map((image) => image.naturalWidth)")
        self.assertEqual(len(sizes), 1)
        self.assertGreater(sizes[0], 100)

    def test_the_table_has_a_row_for_each_number_and_leads_to_the_entries(self):
        rows = self.run_js("[...document.querySelectorAll('#numbers tbody tr')].map((row) => row.innerText)")
        self.assertEqual(len(rows), 11)
        self.assertTrue(all("proven" in row for row in rows), rows)
        missing = self.run_js(
            "[...document.querySelectorAll('#numbers a')].filter((a) => !document.querySelector(a.hash)).length"
        )
        self.assertEqual(missing, 0)

    def test_the_button_changes_the_theme(self):
        before = self.run_js("getComputedStyle(document.body).backgroundColor")
        self.run_js("document.getElementById('theme').click()")
        self.assertNotEqual(self.run_js("getComputedStyle(document.body).backgroundColor"), before)
        self.run_js("document.getElementById('theme').click()")
        self.assertEqual(self.run_js("getComputedStyle(document.body).backgroundColor"), before)


if __name__ == "__main__":
    page_case.main()
