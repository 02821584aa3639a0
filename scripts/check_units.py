#!/usr/bin/env python3
"""Asks the same questions of models with all lengths in other units, and compares the answers.

  scripts/check_units.py PROGRAM MODEL... [--scales 1/1000 1000 1000000] [--time-limit 10] [--only WORD...]

How lengths are multiplied by K:
- parts: in a robot's links, joints and outputs, each point, length and range of a displacement;
- constants: `-D` of those constants of a model of equations that are lengths (LENGTHS below);
- equations: other models are derived as equations, with x/K in place of each coordinate x that is a length.

Compared are, for each K:
- solve, of each set: whether it is complete, its dimension, its points if it has dimension 0; else its boxes by verdict.
  These may differ by NEAR and FEW, since numbers that are no powers of two round differently, so that a box is bisected
  once more or less; by LARGER where the solutions are a larger set than the equations' count says;
- aspects (with cusps), assembly and working modes; components, Euler characteristic and genus;
- clearance: the radius, within its precision; times K where the ball lies in lengths;
- path: what it finds; on a straight way, its radius and, times K, its radius in lengths;
- map, over two inputs or outputs: the number of cells by what is proven of them;
- processor times, where they are above a second: within 1.5 times.

A question that is not done in the limit of time is named and not compared. Prints a line for each difference and one for
each model; exit status 1 if any differed.
"""
import argparse
import collections
import fractions
import json
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

SECTION = re.compile(r"^[ \t]*\[([A-Z ]+)\]", re.M)
NEAR, FEW = 0.03, 0.005  # of the boxes of one verdict, and of all
LARGER = 0.15  # of the boxes of a larger set than the equations' count says: ranks in doubles decide how far it is divided
LENGTHS = {
    "dextar": ["l", "d"],
    "dextar_limits": ["l", "d"],
    "3rrr": ["b", "p", "l1", "l2"],
    "3rrr_fixed_orientation": ["b", "p", "l1", "l2"],
}


def sections(text):
    parts = SECTION.split(text)
    return parts[0], list(zip(parts[1::2], parts[2::2]))


def scaled_equations(text, factor):
    """A model of equations with lengths in another unit; None where it has no lengths."""
    head, all_sections = sections(text)
    lengths = [x for name, body in all_sections if name == "SYSTEM VARS" for x in re.findall(r"^\s*(\w+)\s*:", body, re.M)]
    if not lengths:
        return None
    names = re.compile(r"\b(" + "|".join(map(re.escape, lengths)) + r")\b")
    result = head
    for name, body in all_sections:
        if name == "DRAWING":
            continue
        if name in ("SYSTEM EQS", "VELOCITY EQS"):
            lines = []
            for line in body.split("\n"):
                equation, percent, comment = line.partition("%")
                lines.append(names.sub(rf"(\1/({factor}))", equation) + percent + comment)
            body = "\n".join(lines)
        elif name in ("SYSTEM VARS", "LIMITS"):
            ranges = re.compile(r"^(\s*(?:" + "|".join(lengths) + r")\s*:\s*)\[([^,\n]+),([^\]\n]+)\]", re.M)
            body = ranges.sub(rf"\1[({factor})*(\2), ({factor})*(\3)]", body)
        result += f"[{name}]{body}"
    return result


def split_at_commas(text):
    """The parts between commas that are in no parentheses."""
    parts, depth, begin = [], 0, 0
    for i, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if c == "," and depth == 0:
            parts.append(text[begin:i])
            begin = i + 1
    return parts + [text[begin:]]


def scaled_points(text, factor):
    """(x, y, z) are points, except behind a plus sign or a colour, and in the two parentheses behind `zero`; of fixed joints
    the translations are lengths."""
    result, i = "", 0
    while i < len(text):
        if text[i] != "(":
            result += text[i]
            i += 1
            continue
        end, depth = i + 1, 1
        while depth:
            depth += (text[end] == "(") - (text[end] == ")")
            end += 1
        inside = split_at_commas(text[i + 1 : end - 1])
        before = result.rstrip()
        translation = re.search(r"\bT(x|y|z|xyz|R)$", before)
        if translation and translation[1] == "R":  # rows with the translation behind the rotation
            rows = [split_at_commas(row) for row in text[i + 1 : end - 1].split(";")]
            scaled_rows = [", ".join([*row[:3], *(f"({factor})*({x})" for x in row[3:])]) for row in rows]
            result += "(" + "; ".join(scaled_rows) + ")"
            i = end
            continue
        direction = before.endswith(("+", "color", "zero")) or re.search(r"zero\s*\([^()]*(\([^()]*\)[^()]*)*\)$", before)
        if translation or (len(inside) == 3 and not direction):
            result += "(" + ", ".join(f"({factor})*({x})" for x in inside) + ")"
        else:
            result += text[i:end]
        i = end
    return result


def scaled_parts(text, factor):
    """A robot in parts with lengths in another unit."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    text = "\n".join(re.split(r"%|//|#", line)[0] for line in text.split("\n"))
    scaled_range = lambda m: f"{m[1]}[({factor})*({m[2]}), ({factor})*({m[3]})]"
    head, all_sections = sections(text)
    result = head
    for name, body in all_sections:
        if name in ("LINKS", "JOINTS"):
            body = scaled_points(body, factor)
        if name == "JOINTS":
            lines = []
            for line in body.split("\n"):
                line = re.sub(
                    r"(\blength\s+)(\S.*?)(?=\s+(?:range|limits|radius|zero|actuated)|$)", rf"\1({factor})*(\2)", line
                )
                if re.match(r"\s*(prismatic|sph_prs_sph)\b", line):
                    line = re.sub(r"((?:range|limits)\s*)\[([^,\]]+),([^\]]+)\]", scaled_range, line)
                lines.append(line)
            body = "\n".join(lines)
        if name == "OUTPUTS":
            body = re.sub(r"(\b[xyz]\s*)\[([^,\]]+),([^\]]+)\]", scaled_range, body)
        result += f"[{name}]{body}"
    return result


class Units:
    """One model in several units: which files and arguments name it, and its coordinates."""

    def __init__(self, program, path, folder):
        self.path, self.folder = path, folder
        done = subprocess.run([program, "derive", str(path), "--format", "model"], capture_output=True, text=True)
        self.error = done.stderr.strip() if done.returncode else ""
        self.derived = done.stdout
        _, found = sections(self.derived)
        variables = "\n".join(body for name, body in found if name == "SYSTEM VARS")
        self.lengths = re.findall(r"^\s*(\w+)\s*:", variables, re.M)
        self.ranges = {
            m[1]: (m[2], m[3]) for m in re.finditer(r"^\s*(\w+)\s*[:~]\s*\[([^,\n]+),([^\]\n]+)\]", variables, re.M)
        }
        lists = {
            name: [x.strip() for x in body.split("%")[0].split(",")] for name, body in found if name in ("INPUTS", "OUTPUTS")
        }
        self.inputs, self.outputs = lists.get("INPUTS", []), lists.get("OUTPUTS", [])
        self.limits = any(name == "LIMITS" for name, _ in found)
        self.plain = not self.inputs and not self.outputs
        text = path.read_text(errors="replace")
        self.way = "equations"
        if re.search(r"^\s*\[LINKS\]", text, re.M) and path.suffix == ".cuik":
            self.way = "parts"
            directions = re.findall(r"^\s*(\w+)\s*:\s*direction\b", text, re.M)
            self.lengths = [x for x in self.lengths if x.rpartition("_")[0] not in directions]
        elif path.stem in LENGTHS:
            self.way = "constants"

    def arguments(self, factor):
        """The model with lengths times a factor, as arguments; None where it has no lengths."""
        if factor == "1":
            return [str(self.path)]
        if self.way == "constants":
            _, found = sections(self.derived)
            values = dict(re.findall(r"^(\w+)\s*:=\s*(.*?)\s*$", "\n".join(b for n, b in found if n == "CONSTANTS"), re.M))
            changed = [["-D", f"{name}=({factor})*({values[name]})"] for name in LENGTHS[self.path.stem]]
            return [str(self.path), *sum(changed, [])]
        text = scaled_parts(self.path.read_text(), factor) if self.way == "parts" else scaled_equations(self.derived, factor)
        if text is None:
            return None
        path = pathlib.Path(self.folder) / f"{self.path.stem}.cuik"
        path.write_text(text)
        for name in re.findall(r'"([^"/\n]+)"', text):
            if (self.path.parent / name).is_file():
                shutil.copy(self.path.parent / name, self.folder)
        return [str(path)]

    def values(self, representative, names, factor):
        """NAME=VALUE,… of one configuration."""
        number = lambda n, v: repr((v["lo"] + v["hi"]) / 2) + (f"*({factor})" if n in self.lengths else "")
        return ",".join(f"{n}={number(n, representative[n])}" for n in names if n in representative)


class Asker:
    def __init__(self, program, units, limit):
        self.program, self.units, self.limit = program, units, limit

    def ask(self, arguments, *more, limit=None):
        limit = limit or self.limit
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [self.program, more[0], *arguments, *more[1:], "--threads", "1", "--time-limit", str(limit), "--json"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=3 * limit + 20)
        except subprocess.TimeoutExpired:
            return {"error": "no end", "exit": None}, 3 * limit + 20, True
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        try:
            found = json.loads(done.stdout)
        except ValueError:
            # Names and files may differ in an error; what matters is that there is one.
            found = {"error": re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "N", done.stderr.strip().split(": ", 2)[-1])[:160]}
        found["exit"] = done.returncode
        return found, seconds, done.returncode == 3

    def questions(self, sample):
        """name -> (arguments for a factor, what is compared)"""
        u, result = self.units, {}
        solved = self.solved
        if u.plain:
            result["solve"] = (lambda f: ["solve"], solved)
            result["topology"] = (lambda f: ["topology"], self.topology)
            return result
        sets = ["forward", "inverse", "cspace", "cspace-singular", "forward-cusps", "inverse-cusps"]
        for name in sets + ["boundary"] * u.limits:
            result[name] = (lambda f, name=name: ["solve", "--set", name], solved)
        result["aspects"] = (lambda f: ["aspects", "--cusps"], self.aspects)
        result["topology"] = (lambda f: ["topology"], self.topology)
        if not sample:
            return result
        lengths = [x for x in u.outputs if x in u.lengths]
        ball = lengths or u.outputs
        clearance = lambda f: ["clearance", "--at", u.values(sample[0], u.outputs, f), "--in", ",".join(ball)]
        result["clearance"] = (clearance, self.clearance_in_lengths if lengths else self.clearance)
        for number, other in enumerate(sample[1:3]):
            path = lambda f, to=other: ["path", "--from", u.values(sample[0], sample[0], f), "--to", u.values(to, to, f)]
            result[f"path {number + 1}"] = (path, self.path)
        over = next((x for x in (u.inputs, u.outputs) if len(x) == 2 and all(n in u.ranges for n in x)), None)
        if over:
            scaled = lambda f, n, x: f"({f})*({x})" if n in u.lengths else x
            ends = lambda f: sum(
                [["--over", f"{n}={scaled(f, n, u.ranges[n][0])}:{scaled(f, n, u.ranges[n][1])}"] for n in over], []
            )
            result["map"] = (lambda f: ["map", "--resolution", "16", *ends(f)], self.map)
        return result

    # Each gives (what is to be the same, what may differ by a share: name -> (number, share)).
    @staticmethod
    def solved(found, factor):
        boxes = found.get("boxes", {})
        kinds = boxes if isinstance(boxes, dict) else collections.Counter(b["verdict"] for b in boxes)
        kinds = {k: n for k, n in kinds.items() if k != "processed"}
        same = {k: found.get(k) for k in ("exit", "error", "complete", "assembled", "dimension")}
        if kinds.get("undecided", 0) > FEW * sum(kinds.values()):
            same["observed_dimension"] = found.get("observed_dimension")
        if not found.get("complete"):
            return same, {}
        points = found.get("points")
        if points is not None:
            same["points"] = len(points)
        if points is not None and not any(kinds.get(k) for k in ("regular", "partial", "undecided")):
            same["boxes"] = kinds
            return same, {}
        larger = points is not None or kinds.get("undecided", 0) > FEW * sum(kinds.values())
        near = {k: (n, LARGER if larger else NEAR) for k, n in kinds.items()}
        for kind, n in (found.get("boundary") or {}).items():
            if isinstance(n, int):
                near[f"boundary that is {kind}"] = (n, NEAR)
        return same, near

    @staticmethod
    def aspects(found, factor):
        names = ("exit", "error", "aspects", "assembly_modes", "working_modes", "complete", "cusps_of", "bounds")
        same = {k: found.get(k) for k in names}
        same["cusps"] = None if found.get("cusps") is None else len(found["cusps"])
        if not found.get("complete"):
            same = {"exit": found["exit"]}
        return same, {}

    @staticmethod
    def topology(found, factor):
        names = ("exit", "error", "dimension", "components", "smooth", "euler_characteristic", "boundary_curves", "genus")
        return ({k: found.get(k) for k in names} if found["exit"] != 3 else {"exit": 3}), {}

    @staticmethod
    def clearance(found, factor):
        same = {k: found.get(k) for k in ("exit", "error", "empty", "center", "complete", "end")}
        radius = found.get("radius") or {}
        if found["exit"] == 3:
            return same, {}
        return same, {k: (r, 0.02) for k, r in radius.items() if r is not None}

    @classmethod
    def clearance_in_lengths(cls, found, factor):
        same, near = cls.clearance(found, factor)
        return same, {k: (n / float(fractions.Fraction(factor)), share) for k, (n, share) in near.items()}

    def path(self, found, factor):
        same = {k: found.get(k) for k in ("exit", "error", "status", "method")}
        if found.get("method") != "direct":
            return same, {}
        near = {"radius": (found["radius"], 0.02)}
        if self.units.lengths:
            near["radius of lengths"] = ((found.get("length_radius") or 0) / float(fractions.Fraction(factor)), 0.02)
        return same, near

    @staticmethod
    def map(found, factor):
        same = {k: found.get(k) for k in ("exit", "error", "complete")}
        if found["exit"] == 3:
            return same, {}
        cells = collections.Counter(f"cells {c[4]} {c[5]}" for c in found.get("cells", []))
        return same, {k: (n, NEAR) for k, n in cells.items()}


def is_slower(seconds, other):
    return max(seconds, other) > max(1, 1.5 * min(seconds, other))


def differences(name, first, second):
    (same, near, seconds), (other_same, other_near, other_seconds) = first, second
    for key in same:
        if same[key] != other_same.get(key, "nothing"):
            yield f"{name}: {key} {same[key]} against {other_same.get(key)}"
    for key in sorted(set(near) | set(other_near)):
        (a, share), (b, _) = near.get(key, (0, NEAR)), other_near.get(key, (0, NEAR))
        # Of boxes also a few of all: which verdict one at the end of a range has is a matter of where it was cut.
        few = max(4, FEW * sum(n for n, _ in near.values())) if isinstance(a, int) and isinstance(b, int) else 0
        if abs(a - b) > share * max(abs(a), abs(b)) + few:
            yield f"{name}: {key} {a} against {b}"
    if is_slower(seconds, other_seconds):
        yield f"{name}: {seconds:.2f} s against {other_seconds:.2f} s"


def check(program, path, scales, limit, only, folder):
    units = Units(program, path, folder)
    if units.error:
        print(f"{path}: not derived: {units.error[:200]}", flush=True)
        return 0
    if units.arguments(scales[0]) is None:
        print(f"{path}: no lengths", flush=True)
        return 0
    asker = Asker(program, units, limit)
    sample = []
    if not units.plain:
        found, _, _ = asker.ask(units.arguments("1"), "aspects")
        sample = [r["values"] for r in found.get("representatives", [])]
    count, asked, open_questions = 0, 0, []
    for name, (question, compared) in asker.questions(sample).items():
        if only and not any(name.startswith(word) for word in only):
            continue
        command = question("1")
        found, seconds, ended = asker.ask(units.arguments("1"), *command)
        if ended:
            open_questions.append(name)
            continue
        first = (*compared(found, "1"), seconds)
        asked += 1
        for scale in scales:
            command = question(scale)
            found, seconds, ended = asker.ask(units.arguments(scale), *command)
            if ended:  # a busy machine?
                found, seconds, ended = asker.ask(units.arguments(scale), *command, limit=4 * limit)
            if ended and seconds < limit:  # a very busy one: it had four times as long, and used less than that
                open_questions.append(f"{name} times {scale}")
                continue
            if is_slower(first[2], seconds) and not ended:  # a busy machine?
                seconds = min(seconds, asker.ask(units.arguments(scale), *command)[1])
                again = asker.ask(units.arguments("1"), *question("1"))[1]
                first = (*first[:2], min(first[2], again))
            for difference in differences(name, first, (*compared(found, scale), seconds)):
                print(f"{path}, lengths times {scale}: {difference}", flush=True)
                count += 1
    rest = f"; not done in {limit:g} s: {', '.join(open_questions)}" if open_questions else ""
    print(f"{path} ({units.way}): {asked} questions, {count} differences{rest}", flush=True)
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--scales", nargs="+", default=["1000", "1/1000", "1000000"])
    parser.add_argument("--time-limit", type=float, default=10)
    parser.add_argument("--only", nargs="+", metavar="WORD", help="questions that begin with one of these words")
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    with tempfile.TemporaryDirectory() as folder:
        counts = [check(program, path, options.scales, options.time_limit, options.only, folder) for path in options.models]
    return any(counts)


if __name__ == "__main__":
    sys.exit(main())
