"""The command line: corank solve's options, and those of a cluster."""

from __future__ import annotations

import argparse
import os
import sys
from typing import ContextManager, List, Optional, Sequence, Tuple

from distributed import Client

from .. import _corank, mechanism
from ..errors import ModelError, OptionError, ResultFileError
from ..result import Result
from .engine import Checkpoints, solve
from .local import local_client, remote_client, security
from .parts_command import add_map, add_sweep
from .units import ClusterError, Plan

DONE, BAD_INPUT, USAGE, INCOMPLETE = 0, 1, 2, 3  # corank solve's exit statuses


def _seconds(text: str) -> float:
    units = {"s": 1, "m": 60, "h": 3600}
    value = float(text[:-1]) * units[text[-1]] if text[-1:] in units else float(text)
    if not 0 < value < 1e8:
        raise ValueError(text)
    return value


def _positive(text: str) -> int:
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def _bytes(text: str) -> int:
    units = {"K": 1 << 10, "M": 1 << 20, "G": 1 << 30, "T": 1 << 40}
    number = text.upper().removesuffix("B")
    value = float(number[:-1]) * units[number[-1]] if number[-1:] in units else float(number)
    if not 0 <= value < 1e18:
        raise ValueError(text)
    return int(value)


def _limit(text: str) -> float:
    if not 0 <= float(text) < 1e8:
        raise ValueError(text)
    return float(text)


def _count(text: str) -> int:
    if int(text) < 0:
        raise ValueError(text)
    return int(text)


_bytes.__name__, _limit.__name__, _count.__name__ = "size such as 800M or 8G", "number of seconds", "number from 0"
_seconds.__name__, _positive.__name__ = "time such as 60s, 10m or 1h", "number from 1"


def _question() -> argparse.ArgumentParser:
    """Those of corank solve, which checkpoints keep."""
    p = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    p.add_argument(
        "file", nargs="?", metavar="MODEL", help="equations (.cuik), parts (.cuik with [LINKS], or .world) or URDF (.urdf)"
    )
    p.add_argument("--loops", metavar="FILE.loops", help="companion of a URDF file")
    p.add_argument("--set", choices=[s[0] for s in _corank.sets] + ["nodes"])
    p.add_argument("--kernel", choices=["right", "left"])
    p.add_argument("--corank", type=_positive, default=1, metavar="C")
    p.add_argument("--outputs", metavar="NAME[,NAME...]")
    p.add_argument("-D", dest="constants", action="append", default=[], metavar="NAME=EXPR", help="may be repeated")
    p.add_argument("--sigma", type=float, help="as for corank solve, like the other options of this part")
    p.add_argument("--sigma-length", type=float)
    p.add_argument("--sigma-angle", type=float)
    p.add_argument("--tolerance", type=float)
    p.add_argument("--digits", type=int, default=0)
    p.add_argument("--proof", action="store_true")
    p.add_argument("-o", dest="output", metavar="RESULT.h5|.sol")
    return p


def _where() -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    where = p.add_argument_group("the cluster")
    where.add_argument(
        "--workers",
        type=_positive,
        metavar="N",
        help="number of worker processes on this machine; default: one for each core",
    )
    where.add_argument("--host", default="127.0.0.1", help="where their scheduler listens; default: loopback")
    where.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="use this scheduler and its workers instead: tcp://HOST:PORT or tls://HOST:PORT",
    )
    where.add_argument("--tls-ca", metavar="FILE.pem", help="encrypt and authenticate by TLS: the authority's certificate")
    where.add_argument("--tls-cert", metavar="FILE.pem")
    where.add_argument("--tls-key", metavar="FILE.pem")
    where.add_argument(
        "--dashboard", type=int, metavar="PORT", help="show dask's dashboard at this port; not with --scheduler; needs bokeh"
    )
    where.add_argument("--quiet", action="store_true", help="do not show progress")
    return p


def _parser() -> argparse.ArgumentParser:
    program = argparse.ArgumentParser(
        prog="python3 -m corank.cluster",
        description=(
            "Searches on many machines by dask.distributed. Exit status: 0 done and complete, 1 bad input or a cluster that "
            "cannot do the work, 2 wrong usage, 3 ended early."
        ),
    )
    subcommands = program.add_subparsers(dest="command", required=True)
    add_map(subcommands, [_where()])
    add_sweep(subcommands, [_where()])
    sub = subcommands.add_parser(
        "solve",
        parents=[_question(), _where()],
        allow_abbrev=False,
        help="corank solve by workers, with the same boxes",
        epilog="Example: python3 -m corank.cluster solve models/dextar.cuik --set cspace --sigma 0.01 --workers 2 -o cspace.h5",
    )
    sub.add_argument("--json", metavar="FILE", help="write a summary to this file")
    how = sub.add_argument_group("units")
    how.add_argument("--unit-time", type=_seconds, default=1.0, help="longest time of one unit; default: 1s")
    how.add_argument("--threads", type=_positive, default=1, help="number of threads of one unit; default: 1")
    how.add_argument(
        "--hang-time", type=_seconds, help="give a unit to another worker, too, if there is no answer after this time"
    )
    limits = sub.add_argument_group("limits", "End this run early; --resume goes on from its checkpoint or .h5 result.")
    limits.add_argument("--time-limit", type=_limit, default=0.0, metavar="SECONDS", help="0: no limit (default)")
    limits.add_argument("--max-boxes", type=_count, default=0, metavar="N", help="processed boxes; 0: no limit (default)")
    limits.add_argument(
        "--memory-limit",
        type=_bytes,
        metavar="BYTES",
        help="memory of the client; 0: no limit; default: three quarters of the machine's memory",
    )
    keep = sub.add_argument_group("checkpoints")
    keep.add_argument(
        "--checkpoint", metavar="FILE", help="store the state of the run from time to time; a complete run removes the file"
    )
    keep.add_argument("--every", type=_seconds, default=60.0, help="time between two checkpoints; default: 60s")
    keep.add_argument(
        "--resume",
        metavar="FILE",
        help="go on from a checkpoint, also from one of corank solve; without MODEL and its options",
    )
    return program


def _arguments(args: argparse.Namespace) -> List[str]:
    """As corank solve would keep them."""
    kept: List[str] = []
    for option in ("set", "kernel", "outputs", "sigma", "sigma_length", "sigma_angle", "tolerance"):
        value = getattr(args, option)
        if value is not None:
            kept += [f"--{option.replace('_', '-')}", repr(value) if isinstance(value, float) else value]
    kept += ["--corank", str(args.corank)] if args.corank != 1 else []
    kept += ["--digits", str(args.digits)] if args.digits else []
    kept += ["--proof"] if args.proof else []
    for constant in args.constants:
        kept += ["-D", constant]
    return kept + (["-o", os.path.abspath(args.output)] if args.output else [])


def _files(args: argparse.Namespace) -> List[Tuple[str, str, str]]:
    files = []
    for option, path in (("FILE", args.file), ("--loops", args.loops)):
        if path is not None:
            with open(path, encoding="utf-8", newline="") as file:
                files.append((option, os.path.abspath(path), file.read()))
    return files


def _resumed(args: argparse.Namespace, parser: argparse.ArgumentParser) -> Checkpoints:
    """Puts the former run's question into the arguments."""
    asked = [
        a
        for a in ("file", "loops", "set", "kernel", "outputs", "sigma", "sigma_length", "sigma_angle", "tolerance")
        if getattr(args, a) is not None
    ]
    if asked or args.constants:
        parser.error(f"--resume: its file holds the model and the question; expected no {(asked + ['-D'])[0]}")
    known = Checkpoints.read(args.resume, args.every)
    former, unknown = _question().parse_known_args(known.arguments)
    ignored = [u for u in unknown if u.startswith("-") and u != "--threads"]
    if ignored:
        raise ResultFileError(f"{args.resume}: the former run had options that a cluster does not have: {' '.join(ignored)}")
    for name, value in vars(former).items():
        if name not in ("output", "digits", "file") or not getattr(args, name):
            setattr(args, name, value)
    from_result = args.resume.endswith(".h5")
    known.path = args.checkpoint or (None if from_result else args.resume)
    return known


def _model(args: argparse.Namespace, files: Sequence[Tuple[str, str, str]]) -> mechanism.Mechanism:
    texts = {option: (text, path, os.path.dirname(path)) for option, path, text in files}
    pairs = [(name, value) for name, _, value in (d.partition("=") for d in args.constants)]
    return mechanism.Mechanism._of(_corank.parse(texts["FILE"], texts.get("--loops"), pairs))


def _solve(args: argparse.Namespace, parser: argparse.ArgumentParser) -> Result:
    if args.resume:
        checkpoints = _resumed(args, parser)
        files: Sequence[Tuple[str, str, str]] = checkpoints.files
    else:
        files = _files(args)
        checkpoints = Checkpoints(args.checkpoint, args.every, _arguments(args), files)
    checkpoints.into_result = bool(args.output and args.output.endswith(".h5"))
    model = _model(args, files)
    with _client(args) as client:
        result = solve(
            model,
            client,
            args.set,
            kernel=args.kernel,
            corank=args.corank,
            outputs=args.outputs.split(",") if args.outputs else (),
            tolerance=args.tolerance,
            digits=args.digits,
            sigma=args.sigma,
            sigma_length=args.sigma_length,
            sigma_angle=args.sigma_angle,
            proof=args.proof,
            time_limit=args.time_limit,
            max_boxes=args.max_boxes,
            memory_limit=args.memory_limit,
            plan=Plan(args.unit_time, args.threads, args.hang_time),
            checkpoints=checkpoints,
            progress=False if args.quiet else None,
        )
    _corank.keep_to_the_end(result._core)
    if args.output:
        result.save(args.output)
    if result.complete and result.stopped is None and checkpoints.path and os.path.exists(checkpoints.path):
        os.remove(checkpoints.path)
    return result


def _client(args: argparse.Namespace) -> ContextManager[Client]:
    tls = security(args.tls_ca, args.tls_cert, args.tls_key)
    if args.scheduler:
        return remote_client(args.scheduler, tls)
    return local_client(args.workers or os.cpu_count() or 1, host=args.host, dashboard=args.dashboard, tls=tls)


def _parts(args: argparse.Namespace) -> int:
    try:
        with _client(args) as client:
            return args.run(args, client)
    except KeyboardInterrupt:
        print("corank.cluster: ended early", file=sys.stderr)
        return INCOMPLETE
    except (ModelError, OptionError, ClusterError, OSError, ValueError) as error:
        print(f"corank.cluster: {error}", file=sys.stderr)
        return BAD_INPUT


def _holds_a_state(path: Optional[str]) -> bool:
    try:
        return path is not None and path.endswith(".h5") and bool(Checkpoints.read(path))
    except ResultFileError:
        return False


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Returns the exit status."""
    parser = _parser()
    args = parser.parse_args(arguments)
    if args.command != "solve":
        return _parts(args)
    if (args.file is None) == (args.resume is None):
        parser.error("expected MODEL, or --resume FILE")
    kept = args.checkpoint or args.resume
    try:
        result = _solve(args, parser)
        if args.json:
            with open(args.json, "w", encoding="utf-8") as file:
                file.write(result._core.json() + "\n")
        print(result._core.table(), end="")
        if result.complete and result.stopped is None:
            return DONE
        print(f"corank.cluster: stopped by {result.stopped or 'a limit'}", file=sys.stderr)
        status = INCOMPLETE
        if not (kept and os.path.exists(kept)):
            kept = args.output if _holds_a_state(args.output) else None
    except KeyboardInterrupt:
        print("corank.cluster: ended early", file=sys.stderr)
        status = INCOMPLETE
    except (ModelError, OptionError, ClusterError, OSError, ValueError) as error:
        print(f"corank.cluster: {error}", file=sys.stderr)
        status = BAD_INPUT
    if kept and os.path.exists(kept):
        print(f"corank.cluster: to go on: python3 -m corank.cluster solve --resume {kept}", file=sys.stderr)
    return status
