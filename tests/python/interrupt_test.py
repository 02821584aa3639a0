"""Ctrl-C, progress, and the interpreter's lock in long work."""

import pickle
import signal
import subprocess
import sys
import threading

import pytest

import corank


def ctrl_c(times=1):
    """A progress function that is a user who presses Ctrl-C."""
    pressed = []

    def press(stage, share, text):
        if len(pressed) < times:
            pressed.append(stage)
            signal.raise_signal(signal.SIGINT)

    return press


def test_ctrl_c_ends_a_search_with_a_valid_partial_result(dextar, tmp_path):
    with pytest.raises(KeyboardInterrupt) as caught:
        dextar.solve("cspace", sigma=0.004, progress=ctrl_c())
    assert isinstance(caught.value, corank.Interrupted)
    r = caught.value.result
    assert "interrupt" in r.stopped
    # Pressed before the search was done, or before its sheets were cut.
    assert not r.complete or (r.boxes[:, :, 1] - r.boxes[:, :, 0]).max() > 0.004
    r.save(tmp_path / "partial.h5")
    assert corank.open(tmp_path / "partial.h5").stopped == r.stopped
    assert r.verify().report["failures"] == []


def test_the_same_mechanism_is_solved_afterwards(dextar):
    with pytest.raises(corank.Interrupted):
        dextar.solve("cspace", sigma=0.004, progress=ctrl_c())
    assert dextar.solve("forward", sigma=0.1).complete


def test_ctrl_c_ends_an_analysis_with_what_is_proven(dextar):
    with pytest.raises(corank.Interrupted) as caught:
        dextar.aspects(progress=ctrl_c())
    assert not caught.value.result.complete


def test_ctrl_c_in_a_report_brings_the_sets_that_were_done(dextar):
    def press(stage, share, text):
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(corank.Interrupted) as caught:
        dextar.report(sets=["cspace", "forward"], cspace_sigma=0.004, time_limit=0, max_found=0, progress=press)
    assert [r.set for r in caught.value.result] == ["cspace"]


def test_what_a_progress_function_raises_comes_back(dextar):
    def fail(stage, share, text):
        raise RuntimeError("of the user")

    with pytest.raises(RuntimeError, match="of the user"):
        dextar.solve("cspace", sigma=0.004, progress=fail)


def test_progress_says_stage_and_share(dextar):
    said = []
    r = dextar.solve("cspace", sigma=0.05, progress=lambda *news: said.append(news))
    assert r.complete
    assert all(isinstance(stage, str) and (share is None or 0 <= share <= 1) for stage, share, _ in said)


def test_other_threads_of_python_run_meanwhile(dextar):
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    try:
        dextar.solve("cspace", sigma=0.1)
        assert counted[0] > before + 1000
    finally:
        done.set()
        thread.join()


def test_two_threads_solve_at_once(dextar, three_slider):
    found = {}

    def solve(name, mechanism, **options):
        found[name] = mechanism.solve("forward", **options)

    threads = [threading.Thread(target=solve, args=(f"dextar {k}", dextar), kwargs={"sigma": 0.1}) for k in range(3)]
    threads += [threading.Thread(target=solve, args=("three", three_slider))]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(found["three"].points) == 8
    assert (found["dextar 0"].boxes == found["dextar 1"].boxes).all()


def test_a_handler_of_signals_survives_the_writing_of_a_file(points, tmp_path):
    before = signal.getsignal(signal.SIGINT)
    points.save(tmp_path / "points.h5")
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_an_interrupt_that_brings_a_result_can_be_pickled(points):
    again = pickle.loads(pickle.dumps(corank.Interrupted(points)))
    assert len(again.result.points) == 8


PROGRAM = """
import corank, sys
said = []
def progress(stage, share, text):
    if stage == "search" and not said:
        said.append(stage)
        print("searching", flush=True)
try:
    corank.load(sys.argv[1]).solve("cspace", sigma=0.003, progress=progress)
except corank.Interrupted as early:
    print(early.result.complete, early.result.stopped, flush=True)
    raise
"""


def test_a_signal_from_outside_ends_a_script_which_can_keep_its_result(models):
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(models / "dextar.cuik")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout.readline() == "searching\n"
    process.send_signal(signal.SIGINT)
    said, error = process.communicate(timeout=120)
    assert said.startswith("False an interrupt, in the stage ") and "corank.errors.Interrupted" in error
    assert process.returncode != 0
