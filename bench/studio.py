"""From a change to a new picture in the studio: python3 bench/studio.py PROGRAM MODEL CONSTANT LOW HIGH, with tests/browser and
tests/studio in PYTHONPATH. Single changes first, then 30 a second for 10 s. Times in ms, memory of the process that computes in MB."""
import statistics
import sys

import chromium
import running

PROGRAM, MODEL, CONSTANT = sys.argv[1:4]
LOW, HIGH = map(float, sys.argv[4:6])

SETTLE = """new Promise((done) => {
  const s = corank.studio;
  const look = () => s.model && !s.link.waiting && s.ended === s.link.number ? done(s.times.splice(0)) : requestAnimationFrame(look);
  look();
})"""
SLIDE = f"""(async () => {{
  const s = corank.studio, begin = performance.now();
  let changes = 0;
  for (; performance.now() - begin < 10000; ++changes) {{
    const wait = begin + (changes * 1000) / 30 - performance.now();
    if (wait > 0) await new Promise((next) => setTimeout(next, wait));
    s.setConstant({CONSTANT!r}, ({LOW} + {HIGH - LOW} * (0.5 + 0.5 * Math.sin(changes / 12))).toFixed(6));
  }}
  return [changes, s.times.splice(0)];
}})()"""


def row(name, times):
    ninety = sorted(times)[int(0.9 * len(times))]
    print(
        f"{name:24} {len(times):5} pictures, median {statistics.median(times):6.1f}, 90 % {ninety:6.1f}, most {max(times):6.1f}"
    )


with running.Studio(PROGRAM, MODEL) as studio, chromium.Browser(1440, 900) as browser:
    browser.go(studio.address)
    browser.run(SETTLE)
    single = []
    for k in range(25):
        browser.run(f"corank.studio.setConstant({CONSTANT!r}, '{LOW + (HIGH - LOW) * (0.618 * k % 1):.6f}')")
        single += browser.run(SETTLE)
    row("single changes", single)
    before = running.resident(studio.children()[0])
    changes, times = browser.run(SLIDE)
    row(f"{changes} changes in 10 s", times)
    browser.run(SETTLE)
    print(f"memory: {before / 1e6:.0f} before, {running.resident(studio.children()[0]) / 1e6:.0f} after")
