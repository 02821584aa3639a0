#!/usr/bin/env python3
"""Processor time of a search by one thread, and by worker processes of the same machine: user + system of all processes.

Usage: PYTHONPATH=build/release/python bench/cluster_cost.py [--program build/release/app/corank] [--workers 2] [--runs 3] MODEL SET SIGMA

The results have to have the same boxes, to the last bit (h5diff). Elapsed times mean something on a machine without other work only.
"""

import argparse
import ctypes
import os
import subprocess
import sys
import tempfile
import time

PR_SET_CHILD_SUBREAPER = 36


def run(command):
    """(elapsed, processor) seconds of the command and of all processes that come from it, orphans too."""
    before, begun = os.times(), time.monotonic()
    first = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    status = None
    while True:
        try:
            pid, ended = os.wait()  # orphans are this process's children
        except ChildProcessError:
            break
        if pid == first.pid:
            status, elapsed = ended, time.monotonic() - begun
    if status != 0:
        raise SystemExit(f"{' '.join(command)}: status {status}")
    after = os.times()
    return elapsed, sum(after[2:4]) - sum(before[2:4])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("set")
    parser.add_argument("sigma")
    parser.add_argument("--program", default="build/release/app/corank")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--runs", type=int, default=3)
    args = parser.parse_args()
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    with tempfile.TemporaryDirectory() as folder:
        one, other = os.path.join(folder, "one.h5"), os.path.join(folder, "other.h5")
        question = [args.model, "--set", args.set, "--sigma", args.sigma]
        spread = [sys.executable, "-m", "corank.cluster", "solve", *question, "--workers", str(args.workers), "--quiet"]
        for _ in range(args.runs):
            alone = run([args.program, "solve", *question, "-o", one])
            shared = run([*spread, "-o", other])
            for part in ("/boxes", "/certificates", "/variables"):
                same = subprocess.run(["h5diff", "-q", one, other, part], check=False).returncode == 0
                if not same:
                    raise SystemExit(f"{part} differ")
            print(
                f"{' '.join(question)}: alone {alone[0]:.1f} s, {alone[1]:.2f} s of processors; {args.workers} workers "
                f"{shared[0]:.1f} s, {shared[1]:.2f} s: {shared[1] / alone[1] - 1:+.1%}, {alone[0] / shared[0]:.2f} times as fast",
                flush=True,
            )


if __name__ == "__main__":
    main()
