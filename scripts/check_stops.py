#!/usr/bin/env python3
"""Ends commands of corank at random moments, by --time-limit and by signals, and looks at how they take it.

  scripts/check_stops.py PROGRAM FOLDER... [--cases 200] [--seed 1] [--slack 1] [--command aspects]

Each case takes one command, one model of the folders and one moment. What it checks:
- the program ends within --slack seconds of processor time after the moment;
- its exit status is one of a statement, or, of a command without a handler, the signal's;
- every result file that it left is one that `corank verify` reads, and no half-written file is left.
Prints one line for each case that fails, then the counts; exit status 1 if any failed.
"""
import argparse
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

TICK = os.sysconf("SC_CLK_TCK")
SETS = ["forward", "inverse", "cspace", "boundary", "redundant-input", "self-motion"]


def processor_time(pid):
    """Of a process and all below it, in seconds; those that ended and were waited for are in their parent's."""
    total = 0
    waiting = [pid]
    while waiting:
        p = waiting.pop()
        try:
            fields = pathlib.Path(f"/proc/{p}/stat").read_text().rsplit(")", 1)[1].split()
            for task in pathlib.Path(f"/proc/{p}/task").iterdir():
                waiting += [int(c) for c in (task / "children").read_text().split()]
        except (FileNotFoundError, ProcessLookupError, IndexError):
            continue
        total += sum(int(fields[i]) for i in (11, 12, 13, 14)) / TICK
    return total


def arguments(name, model, folder, rng):
    out = str(folder / "out.h5")
    if name == "solve":
        return ["solve", model, "--set", rng.choice(SETS[:4]), "-o", out]
    if name == "report":
        return ["report", model, "-o", str(folder / "page")]
    if name in ("aspects", "topology"):
        return [name, model, "-o", out]
    return [name, model]


def moment_of(rng):
    return round(10 ** rng.uniform(-1.3, 1.0), 2)  # 0.05 to 10 s, small ones more often


def run_case(program, name, model, way, moment, slack, rng):
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        command = [program, *arguments(name, model, folder, rng)]
        if way == "limit":
            command += ["--time-limit", str(moment)]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        began = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, cwd=folder, text=True)
        used_then = None
        while process.poll() is None:
            if used_then is None and time.monotonic() - began >= moment:
                used_then = processor_time(process.pid)
                if way != "limit":
                    process.send_signal(way)
            time.sleep(0.01)
            if time.monotonic() - began > moment + 40 * slack:
                process.kill()
        error = process.stderr.read()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        over = 0 if used_then is None else used - used_then
        faults = []
        if over > slack:
            faults.append(f"{over:.1f} s of processor time after the moment")
        if process.returncode not in (0, 1, 2, 3, 5) and (way == "limit" or process.returncode != -way):
            faults.append(f"exit status {process.returncode}")
        if "a bug in corank" in error:
            faults.append(error.strip().splitlines()[-1])
        for file in folder.rglob("*"):
            if file.suffix == ".part":
                faults.append(f"half-written {file.name}")
            if file.suffix == ".h5" and name != "report":
                check = subprocess.run([program, "verify", str(file), "--time-limit", "10"], capture_output=True, text=True)
                if check.returncode not in (0, 3, 4):
                    faults.append(f"verify {file.name}: exit status {check.returncode}: {check.stderr.strip()[:200]}")
        used_words = f"{used:.1f} s"
        return faults, command, process.returncode, used_words, over


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--slack", type=float, default=1.0)
    parser.add_argument("--command", action="append", help="only these commands")
    options = parser.parse_args()
    models = sorted(str(f.resolve()) for folder in options.folders for f in folder.rglob("*")
                    if f.suffix in (".cuik", ".urdf", ".world"))
    commands = options.command or ["solve", "aspects", "topology", "report", "derive"]
    rng = random.Random(options.seed)
    failed = 0
    worst = 0.0
    for case in range(options.cases):
        name, model, moment = rng.choice(commands), rng.choice(models), moment_of(rng)
        ways = ["limit", signal.SIGTERM, signal.SIGINT]
        way = rng.choice(ways[1:] if name in ("derive", "report") else ways)
        faults, command, status, used, over = run_case(options.program, name, model, way, moment, options.slack, rng)
        worst = max(worst, over)
        if faults:
            failed += 1
            how = "--time-limit" if way == "limit" else way.name
            print(f"{case}: {' '.join(command)}: {how} at {moment} s: {'; '.join(faults)} (status {status}, used {used})",
                  flush=True)
    print(f"{options.cases} cases, {failed} failed; at most {worst:.2f} s of processor time after the moment")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
