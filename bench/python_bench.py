#!/usr/bin/python3
"""What Python adds: the cost of a call, a million boxes as a data frame.

PYTHONPATH=build/release/python bench/python_bench.py
"""

import pathlib
import statistics
import time

import pandas  # noqa: F401  not what is measured

import corank
from corank import _corank


def microseconds(function, times=2000):
    seconds = []
    for _ in range(times):
        start = time.perf_counter()
        function()
        seconds.append(time.perf_counter() - start)
    return 1e6 * statistics.median(seconds)


def main():
    models = pathlib.Path(__file__).resolve().parent.parent / "models"
    points = corank.load(models / "three_slider.cuik").solve("forward")
    for name, function in (
        ("long work that does nothing", _corank.do_nothing),
        ("result.boxes", lambda: points.boxes),
        ("result['x_C']", lambda: points["x_C"]),
        ("result.counts", lambda: points.counts),
        ("as_expression", lambda: corank.as_expression("cos(x) + 1")),
    ):
        print(f"{name:30}{microseconds(function):10.1f} us")
    big = corank.load(models / "dextar.cuik").solve("cspace", sigma=0.0138)
    start = time.perf_counter()
    frame = big.to_pandas()
    print(f"{len(frame)} boxes, {frame.shape[1]} columns: {time.perf_counter() - start:.3f} s")


main()
