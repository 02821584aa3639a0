"""10^4 calls leave nothing behind: neither objects of Python (tracemalloc) nor memory of C++ (the process's size)."""

import gc
import tracemalloc

import pytest

import corank


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


@pytest.fixture(scope="module")
def calls(points):
    """Calls that are quick, each of another part of the package."""
    m = corank.Mechanism("m")
    m.length("x", -1, 1)
    m.constrain("x^2 = 1/4")

    def build():
        other = corank.Mechanism("n")
        x = other.length("x", -1, 1)
        other.constrain(2 * x**2 == corank.sin(corank.pi / 4))

    def fail():
        with pytest.raises(corank.ModelError):
            corank.as_expression("sin(")

    def look():
        assert points.boxes.shape[0] == 8 and points.counts and points.points and points["y_A"].shape == (8, 2)

    return [build, fail, look, m.copy, lambda: m.with_constants(), lambda: repr(points)]


def test_ten_thousand_calls_leave_nothing_behind(calls):
    def many(times):
        for k in range(times):
            calls[k % len(calls)]()

    many(3000)  # whatever is made once
    gc.collect()
    tracemalloc.start()
    many(200)
    gc.collect()
    objects, memory = tracemalloc.get_traced_memory()[0], resident()
    many(10_000)
    gc.collect()
    grown = tracemalloc.get_traced_memory()[0] - objects
    tracemalloc.stop()
    assert grown < 100_000, f"{grown} bytes of Python's objects"
    assert resident() - memory < 8 << 20, f"{resident() - memory} bytes of the process"


def test_solving_many_times_leaves_nothing_behind():
    m = corank.parse("[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\nx^2 = 1/4;\n")
    for _ in range(100):
        m.solve(threads=1)
    gc.collect()
    before = resident()
    for _ in range(400):
        assert len(m.solve(threads=1).boxes) == 2
    gc.collect()
    assert resident() - before < 8 << 20
