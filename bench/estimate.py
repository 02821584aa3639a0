#!/usr/bin/env python3
"""Compares what `corank solve --estimate` predicts with what `corank solve` then does.

Usage: bench/estimate.py [--program CORANK] [--threads N] [WORD]: only lines that contain WORD. Ratios are predicted ÷ real.
"""

import argparse
import json
import os
import subprocess
import tempfile
import time

LINES = [
    ("three_slider", "forward", 1e-6),
    ("dextar", "forward", 0.1),
    ("dextar", "forward", 0.01),
    ("dextar", "forward", 0.001),
    ("dextar", "inverse", 0.1),
    ("dextar", "inverse", 0.01),
    ("dextar", "inverse", 0.001),
    ("dextar", "cspace", 0.2),
    ("dextar", "cspace", 0.1),
    ("dextar", "cspace", 0.05),
    ("dextar", "cspace", 0.01),
    ("3rrr_fixed_orientation", "forward", 0.1),
    ("3rrr_fixed_orientation", "forward", 0.01),
    ("3rrr", "forward", 0.4),
]


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(here, "..", "build", "release", "app", "corank"))
    parser.add_argument("--threads", default="1")
    parser.add_argument("word", nargs="?", default="")
    args = parser.parse_args()
    print(f"{'problem':36}{'processed':>22}{'boxes':>22}{'seconds':>20}{'file MB':>16}{'memory MB':>24}   trial")
    for model, which, sigma in LINES:
        name = f"{model} {which} {sigma:g}"
        if args.word not in name:
            continue
        base = [
            args.program,
            "solve",
            os.path.join(here, "..", "models", model + ".cuik"),
            "--set",
            which,
            "--sigma",
            str(sigma),
            "--threads",
            args.threads,
            "--json",
        ]
        begun = time.monotonic()
        guess = json.loads(subprocess.run(base + ["--estimate"], check=True, capture_output=True).stdout)
        trial = time.monotonic() - begun
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "r.h5")
            said = os.path.join(folder, "said")
            with open(said, "w") as out:
                solving = subprocess.Popen(base + ["-o", path], stdout=out, stderr=subprocess.DEVNULL)
                _, status, used = os.wait4(solving.pid, 0)
            if status != 0:
                raise SystemExit(f"{name}: corank solve ended with {status}")
            with open(said) as out:
                real = json.load(out)
            size = os.path.getsize(path)

        counts = real["boxes"]
        processed = counts["processed"]
        boxes = sum(count for verdict, count in counts.items() if verdict != "processed")

        def pair(key, value, unit=1.0):
            likely = guess[key]["likely"]
            return f"{likely / unit:.3g} : {value / unit:.3g} = {likely / value:.2f}" if value else "-"

        print(
            f"{name:36}{pair('processed', processed):>22}{pair('boxes', boxes):>22}"
            f"{pair('seconds', real['seconds']['total']):>20}{pair('file_bytes', size, 1e6):>16}"
            f"{pair('memory_bytes', 1024 * used.ru_maxrss, 1e6):>24}   {trial:.1f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
