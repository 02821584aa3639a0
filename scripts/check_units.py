#!/usr/bin/env python3
"""Asks the same questions of models with all lengths in other units, and compares the answers.

  scripts/check_units.py PROGRAM MODEL... [--scales 1e-3 1e3 1e6] [--time-limit 20]

Each model is derived as equations; in them x/K stands for each coordinate x that is a length, and its range is K times
as large. Compared are, for each scale K: whether solve is complete, and where it is, its boxes by verdict (within 10 %;
points exactly); aspects, assembly and working modes; Euler characteristic and components; processor times.
Prints one line for each difference and one for each model; exit status 1 if any differed.
"""
import argparse
import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

SECTION = re.compile(r"^\[([A-Z ]+)\]", re.M)


def scaled(text, factor):
    """The model with lengths in another unit."""
    parts = SECTION.split(text)
    sections = list(zip(parts[1::2], parts[2::2]))
    lengths = []
    for name, body in sections:
        if name == "SYSTEM VARS":
            lengths += re.findall(r"^\s*(\w+)\s*:", body, re.M)
    if not lengths:
        return None
    names = re.compile(r"\b(" + "|".join(map(re.escape, lengths)) + r")\b")
    result = parts[0]
    for name, body in sections:
        if name == "DRAWING":
            continue
        if name in ("SYSTEM EQS", "VELOCITY EQS"):
            lines = []
            for line in body.split("\n"):
                head, percent, comment = line.partition("%")
                lines.append(names.sub(rf"(\1/({factor}))", head) + percent + comment)
            body = "\n".join(lines)
        elif name in ("SYSTEM VARS", "LIMITS"):
            ranges = re.compile(r"^(\s*(?:" + "|".join(lengths) + r")\s*:\s*)\[([^,\n]+),([^\]\n]+)\]", re.M)
            body = ranges.sub(rf"\1[({factor})*(\2), ({factor})*(\3)]", body)
        result += f"[{name}]{body}"
    return result


def run(program, limit, *arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, *arguments, "--time-limit", str(limit), "--json"], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    try:
        return json.loads(done.stdout), seconds
    except ValueError:
        return {"status": done.returncode}, seconds


def answers(program, model, limit):
    """name -> (what is to be the same, what may differ a little, seconds)"""
    result = {}
    for name in ("forward", "inverse", "cspace"):
        found, seconds = run(program, limit, "solve", model, "--set", name)
        points = found.get("dimension") == 0
        boxes = found.get("boxes", {})
        if not isinstance(boxes, dict):
            boxes = {}
            for box in found.get("boxes", []):
                boxes[box["verdict"]] = boxes.get(box["verdict"], 0) + 1
        same = {"status": found.get("status"), "complete": found.get("complete")}
        complete = found.get("complete")
        if points and complete:
            same["boxes"] = boxes
        result[name] = (same, {} if points or not complete else boxes, seconds)
    found, seconds = run(program, limit, "aspects", model)
    result["aspects"] = ({k: found.get(k) for k in ("status", "aspects", "assembly_modes", "working_modes")}, {}, seconds)
    found, seconds = run(program, limit, "topology", model)
    result["topology"] = ({k: found.get(k) for k in ("status", "components", "euler_characteristic")}, {}, seconds)
    return result


def differences(first, second):
    for name, (same, near, seconds) in first.items():
        other_same, other_near, other_seconds = second[name]
        if same != other_same:
            yield f"{name}: {same} against {other_same}"
        for kind in sorted(set(near) | set(other_near)):
            a, b = near.get(kind, 0), other_near.get(kind, 0)
            if abs(a - b) > 0.1 * max(a, b) + 8:
                yield f"{name}: {a} boxes {kind} against {b}"
        if max(seconds, other_seconds) > 1.5 * min(seconds, other_seconds) + 0.5:
            yield f"{name}: {seconds:.2f} s against {other_seconds:.2f} s"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--scales", nargs="+", default=["1/1000", "1000", "1000000"])
    parser.add_argument("--time-limit", type=float, default=20)
    options = parser.parse_args()
    differing = 0
    with tempfile.TemporaryDirectory() as folder:
        for model in options.models:
            derived = subprocess.run([options.program, "derive", str(model), "--format", "model"], capture_output=True,
                                     text=True)
            if derived.returncode != 0:
                print(f"{model}: not derived: {derived.stderr.strip()[:200]}")
                continue
            first = None
            count = 0
            for scale in ["1", *options.scales]:
                text = scaled(derived.stdout, scale)
                if text is None:
                    break
                path = pathlib.Path(folder) / "model.cuik"
                path.write_text(text)
                found = answers(options.program, str(path), options.time_limit)
                if first is None:
                    first = found
                    continue
                for difference in differences(first, found):
                    print(f"{model}, lengths times {scale}: {difference}", flush=True)
                    count += 1
            print(f"{model}: " + ("no lengths" if first is None else f"{count} differences"), flush=True)
            differing += count > 0
    return differing > 0


if __name__ == "__main__":
    sys.exit(main())
