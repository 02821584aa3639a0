"""The studio's sets, sliders, text, files and reports."""
import json

import running
from studio_case import MODELS, StudioCase, main

# A planar four-bar linkage, whose input meets two forward singularities.
FOUR_BAR = """
[LINKS]
ground : point A (0, 0, 0) point D (4, 0, 0)
crank : point A (0, 0, 0) point B (2, 0, 0)
coupler : point B (0, 0, 0) point C (2.5, 0, 0)
rocker : point C (0, 0, 0) point D (3, 0, 0)
[JOINTS]
revolute a : ground A + (0, 0, 1) crank A + (0, 0, 1) actuated
revolute b : crank B + (0, 0, 1) coupler B + (0, 0, 1)
revolute c : coupler C + (0, 0, 1) rocker C + (0, 0, 1)
revolute d : ground D + (0, 0, 1) rocker D + (0, 0, 1)
"""


class Design(StudioCase):
    def test_shows_every_set_complete(self):
        sets = self.js("corank.studio.model.sets.map(({name, count, complete}) => [name, count > 0, complete])")
        self.assertEqual(
            sets,
            [["cspace", True, True], ["forward", True, True], ["inverse", True, True], ["cspace-singular", False, True]],
        )
        self.assertIn("every solution is in a box", self.js("document.getElementById('status').textContent"))
        # J2, J3, J4 in a row over (0, 0): the locus passes where the picture says.
        self.assertGreater(self.js("corank.studio.sights.views[0][1].picture.boxesOver('cspace', 0.59, 1.2)"), 0)
        self.assertEqual(self.js("corank.studio.sights.views[0][1].picture.boxesOver('cspace', 0.59, 1.9)"), 0)

    def test_finer_boxes_come_where_they_are_wanted(self):
        coarse = self.js("corank.studio.model.sets.map(({count}) => count)")
        self.js("document.querySelector('#sets .fine').click()")
        self.settle()
        fine = self.js("corank.studio.model.sets.map(({count}) => count)")
        for few, many in zip(coarse[:3], fine):
            self.assertGreater(many, few)

    def test_asks_its_own_server_only_and_throws_nothing(self):
        own = (f"http://127.0.0.1:{self.studio.port}/", "data:", "blob:")
        self.assertEqual([url for url in self.browser.requests if not url.startswith(own)], [])
        self.assertEqual(self.browser.messages, [])

    def test_an_error_is_shown_at_its_line_as_one_types(self):
        text = self.js("corank.studio.editor.text")
        lines = text.split("\n")
        line = next(k for k, words in enumerate(lines) if words.startswith("J3x ="))
        lines[line] = lines[line].replace("l3", "l33")
        self.type("\n".join(lines))
        self.until("s.editor.error")
        self.assertEqual(self.js("corank.studio.editor.error.line"), line + 1)
        self.assertIn("l33", self.js("document.getElementById('problem').textContent"))
        self.assertEqual(self.js("document.querySelector('.gutter b').textContent"), str(line + 1))
        self.js("document.getElementById('problem').click()")
        start = self.js("document.getElementById('text').selectionStart")
        self.assertEqual("\n".join(lines)[:start].count("\n"), line)
        self.type(text)
        self.until("!s.editor.error")
        self.settle()
        self.assertFalse(self.js("document.body.classList.contains('broken')"))

    def test_a_models_text_is_text_whatever_it_looks_like(self):
        self.type('% <img src=x onerror="corank.harm = true">\n' + self.js("corank.studio.editor.text"))
        self.settle()
        self.assertIsNone(self.js("corank.harm ?? null"))
        self.assertIn("<img", self.js("document.querySelector('.shown').textContent"))

    def test_no_picture_is_stale_while_a_slider_moves(self):
        pictures = self.js(
            """(async () => {
          const s = corank.studio, {slider} = s.sliders.rows.get("l2"), seen = [], {sights} = s, draw = sights.draw;
          sights.draw = function (model) {
            draw.call(sights, model);
            seen.push({shown: s.shown.number, newest: s.link.number, value: s.shown.constants.l2, asked: s.asked.request.constants.l2});
          };
          for (let k = 0; k < 90; ++k) {
            slider.value = 300 + 250 * Math.sin(k / 12);
            slider.dispatchEvent(new Event("input"));
            await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
          }
          delete sights.draw;
          return seen;
        })()"""
        )
        self.settle()
        self.assertGreater(len(pictures), 0)
        for picture in pictures:
            self.assertEqual(picture["shown"], picture["newest"])
            self.assertEqual(picture["value"], picture["asked"])
        shown, wanted = self.js("[corank.studio.shown.constants, corank.studio.design.now.constants]")
        self.assertEqual(shown, wanted)
        # C-space of the robot that the slider ends at: both arms stretched.
        l2 = float(shown["l2"])
        self.assertAlmostEqual(self.js("corank.studio.constants.find((c) => c.name === 'l2').value"), l2, delta=1e-12)
        self.assertEqual(len(self.studio.children()), 1)
        self.assertLess(running.resident(self.studio.children()[0]), 1 << 30)

    def test_tolerances_and_ranges_of_constants(self):
        self.js(
            """(() => {
          const {tolerance, low, high} = corank.studio.sliders.rows.get("d");
          tolerance.value = "0.001"; tolerance.dispatchEvent(new Event("change"));
          low.value = "1"; low.dispatchEvent(new Event("change"));
          high.value = "1.5"; high.dispatchEvent(new Event("change"));
        })()"""
        )
        self.settle()
        self.assertEqual(self.js("corank.studio.design.now.constants"), {"d": "1.18±0.001"})
        self.slide("d", 500)
        self.settle()
        self.assertEqual(self.js("corank.studio.design.now.constants"), {"d": "1.25±0.001"})
        self.assertIn("'d=1.25±0.001'", self.js("corank.studio.command()"))

    def test_undo_and_redo(self):
        before = self.js("corank.studio.editor.text")
        self.type(before.replace("d := 1.18", "d := 1.3"))
        self.settle()
        self.slide("l2", 600)
        self.settle()
        self.js("document.getElementById('undo').click()")
        self.assertEqual(self.js("corank.studio.design.now.constants"), {})
        self.js("document.getElementById('undo').click()")
        self.settle()
        self.assertEqual(self.js("corank.studio.editor.text"), before)
        self.js("document.getElementById('redo').click()")
        self.js("document.getElementById('redo').click()")
        self.settle()
        self.assertIn("d := 1.3", self.js("corank.studio.editor.text"))
        self.assertIn("l2", self.js("corank.studio.shown.constants"))

    def test_sets_are_switched_on_and_off(self):
        self.js("document.querySelector('#sets input[value=cspace]').click()")
        self.settle()
        self.assertEqual(
            self.js("corank.studio.model.sets.map(({name}) => name)"), ["forward", "inverse", "cspace-singular"]
        )
        self.js("document.querySelector('#sets input[value=\"forward-nodes\"]').click()")
        self.settle()
        self.assertIn("forward-nodes", self.js("corank.studio.model.sets.map(({name}) => name)"))
        self.assertEqual(
            self.js("corank.studio.command()"),
            "corank report dextar.cuik --sets forward,inverse,cspace-singular,forward-nodes",
        )

    def test_aspects_in_colour(self):
        self.colour("aspects")
        self.settle()
        self.assertEqual(self.js("corank.studio.model.aspects.labels.length"), 10)
        self.assertEqual(self.js("document.querySelectorAll('#portraits input.aspect').length"), 10)

    def colour(self, by):
        self.js(
            f"""(() => {{
          const select = document.querySelector("#sets .colours");
          select.value = {by!r};
          select.dispatchEvent(new Event("change", {{bubbles: true}}));
        }})()"""
        )

    def test_an_error_of_a_requirement_is_told(self):
        self.js("corank.studio.design.change('require', {require: ['amplification(speed) <= 2']})")
        self.until("s.editor.error")
        self.assertEqual(self.js("corank.studio.editor.error.line"), 0)
        self.assertIn("requirement: found 'speed'", self.js("document.getElementById('problem').textContent"))

    def test_requirements_are_shaded(self):
        self.js(
            """(() => {
          const field = document.getElementById("require");
          field.value = "J3y >= 0; J3x <= 3";
          field.dispatchEvent(new Event("change"));
        })()"""
        )
        self.colour("requirements")
        self.settle()
        wrong = self.js(
            """(() => {
          const {set, of, labels} = corank.studio.model.aspects, y = set.variables.indexOf("J3y"), wrong = [];
          const counts = {"met": 0, "not met": 0, "open": 0};
          for (let box = 0; box < set.count; ++box) {
            const label = labels[of[box] - 1], met = set.lower(box, y) >= 0, violated = set.upper(box, y) < 0;
            ++counts[label];
            if ((violated && label === "met") || (met && label === "not met")) wrong.push(box);
          }
          return {wrong, counts};
        })()"""
        )
        self.assertEqual(wrong["wrong"], [])
        self.assertGreater(wrong["counts"]["met"], 0)
        self.assertGreater(wrong["counts"]["not met"], 0)
        self.assertIn("--require 'J3y >= 0' --require 'J3x <= 3'", self.js("corank.studio.command()"))
        self.assertIn("requirements", self.js("corank.studio.model.sets.map(({name}) => name)"))

    def test_what_is_shared_opens_as_it_was(self):
        self.slide("l2", 700)
        self.settle()
        shared = self.js(
            """(async () => {
          const make = URL.createObjectURL;
          let blob;
          URL.createObjectURL = (file) => make.call(URL, (blob = file));
          document.getElementById("share").click();
          URL.createObjectURL = make;
          return blob.text();
        })()"""
        )
        constants = self.js("corank.studio.design.now.constants")
        self.js("document.getElementById('reset').click()")
        self.settle()
        self.js(f"corank.studio.take([new File([{json.dumps(shared)}], 'dextar.studio.json')])")
        self.until("Object.keys(s.design.now.constants).length > 0")
        self.settle()
        self.assertEqual(self.js("corank.studio.shown.constants"), constants)

    def test_a_report_of_what_is_seen(self):
        self.js("document.querySelector('#sets input[value=cspace]').click()")
        self.slide("l2", 700)
        self.settle()
        html = self.js(
            """(async () => {
          const make = URL.createObjectURL;
          const file = await new Promise((found) => {
            URL.createObjectURL = (blob) => (found(blob), make.call(URL, blob));
            document.getElementById("report").click();
          });
          URL.createObjectURL = make;
          return file.text();
        })()"""
        )
        self.settle()
        value = self.js("corank.studio.design.now.constants.l2")
        self.assertIn(f"corank report dextar.cuik --sets forward,inverse,cspace-singular -D l2={value}", html)
        self.assertIn('id="boxes-forward"', html)

    def drop(self, files):
        self.js(
            f"""(() => {{
          const data = new DataTransfer();
          for (const [name, text] of Object.entries({json.dumps(files)})) data.items.add(new File([text], name));
          document.body.dispatchEvent(new DragEvent("drop", {{dataTransfer: data, bubbles: true, cancelable: true}}));
        }})()"""
        )
        self.until(f"s.design.now.file === {next(iter(files))!r}")
        self.settle()
        self.assertIsNone(self.js("corank.studio.editor.error ?? null"))
        self.assertGreater(self.js("corank.studio.model.sets.find(({name}) => name === 'forward').count"), 0)

    def test_a_urdf_file_with_its_companion_is_dropped(self):
        folder = MODELS.parent / "tests" / "data" / "urdf"
        self.drop({name: (folder / name).read_text(encoding="utf-8") for name in ("five_bar.urdf", "five_bar.loops")})
        self.assertTrue(self.js("corank.studio.command()").startswith("corank report five_bar.urdf --loops five_bar.loops"))

    def test_a_world_is_dropped(self):
        self.drop({"four_bar.world": FOUR_BAR})
        self.assertTrue(self.js("corank.studio.command()").startswith("corank report four_bar.world"))

    def test_everything_that_is_operated_has_a_name(self):
        nameless = self.js(
            """[...document.querySelectorAll("button, input, select, textarea, [tabindex], [role]")]
          .filter((e) => e.type !== "file" && !e.closest("[hidden]"))
          .filter((e) => !(e.getAttribute("aria-label") || e.getAttribute("aria-labelledby") || e.labels?.length || e.title ||
            e.textContent.trim() || ["toolbar", "status", "group", "alert"].includes(e.getAttribute("role"))))
          .map((e) => e.outerHTML.slice(0, 120))"""
        )
        self.assertEqual(nameless, [])

    def test_files_that_are_no_models_are_refused(self):
        self.js("corank.studio.take([new File(['x'], 'a.txt')])")
        self.until("s.editor.error")
        self.assertIn("expected a file that ends in", self.js("document.getElementById('problem').textContent"))


if __name__ == "__main__":
    main()
