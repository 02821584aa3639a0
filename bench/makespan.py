#!/usr/bin/env python3
"""Simulates the units of a search, as corank_bench_shards has measured them, on N workers of one thread each.

Usage: bench/makespan.py units.json [--latency S] [--gigabits G] [--stored] [--dearer K]

The model: a unit can begin once the unit that it came from has been added (those of a new pass: all before it). The client has one
link, on which what is sent queues up at G Gbit/s, and likewise what is received, and one thread, which adds answers one after the other in
the time that was measured; each message takes S seconds besides. A unit that has come from the client is begun
by whichever worker is idle (clients send units ahead), the longest-waiting first.
--stored: workers put what they have found on a store of their own, and only the boxes that are left come back over the link.
--dearer K: the same tree, were each of its boxes K times as much work.
Efficiency: the units' own time, divided by workers times makespan. Assembly of the result at the end is not in it.
"""

import argparse
import heapq
import json


def simulate(units, workers, latency, bandwidth, stored):
    children, after = {}, {}
    for unit in units:
        children.setdefault(unit["parent"], []).append(unit)
    link = up = client = 0.0  # when they are free next
    ready = []  # (time, order, unit)
    idle = [0.0] * workers
    heapq.heapify(idle)
    order = 0
    for unit in children.get(-1, []):
        heapq.heappush(ready, (0.0, order, unit))
        order += 1
    finished = []  # (time the answer is ready at the worker, order, unit)
    end = 0.0
    while ready or finished:
        # The next event: a unit is given to an idle worker, or an answer arrives.
        start = max(ready[0][0], idle[0]) if ready and idle else float("inf")
        if finished and finished[0][0] <= start:
            time, _, unit = heapq.heappop(finished)
            heapq.heappush(idle, time)
            size = unit["left_bytes"] if stored else unit["received"]
            link = max(link, time) + size / bandwidth
            client = max(client, link + latency) + (unit["client"] if not stored else min(unit["client"], 2e-4))
            end = max(end, client)
            for child in children.get(unit["id"], []):
                up = max(up, client) + child["sent"] / bandwidth
                heapq.heappush(ready, (up + latency, order, child))
                order += 1
            continue
        heapq.heappop(idle)
        _, _, unit = heapq.heappop(ready)
        order += 1
        heapq.heappush(finished, (start + unit["seconds"], order, unit))
    return end


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--latency", type=float, default=1e-3)
    parser.add_argument("--gigabits", type=float, default=10)
    parser.add_argument("--stored", action="store_true")
    parser.add_argument("--dearer", type=float, default=1)
    args = parser.parse_args()
    with open(args.file, encoding="utf-8") as file:
        data = json.load(file)
    units = []
    for unit in data["units"]:
        for copy in range(unit["stands_for"]):
            units.append(dict(unit, id=unit["id"] + copy * 10**7, left_bytes=unit["left"], seconds=unit["seconds"] * args.dearer))
    total = sum(unit["seconds"] for unit in units)
    sent, received = sum(unit["sent"] for unit in units), sum(unit["received"] for unit in units)
    print(f"{data['line']}: {len(units)} units, {total:.1f} s of work, {sent / 1e6:.0f} MB sent, {received / 1e6:.0f} MB received")
    print(f"latency {args.latency * 1e3:g} ms, {args.gigabits:g} Gbit/s" + (", answers stored by the workers" if args.stored else ""))
    print("workers  makespan  efficiency")
    for workers in (1, 2, 10, 100, 1000):
        makespan = simulate(units, workers, args.latency, args.gigabits * 1.25e8, args.stored)
        print(f"{workers:7}  {makespan:8.3f}  {total / workers / makespan:9.1%}")


if __name__ == "__main__":
    main()
