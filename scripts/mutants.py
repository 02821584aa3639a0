#!/usr/bin/env python3
"""Puts one small fault after the other into the trusted code (tests/mutants/*.json), builds what depends on it and runs the
tests until one fails. A fault that no test notices is a hypothesis that no test holds in place.

  scripts/mutants.py [--jobs N] [WORD …]   those whose file or description holds each WORD

Works on N copies (1) of the last commit in build/mutants, where it also remembers which test killed which mutant, to try
that one first; with CMAKE_CXX_COMPILER_LAUNCHER=ccache in the environment a second run is quick.

A mutant's fields: "file"; "old", a text that is once in it; "new", what takes its place; "of", the hypothesis in the words
of doc/theory.md; "tests", the programs to run, in this order, until one fails; and, where no test can fail, "equivalent",
the proof of that.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import queue
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "build" / "mutants"
KILLERS = FOLDER / "killers.json"
TEST_TIMEOUT = 300  # a fault may also make a test go on for ever


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def mutants(words):
    every = [m for path in sorted(ROOT.glob("tests/mutants/*.json")) for m in json.loads(path.read_text())]
    return [m for m in every if all(word in m["file"] + " " + m["of"] for word in words)]


class Copy:
    """A clone of the repository in which one mutant after the other is built."""

    def __init__(self, number):
        self.root = FOLDER / str(number)
        self.build_folder = self.root / "build" / "release"

    def prepare(self, targets):
        if self.root.exists():
            commit = run("git", "-C", ROOT, "rev-parse", "HEAD").stdout.strip()
            for command in (["fetch", "--quiet", "origin"], ["checkout", "--quiet", "--force", commit]):
                run("git", "-C", self.root, *command, check=True)
        else:
            self.root.parent.mkdir(parents=True, exist_ok=True)
            run("git", "clone", "--quiet", ROOT, self.root, check=True)
        run("cmake", "--preset", "release", "-DCMAKE_UNITY_BUILD=OFF", cwd=self.root, check=True)
        for target in targets:
            if not self.build(target):
                sys.exit(f"mutants.py: {target} does not build without any fault")

    def build(self, target):
        return run("cmake", "--build", self.build_folder, "--target", target).returncode == 0

    def fate(self, mutant, last_killer):
        """What becomes of it: "killed by TEST", "does not compile", or None where every test passes."""
        file = self.root / mutant["file"]
        text = file.read_text()
        if text.count(mutant["old"]) != 1:
            return f"is {text.count(mutant['old'])} times in its file, expected once"
        file.write_text(text.replace(mutant["old"], mutant["new"]))
        try:
            for target in mutant["tests"]:
                if not self.build(target):
                    return "does not compile"
                killer = self.killer(target, last_killer) if last_killer else None
                killer = killer or self.killer(target, "*")
                if killer:
                    return "killed by " + killer
            return None
        finally:
            file.write_text(text)

    def killer(self, target, tests):
        program = next(self.build_folder.glob(f"tests/**/{target}"))
        options = ["--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=" + tests]
        try:
            outcome = run(program, *options, timeout=TEST_TIMEOUT, env={**os.environ, "CORANK_SEEDS": "60"})  # long forms
        except subprocess.TimeoutExpired:
            return f"{target}, which does not end"
        if outcome.returncode == 0:
            return None
        failed = [line for line in outcome.stdout.splitlines() if line.startswith("[  FAILED  ]")]
        return failed[0].split()[3].rstrip(",") if failed else target


def judge(mutant, fate):
    """Its kind and the words about it."""
    explained = mutant.get("equivalent")
    if fate is None:
        return ("explained", explained) if explained else ("alive", "ALIVE")
    if not fate.startswith("killed"):
        return "broken", "BROKEN: " + fate
    return ("broken", f"BROKEN: said to be equivalent, but {fate}") if explained else ("killed", fate)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("words", nargs="*")
    options = parser.parse_args()
    chosen = mutants(options.words)
    # Each copy is prepared before there is a fault anywhere.
    first_tests = sorted({m["tests"][0] for m in chosen})
    copies = queue.Queue()
    for number in range(1, options.jobs + 1):
        copy = Copy(number)
        copy.prepare(first_tests)
        copies.put(copy)

    killers = json.loads(KILLERS.read_text()) if KILLERS.exists() else {}

    def name(mutant):
        return mutant["file"] + ", " + mutant["of"]

    def fate(mutant):
        copy = copies.get()
        try:
            return copy.fate(mutant, killers.get(name(mutant)))
        finally:
            copies.put(copy)

    by_file = collections.defaultdict(collections.Counter)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for number, (mutant, end) in enumerate(zip(chosen, pool.map(fate, chosen)), 1):
            kind, words = judge(mutant, end)
            by_file[mutant["file"]][kind] += 1
            print(f"{number:4}  {name(mutant)}: {words}", flush=True)
            if kind == "killed" and "." in end:
                killers[name(mutant)] = end.removeprefix("killed by ")
                KILLERS.write_text(json.dumps(killers, indent=1))

    def summary(counts):
        parts = [f"{counts[kind]} {kind}" for kind in ("killed", "explained", "alive", "broken") if counts[kind]]
        return f"{counts.total()} mutant" + ("" if counts.total() == 1 else "s") + ": " + ", ".join(parts)

    for file, counts in sorted(by_file.items()):
        print(f"{file}: {summary(counts)}")
    total = sum(by_file.values(), collections.Counter())
    print("all: " + (summary(total) if total else "0 mutants"))
    return 1 if total["alive"] or total["broken"] else 0


if __name__ == "__main__":
    sys.exit(main())
