#!/usr/bin/env python3
"""Puts one small fault after the other into certify/ and check/ (tests/mutants/mutants.json), builds what depends on it and runs the tests
until one fails. A fault that no test notices is a hypothesis that no test holds in place.

  scripts/mutants.py [WORD]     those whose file or description holds WORD; works on a copy of the last commit in build/mutants
"""
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COPY = ROOT / "build" / "mutants"
BUILD = COPY / "build" / "release"
TEST_TIMEOUT = 300  # a fault may also make a test go on for ever


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def prepare(targets):
    if COPY.exists():
        commit = run("git", "-C", ROOT, "rev-parse", "HEAD").stdout.strip()
        for command in (["fetch", "--quiet", "origin"], ["checkout", "--quiet", "--force", commit]):
            run("git", "-C", COPY, *command, check=True)
    else:
        COPY.parent.mkdir(exist_ok=True)
        run("git", "clone", "--quiet", ROOT, COPY, check=True)
    run("cmake", "--preset", "release", cwd=COPY, check=True)
    build(targets, check=True)


def build(targets, check=False):
    return run("cmake", "--build", BUILD, "--target", *targets, check=check).returncode == 0


def verdict(mutant):
    """What became of it: "killed by TEST", "does not compile", or None where every test passes."""
    if not build(mutant["tests"]):
        return "does not compile"
    for target in mutant["tests"]:
        program = next(BUILD.glob(f"tests/**/{target}"))
        try:
            outcome = run(program, "--gtest_brief=1", "--gtest_fail_fast", timeout=TEST_TIMEOUT)
        except subprocess.TimeoutExpired:
            return f"killed by {target}, which does not end"
        if outcome.returncode != 0:
            failed = [line for line in outcome.stdout.splitlines() if line.startswith("[  FAILED  ]")]
            return "killed by " + (failed[0].split()[3] if failed else target)
    return None


def main():
    word = sys.argv[1] if len(sys.argv) > 1 else ""
    mutants = [m for m in json.loads((ROOT / "tests/mutants/mutants.json").read_text()) if word in m["file"] + " " + m["of"]]
    prepare(sorted({target for m in mutants for target in m["tests"]}))
    alive = 0
    for number, mutant in enumerate(mutants, 1):
        file = COPY / mutant["file"]
        text = file.read_text()
        if text.count(mutant["old"]) != 1:
            sys.exit(f"mutants.json: {mutant['of']}: its text is {text.count(mutant['old'])} times in {mutant['file']}, expected once")
        file.write_text(text.replace(mutant["old"], mutant["new"]))
        try:
            fate = verdict(mutant)
        finally:
            file.write_text(text)
        explained = mutant.get("equivalent")
        if explained and fate is not None:
            sys.exit(f"mutants.json: {mutant['of']}: said to be equivalent, but {fate}")
        alive += fate is None and not explained
        print(f"{number:4}  {mutant['file']}, {mutant['of']}: {fate or explained or 'ALIVE'}", flush=True)
    print(f"{len(mutants)} mutants, {alive} alive, {sum('equivalent' in m for m in mutants)} explained")
    return 1 if alive else 0


if __name__ == "__main__":
    sys.exit(main())
