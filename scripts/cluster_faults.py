#!/usr/bin/env python3
"""Kills workers and clients of corank.cluster at random moments, and compares what comes out with one process's result.

Usage: PYTHONPATH=build/release/python scripts/cluster_faults.py [--workers-killed 100] [--clients-killed 20] [--sigma 0.005] [--seed 1]
"""

import argparse
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np

import corank
from corank import cluster

MODEL = pathlib.Path(__file__).resolve().parent.parent / "models" / "dextar.cuik"


def same(one, other):
    arrays = other._core.boxes()
    return other.complete and all(np.array_equal(array, arrays[name]) for name, array in one._core.boxes().items())


def solve_with_a_death(mechanism, client, args, chance, took):
    """The result, and whether a worker died while it was made."""
    victim = chance.choice(list(client.run(os.getpid).values()))
    seconds = chance.uniform(0, took)
    ended = threading.Event()
    done = []

    def kill():
        if not ended.wait(seconds):
            os.kill(victim, signal.SIGKILL)
            done.append(victim)

    killer = threading.Thread(target=kill)
    killer.start()
    plan = cluster.Plan(unit_seconds=args.unit_time)
    result = cluster.solve(mechanism, client, "cspace", sigma=args.sigma, plan=plan, progress=False)
    ended.set()
    killer.join()
    return result, bool(done)


def kill_workers(one, args, chance):
    """Each run loses one of two workers; returns in how many runs it died before the end, how many results differ, and how often
    dask had to be started anew since it did not replace a dead worker within a minute."""
    differ = hit = anew = run = 0
    mechanism = corank.load(MODEL)
    while run < args.workers_killed:
        with cluster.local_client(workers=2) as client:
            took = time.monotonic()
            mechanism.solve("cspace", sigma=args.sigma, client=client, progress=False)
            took = time.monotonic() - took
            while run < args.workers_killed:
                try:
                    client.wait_for_workers(2, timeout=60)
                except TimeoutError:
                    anew += 1
                    break
                run += 1
                result, died = solve_with_a_death(mechanism, client, args, chance, took)
                hit += died
                differ += not same(one, result)
                print(f"worker {run}: {'killed' if died else 'the run was over'}, {differ} differ so far", flush=True)
    return hit, differ, anew


def kill_clients(one, args, chance):
    """Each client is killed, and resumed if it had a checkpoint, until it is done; returns how often, and how many results differ."""
    kills = resumed = differ = 0
    program = [sys.executable, "-m", "corank.cluster", "solve", "--workers", "2", "--quiet", "--every", "0.05"]
    program += ["--unit-time", str(args.unit_time)]
    for run in range(args.clients_killed):
        with tempfile.TemporaryDirectory() as folder:
            kept, path = os.path.join(folder, "kept"), os.path.join(folder, "r.h5")
            fresh = [str(MODEL), "--set", "cspace", "--sigma", str(args.sigma), "-o", path, "--checkpoint", kept]
            client = subprocess.Popen(program + fresh, stdout=subprocess.DEVNULL)
            while not os.path.exists(kept) and client.poll() is None:
                time.sleep(0.01)
            try:
                client.wait(timeout=chance.uniform(0, args.client_time))
            except subprocess.TimeoutExpired:
                client.kill()
                client.wait()
                kills += 1
            if not os.path.exists(path):
                resumed += os.path.exists(kept)
                subprocess.run(
                    program + (["--resume", kept] if os.path.exists(kept) else fresh), stdout=subprocess.DEVNULL, check=True
                )
            differ += not same(one, corank.open(path))
            print(f"client {run + 1}: {kills} killed, {resumed} resumed, {differ} differ so far", flush=True)
    return kills, resumed, differ


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers-killed", type=int, default=100)
    parser.add_argument("--clients-killed", type=int, default=20)
    parser.add_argument("--sigma", type=float, default=0.005)
    parser.add_argument("--unit-time", type=float, default=0.1)
    parser.add_argument(
        "--client-time", type=float, default=2.0, help="seconds after its first checkpoint that a client lives, at most"
    )
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    chance = random.Random(args.seed)
    one = corank.load(MODEL).solve("cspace", sigma=args.sigma, progress=False)
    hit, differ, anew = kill_workers(one, args, chance) if args.workers_killed else (0, 0, 0)
    kills, resumed, other = kill_clients(one, args, chance) if args.clients_killed else (0, 0, 0)
    print(f"{args.workers_killed} runs: a worker killed in {hit}, {differ} results differ, dask started anew {anew} times")
    print(f"{args.clients_killed} clients: {kills} killed, {resumed} resumed, {other} results differ")
    return 1 if differ or other else 0


if __name__ == "__main__":
    sys.exit(main())
