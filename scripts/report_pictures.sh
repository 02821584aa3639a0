#!/bin/bash
# Makes doc/images/ anew: photographs of Dextar's report, of its family's page, of a path's page, of the report of the tutorial on parts, and of five
# robots in the studio, in a headless Chromium.
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
build_release "" corank
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$build/app/corank" report "$root/models/dextar.cuik" -o "$work"
"$build/app/corank" path "$root/models/dextar.cuik" --from J3x=0.5,J3y=1 --from-mode 1 --to J3x=0.7,J3y=1 --to-mode 3 --report "$work/path.html"
"$build/app/corank" sweep "$root/models/dextar.cuik" -D l2=1.6:0.9:8 -o "$work/family"
(cd "$work" && PATH="$build/app:$PATH" bash -euc "$(sed -n '/^```sh$/,/^```$/{/^```/!p}' "$root/doc/tutorial_parts.md")")
PYTHONPATH="$root/tests/browser" python3 -B - "$work/index.html" "$root/doc/images" <<'PYTHON'
import pathlib
import sys

from chromium import Browser

page, folder = sys.argv[1], pathlib.Path(sys.argv[2])
folder.mkdir(exist_ok=True)
with Browser(1240, 1000) as browser:
    browser.open(page)
    browser.drawn()
    browser.photograph(".stage", folder / "dextar_report.png")
    browser.photograph("#space .frame", folder / "dextar_space.png")
    browser.open(pathlib.Path(page).parent / "family/index.html")
    browser.run("corank.family.choose(2)")
    browser.drawn()
    browser.photograph(".family-stage", folder / "dextar_family.png")
    browser.open(pathlib.Path(page).parent / "path.html")
    browser.run("corank.show.player.seek(0.3 * corank.show.curve.length)")
    browser.drawn()
    browser.photograph(".stage", folder / "dextar_path.png")
    browser.open(pathlib.Path(page).parent / "five_bar/index.html")
    browser.drawn()
    browser.photograph(".stage", folder / "five_bar_parts.png")
PYTHON
PYTHONPATH="$root/tests/browser:$root/tests/studio" python3 -B - "$build/app/corank" "$root/models" "$root/doc/images" <<'PYTHON'
import pathlib
import sys

from chromium import Browser
from running import Studio

program, models, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
done = """new Promise((done) => {
  const look = () => (corank.studio.ended && !document.querySelector("#space.waiting") ? setTimeout(done, 500) : setTimeout(look, 100));
  look();
})"""
for name, dark in (("dextar", False), ("planar/3rpr", False), ("platforms/stewart", False), ("serial/orthogonal_3r", True),
                   ("planar/four_bar_crank_rocker", False)):
    with Studio(program, str(models / f"{name}.cuik")) as studio, Browser(1440, 900, dark=dark) as browser:
        browser.go(studio.address)
        browser.run(done)
        browser.drawn()
        short = pathlib.Path(name).name.replace("_crank_rocker", "")
        browser.screenshot(folder / f"studio_{short}.webp")
PYTHON
