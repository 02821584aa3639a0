"""Searches on a cluster of worker processes come to corank solve's boxes, whatever happens to the processes."""

import contextlib
import gc
import io
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys

import numpy as np
import pytest

import corank
from corank import _corank

pytest.importorskip("distributed", reason="no package distributed: clusters are not tested")
psutil = pytest.importorskip("psutil")

from distributed import Client  # noqa: E402

from corank import cluster  # noqa: E402
from corank.cluster import command  # noqa: E402
from corank.cluster.units import Units  # noqa: E402

SIGMA = 0.1
QUICK = cluster.Plan(unit_seconds=0.02)


@pytest.fixture(scope="module")
def client():
    with cluster.local_client(workers=2) as client:
        yield client


@pytest.fixture(scope="module")
def cspace(dextar):
    return dextar.solve("cspace", sigma=SIGMA)


@pytest.fixture
def command_line(client):
    """A function that does here, by the client's workers, what the arguments say: exit status and standard error."""

    def run(*arguments):
        said, where = io.StringIO(), ["--scheduler", client.scheduler.address]
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            try:
                status = command.main(["solve", "--quiet", *([] if "--scheduler" in arguments else where), *arguments])
            except SystemExit as usage:
                status = usage.code
        return status, said.getvalue()

    return run


def expect_same(one, other):
    assert one.complete and other.complete and one.variables == other.variables
    assert np.array_equal(one.boxes, other.boxes)
    for name, array in one._core.boxes().items():
        assert np.array_equal(array, other._core.boxes()[name]), name


@pytest.fixture
def while_units_wait(monkeypatch):
    """A function that has something done once, as soon as that many units have been given out and are not yet answered."""
    happened = []

    def arrange(action, number=2):
        def submit(units, given, seconds):
            plain(units, given, seconds)
            if not happened and len(units) >= number:
                happened.append(True)
                action()

        plain = Units.submit
        monkeypatch.setattr(Units, "submit", submit)
        return happened

    return arrange


def test_two_workers_make_the_boxes_of_one_process(client, dextar, models):
    expect_same(dextar.solve("cspace", sigma=0.2), dextar.solve("cspace", sigma=0.2, client=client))
    platform = corank.load(models / "3rrr_fixed_orientation.cuik")
    expect_same(platform.solve("forward", sigma=0.1), platform.solve("forward", sigma=0.1, client=client))


def test_a_default_sigma_proof_and_points_are_those_of_one_process(client, dextar, three_slider):
    one, other = dextar.solve("forward"), dextar.solve("forward", client=client)
    expect_same(one, other)
    assert one.sigma == other.sigma
    one, other = (dextar.solve("forward", sigma=0.1, proof=True, client=c) for c in (None, client))
    expect_same(one, other)
    assert other.verify().complete
    one, other = three_slider.solve("inverse", digits=30), three_slider.solve("inverse", digits=30, client=client)
    assert [p.decimals for p in one.points] == [p.decimals for p in other.points] and one.points


def test_a_set_of_several_searches_is_that_of_one_process(client, models):
    limited = corank.load(models / "dextar_limits.cuik")
    one, other = (limited.solve("boundary", sigma=0.2, client=c) for c in (None, client))
    expect_same(one, other)
    assert len(one._core.parts) == len(other._core.parts) > 1


def test_a_sweep_on_a_cluster_has_the_members_of_one_process(client, dextar):
    one, other = (dextar.sweep("l2", ["0.9", "1.1"], sets=["forward"], sigma=0.1, client=c) for c in (None, client))
    assert one.complete and other.complete and len(other) == 2
    for member, same in zip(one, other):
        expect_same(member.results["forward"], same.results["forward"])


def test_what_has_no_solution_is_done_at_once(client):
    empty = corank.parse("[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\n[SYSTEM EQS]\nx + y = 3; 2*x + 2*y = 7;\n")
    one, other = (empty.solve(client=c) for c in (None, client))
    assert one.complete and other.complete and len(one) == len(other) == 0


def test_a_killed_worker_costs_nothing_but_time(client, dextar, cspace, while_units_wait):
    victim = next(iter(client.run(os.getpid).values()))
    killed = while_units_wait(lambda: os.kill(victim, signal.SIGKILL))
    run = cluster.solve(dextar, client, "cspace", sigma=SIGMA, plan=QUICK)
    assert killed
    expect_same(cspace, run)


def test_what_a_worker_that_hangs_holds_is_done_by_another(client, dextar, cspace, while_units_wait):
    client.wait_for_workers(2)
    victim = next(iter(client.run(os.getpid).values()))
    hung = while_units_wait(lambda: os.kill(victim, signal.SIGSTOP))
    try:
        plan = cluster.Plan(unit_seconds=0.02, hang_seconds=0.5)
        run = cluster.solve(dextar, client, "cspace", sigma=SIGMA, plan=plan)
        assert hung
        assert psutil.Process(victim).status() == psutil.STATUS_STOPPED
    finally:
        os.kill(victim, signal.SIGCONT)
    expect_same(cspace, run)


def test_a_unit_that_is_answered_twice_counts_once(dextar, cspace):
    options = corank.options.make_options(sigma=SIGMA)
    run = _corank.SpreadRun(_corank.Question(dextar._core, "cspace"), options, 0)
    run.begin(None)
    while not run.done:
        for unit in run.take_units(2):
            answer = _corank.run_unit(run.prepared, unit, 300, 0, 1)
            again = _corank.run_unit(run.prepared, unit, 100, 0, 2)
            assert run.add(answer) and not run.add(again) and not run.add(answer)
    run.finish()
    expect_same(cspace, corank.Result(run.result()))


def test_another_version_is_refused_by_name_before_work_begins(client, dextar, while_units_wait):
    client.wait_for_workers(2)
    other = next(iter(client.run(os.getpid)))

    def pretend(version):
        from corank import _corank

        former, _corank.engine_version = _corank.engine_version, version
        return former

    own = client.run(pretend, "0.0.9 (search other)", workers=[other])[other]
    given_out = while_units_wait(lambda: None, number=1)
    try:
        with pytest.raises(cluster.ClusterError) as refused:
            dextar.solve("cspace", sigma=0.2, client=client)
    finally:
        client.run(pretend, own, workers=[other])
    assert f"{other}: corank 0.0.9 (search other)" in str(refused.value) and own in str(refused.value)
    assert not given_out


def test_everything_listens_on_loopback_only(client):
    def listening():
        import psutil

        return [c.laddr.ip for c in psutil.Process().connections("inet") if c.status == psutil.CONN_LISTEN]

    client.wait_for_workers(2)
    addresses = sum(client.run(listening).values(), listening())
    assert len(addresses) > 3 and set(addresses) == {"127.0.0.1"}


def test_limits_of_what_is_found_and_too_many_threads_are_refused(client, dextar):
    with pytest.raises(corank.OptionError, match="max_found: a search on a cluster does not have this limit"):
        dextar.solve("cspace", sigma=0.2, max_found=5, client=client)
    with pytest.raises(ValueError, match="threads: expected 1 to 31"):
        dextar.solve("cspace", sigma=0.2, threads=32, client=client)


def expect_ended(result, by):
    assert result.stopped.startswith(f"{by}, in the stage ")
    assert not result.complete and result.counts["pending"] > 0


def test_limits_of_boxes_time_and_memory_end_a_search_with_what_is_proven(client, dextar, cspace):
    run = dextar.solve("cspace", sigma=SIGMA, max_boxes=2000, client=client)
    expect_ended(run, "the box limit")
    assert json.loads(run._core.json())["boxes"]["processed"] == 2000
    expect_ended(dextar.solve("cspace", sigma=SIGMA, time_limit=1e-9, client=client), "the time limit")
    expect_ended(dextar.solve("cspace", sigma=SIGMA, memory_limit=3_000_000, client=client), "the memory limit")
    expect_same(cspace, dextar.solve("cspace", sigma=SIGMA, max_boxes=10**7, time_limit=1e6, client=client))


def test_a_limit_in_one_of_several_searches_leaves_the_others_pending(client, models):
    limited = corank.load(models / "dextar_limits.cuik")
    run = limited.solve("boundary", sigma=0.2, max_boxes=3, client=client)
    expect_ended(run, "the box limit")
    assert len(run._core.parts) > 1


def test_what_a_limit_has_left_goes_on_from_the_result_and_from_the_checkpoint(command_line, models, cspace, tmp_path):
    program = [sys.executable, "-m", "corank.cluster", "solve", "--workers", "1", "--quiet", "--unit-time", "0.02"]
    question = [str(models / "dextar.cuik"), "--set", "cspace", "--sigma", str(SIGMA), "-o", str(tmp_path / "part.h5")]
    done = subprocess.run([*program, *question, "--max-boxes", "1500"], capture_output=True, text=True, check=False)
    assert done.returncode == 3 and "stopped by the box limit" in done.stderr
    assert f"--resume {tmp_path / 'part.h5'}" in done.stderr
    expect_ended(corank.open(tmp_path / "part.h5"), "the box limit")
    # From the result: another limit, which leaves a checkpoint; from that to the end.
    kept = tmp_path / "kept"
    to_none = [*question[:-1], str(tmp_path / "none.h5")]
    status, error = command_line(*to_none, "--time-limit", "1e-9", "--checkpoint", str(kept))
    assert status == 3 and "stopped by the time limit" in error
    assert "to go on" not in error and not kept.exists()
    to_more = ["--resume", str(tmp_path / "part.h5"), "-o", str(tmp_path / "more.h5"), "--unit-time", "0.02"]
    status, error = command_line(*to_more, "--max-boxes", "500", "--checkpoint", str(kept))
    assert status == 3 and kept.exists() and f"--resume {kept}" in error
    status, error = command_line("--resume", str(kept), "-o", str(tmp_path / "whole.h5"), "--unit-time", "0.02")
    assert status == 0 and not kept.exists(), error
    expect_same(cspace, corank.open(tmp_path / "whole.h5"))
    assert corank.open(tmp_path / "part.h5").stopped
    # One process goes on from the result as well.
    corank_solve = pathlib.Path(os.environ["CORANK_BUILD_DIR"]) / "app" / "corank"
    if corank_solve.exists():
        arguments = ["solve", "--resume", str(tmp_path / "part.h5"), "-o", str(tmp_path / "alone.h5")]
        subprocess.run([str(corank_solve), *arguments], stdout=subprocess.DEVNULL, check=True)
        expect_same(cspace, corank.open(tmp_path / "alone.h5"))


def test_a_full_disk_leaves_the_last_good_checkpoint(dextar, tmp_path, capfd):
    options = corank.options.make_options(sigma=SIGMA)
    run = _corank.SpreadRun(_corank.Question(dextar._core, "cspace"), options, 0)
    run.begin(None)
    kept = cluster.Checkpoints(tmp_path / "kept", 60, [], [])
    kept.keep(run, now=True)
    good = (tmp_path / "kept").read_bytes()
    for unit in run.take_units(1):
        run.add(_corank.run_unit(run.prepared, unit, 2000, 0, 1))
    assert len(run.state()) > 2 * len(good)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writing fails, as on a full disk
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(good), limits[1]))
    try:
        kept.keep(run, now=True)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert "the last good one stays" in capfd.readouterr().err
    assert (tmp_path / "kept").read_bytes() == good and os.listdir(tmp_path) == ["kept"]
    assert cluster.Checkpoints.read(tmp_path / "kept").next_state(0)


def test_a_killed_client_resumes_to_the_same_file(command_line, dextar, models, tmp_path):
    sigma = 0.04  # more boxes: it is killed before its end
    cspace = dextar.solve("cspace", sigma=sigma)
    kept, result = tmp_path / "kept", tmp_path / "r.h5"
    program = [
        sys.executable,
        "-m",
        "corank.cluster",
        "solve",
        "--workers",
        "2",
        "--unit-time",
        "0.02",
        "--quiet",
        "--every",
        "0.01",
    ]
    question = [
        str(models / "dextar.cuik"),
        "--set",
        "cspace",
        "--sigma",
        str(sigma),
        "-o",
        str(result),
        "--checkpoint",
        str(kept),
    ]
    first = subprocess.Popen(program + question, stdout=subprocess.DEVNULL)
    while not kept.exists():
        try:
            assert first.wait(timeout=0.02) is None, "ended before it was killed"
        except subprocess.TimeoutExpired:
            pass
    first.kill()
    first.wait()
    assert not result.exists()
    shutil.copy(kept, tmp_path / "copy")
    status, error = command_line("--resume", str(kept), "--unit-time", "0.02", "--every", "0.01")
    assert status == 0, error
    assert not kept.exists()
    expect_same(cspace, corank.open(result))
    cspace.save(tmp_path / "one.h5")
    for part in ("/boxes", "/certificates", "/variables"):
        assert subprocess.run(["h5diff", str(tmp_path / "one.h5"), str(result), part], check=False).returncode == 0, part
    # One process goes on from there as well.
    corank_solve = pathlib.Path(os.environ["CORANK_BUILD_DIR"]) / "app" / "corank"
    if corank_solve.exists():
        arguments = ["solve", "--resume", str(tmp_path / "copy"), "-o", str(tmp_path / "alone.h5")]
        subprocess.run([str(corank_solve), *arguments], stdout=subprocess.DEVNULL, check=True)
        expect_same(cspace, corank.open(tmp_path / "alone.h5"))


def test_a_run_goes_on_from_its_checkpoint_and_another_question_does_not(client, dextar, cspace, tmp_path):
    options = corank.options.make_options(sigma=SIGMA)
    run = _corank.SpreadRun(_corank.Question(dextar._core, "cspace"), options, 0)
    run.begin(None)
    run.add(_corank.run_unit(run.prepared, run.take_units(1)[0], 500, 0, 1))
    cluster.Checkpoints(tmp_path / "kept", 60, ["--set", "cspace"], [("FILE", "m.cuik", "text")]).keep(run, now=True)
    known = cluster.Checkpoints.read(tmp_path / "kept")
    assert known.arguments == ["--set", "cspace"] and known.files == [("FILE", "m.cuik", "text")]
    expect_same(cspace, cluster.solve(dextar, client, "cspace", sigma=SIGMA, checkpoints=known))
    with pytest.raises(corank.ResultFileError, match="nothing to go on from"):
        known = cluster.Checkpoints.read(tmp_path / "kept")
        cluster.solve(dextar, client, "forward", sigma=SIGMA, checkpoints=known)


def test_bad_input_and_usage_have_the_exit_statuses_of_corank_solve(command_line, models):
    question = [str(models / "dextar.cuik"), "--set", "cspace"]
    status, error = command_line(*question, "--tls-cert", "c.pem")
    assert status == 1 and "TLS needs the files of the authority" in error
    status, error = command_line(*question, "--resume", "kept")
    assert status == 2 and "expected MODEL, or --resume FILE" in error


def test_a_client_that_finds_no_scheduler_is_gone_at_once():
    def clients():
        return sum(isinstance(thing, Client) for thing in gc.get_objects())

    gc.collect()  # earlier tests' clients
    before = clients()
    gc.disable()  # which may run at any time, also while another client begins
    try:
        with pytest.raises(cluster.ClusterError, match="no scheduler at tls://127.0.0.1:1: "):
            with cluster.remote_client("tls://127.0.0.1:1"):
                pass
        assert clients() == before
    finally:
        gc.enable()


def certificate(folder, name, authority=None):
    """The options of dask's that say so: of an authority of its own, or signed by another; of the folder alone."""
    new = ["openssl", "req", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={name}", "-keyout", f"{name}.key"]
    if authority is None:
        steps = [[*new, "-x509", "-days", "2", "-out", f"{name}.pem"]]
    else:
        signed = ["openssl", "x509", "-req", "-days", "2", "-in", f"{name}.csr", "-out", f"{name}.pem"]
        steps = [
            [*new, "-out", f"{name}.csr"],
            [*signed, "-CA", f"{authority}.pem", "-CAkey", f"{authority}.key", "-CAcreateserial"],
        ]
    for step in steps:
        subprocess.run(step, cwd=folder, check=True, capture_output=True)
    return ["--tls-cert", str(folder / f"{name}.pem"), "--tls-key", str(folder / f"{name}.key")]


@pytest.mark.skipif(shutil.which("openssl") is None, reason="no openssl: there is no certificate to test TLS with")
def test_by_tls_only_who_has_a_certificate_of_the_authority_is_served(command_line, models, cspace, tmp_path):
    certificate(tmp_path, "authority")
    mine, others = certificate(tmp_path, "me", "authority"), certificate(tmp_path, "other")
    authority = str(tmp_path / "authority.pem")
    dask, known = [sys.executable, "-m", "dask"], tmp_path / "scheduler.json"
    started = []
    try:
        with open(tmp_path / "log", "w", encoding="utf-8") as log:
            for command in (
                ["scheduler", "--host", "127.0.0.1", "--port", "0", "--protocol", "tls"],
                ["worker", "--host", "127.0.0.1", "--nthreads", "1", "--local-directory", str(tmp_path)],
            ):
                where = ["--scheduler-file", str(known), "--no-dashboard", "--tls-ca-file", authority, *mine]
                started.append(subprocess.Popen([*dask, *command, *where], stdout=log, stderr=log))
        while not known.exists() or not known.read_text():
            try:
                assert started[0].wait(timeout=0.02) is None, (tmp_path / "log").read_text()
            except subprocess.TimeoutExpired:
                pass
        address = json.loads(known.read_text())["address"]
        assert address.startswith("tls://127.0.0.1:")
        result = tmp_path / "r.h5"
        question = [str(models / "dextar.cuik"), "--set", "cspace", "--sigma", str(SIGMA), "-o", str(result)]
        question += ["--scheduler", address]
        for refused in ([], ["--tls-ca", authority, *others]):
            status, error = command_line(*question, *refused)
            assert status == 1 and "no scheduler at tls://" in error and not result.exists()
        program = [sys.executable, "-m", "corank.cluster", "solve", "--quiet", *question]
        done = subprocess.run([*program, "--tls-ca", authority, *mine], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        expect_same(cspace, corank.open(result))
    finally:
        for process in started:
            process.kill()
            process.wait()
