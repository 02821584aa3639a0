"""The command line of maps and families, whose parts are independent."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any, Callable, Dict, List, Tuple

from distributed import Client

from .. import _corank, mechanism
from ..errors import Interrupted
from ..mechanism import Mechanism

_DONE, _INCOMPLETE = 0, 3


def _model(p: argparse.ArgumentParser) -> None:
    p.add_argument("file", metavar="MODEL", help="equations (.cuik), parts (.cuik with [LINKS], or .world) or URDF (.urdf)")
    p.add_argument("--loops", metavar="FILE.loops", help="companion of a URDF file")
    p.add_argument("-D", dest="constants", action="append", default=[], metavar="NAME=EXPR", help="may be repeated")


def _pairs(texts: List[str], option: str) -> Dict[str, str]:
    pairs = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not (name and equals and value):
            raise ValueError(f"{option} {text}: expected NAME=EXPR")
        pairs[name] = value
    return pairs


def _range(text: str, option: str) -> List[str]:
    ends = text.split(":")
    if len(ends) != 2 or not all(ends):
        raise ValueError(f"{option} {text}: expected FROM:TO")
    return ends


def _loaded(args: argparse.Namespace, constants: Dict[str, str]) -> Mechanism:
    return mechanism.load(args.file, args.loops, **constants)


def _or_partial(work: Callable[[], Any]) -> Any:
    """What comes of it; where it is ended early, what was proven by then."""
    try:
        return work()
    except Interrupted as early:
        print("corank.cluster: ended early", file=sys.stderr)
        return early.result


def add_map(subcommands: Any, parents: List[argparse.ArgumentParser]) -> None:
    """corank map's options."""
    p = subcommands.add_parser(
        "map",
        parents=parents,
        allow_abbrev=False,
        help="corank map by workers, with the same cells",
        epilog="Example: python3 -m corank.cluster map models/dextar.cuik --over J3x=-1:2 --over J3y=-2:2 --workers 2 -o m.json",
    )
    _model(p)
    p.add_argument("--over", action="append", default=[], required=True, metavar="NAME=FROM:TO", help="required twice")
    p.add_argument("--fix", action="append", default=[], metavar="NAME=EXPR", help="a coordinate that keeps one value")
    p.add_argument("--set", choices=[s[0] for s in _corank.sets])
    p.add_argument("--count", default="solutions", help="as for corank map, like the other options of this part")
    p.add_argument("--resolution", type=int, default=64)
    p.add_argument("--no-boundary", action="store_true")
    p.add_argument("-o", dest="output", metavar="FILE.json|.csv|.svg|.pdf|.png")
    p.set_defaults(run=_run_map)


def _run_map(args: argparse.Namespace, client: Client) -> int:
    if args.output and not args.output.endswith((".json", ".csv", ".svg", ".pdf", ".png")):
        raise ValueError(f"-o {args.output}: expected a file name that ends in .json, .csv, .svg, .pdf or .png")
    over: Dict[str, Any] = {name: _range(ends, "--over") for name, ends in _pairs(args.over, "--over").items()}
    model = _loaded(args, _pairs(args.constants, "-D"))
    result = _or_partial(
        lambda: model.map(
            over,
            set=args.set,
            fixed=dict(_pairs(args.fix, "--fix")),
            count=args.count,
            resolution=args.resolution,
            boundary=not args.no_boundary,
            client=client,
            progress=False if args.quiet else None,
        )
    )
    if args.output and args.output.endswith(".json"):
        with open(args.output, "w", encoding="utf-8") as file:
            json.dump(result.data, file)
    elif args.output and args.output.endswith(".csv"):
        result.to_pandas().to_csv(args.output, index=False)
    elif args.output:
        result.plot().figure.savefig(args.output, bbox_inches="tight")
    print(result, end="")
    return _DONE if result.complete else _INCOMPLETE


def add_sweep(subcommands: Any, parents: List[argparse.ArgumentParser]) -> None:
    """corank sweep's options."""
    p = subcommands.add_parser(
        "sweep",
        parents=parents,
        allow_abbrev=False,
        help="corank sweep by workers, each search by one worker",
        epilog="Example: python3 -m corank.cluster sweep models/dextar.cuik -D l2=1.6:0.9:8 --workers 2 -o family",
    )
    _model(p)
    p.add_argument(
        "--sets", default="cspace,forward,inverse", help="as for corank sweep, like the other options of this part"
    )
    p.add_argument("--sigma", type=float)
    p.add_argument("--cspace-sigma", type=float)
    p.add_argument("--threads", type=int, default=1, help="number of threads of each search; default: 1")
    p.add_argument("-o", dest="output", metavar="FOLDER", help="default: MODEL-sweep")
    p.set_defaults(run=_run_sweep)


def _family(texts: List[str]) -> Tuple[str, List[str], int, List[str]]:
    """The swept constant, its ends, how many values; and the other definitions."""
    swept = [t for t in texts if ":" in t]
    if len(swept) != 1:
        raise ValueError("a constant to sweep is required: -D NAME=FROM:TO:COUNT, exactly one")
    ((name, text),) = _pairs(swept, "-D").items()
    ends = text.split(":")
    if len(ends) != 3 or not all(ends) or not ends[2].isdigit() or not 2 <= int(ends[2]) <= 200:
        raise ValueError(f"-D {swept[0]}: expected NAME=FROM:TO:COUNT, COUNT from 2 to 200")
    return name, ends[:2], int(ends[2]), [t for t in texts if t is not swept[0]]


def _run_sweep(args: argparse.Namespace, client: Client) -> int:
    from ..expression import linspace

    name, ends, count, others = _family(args.constants)
    values = linspace(ends[0], ends[1], count)
    model = _loaded(args, _pairs(others, "-D"))
    family = _or_partial(
        lambda: model.sweep(
            name,
            values,
            sets=args.sets.split(","),
            sigma=args.sigma,
            cspace_sigma=args.cspace_sigma,
            threads=args.threads,
            client=client,
            progress=False if args.quiet else None,
        )
    )
    if len(family) == 0:
        return _INCOMPLETE
    print(family.report(args.output or f"{model.name}-sweep").path)
    return _DONE if family.complete else _INCOMPLETE
