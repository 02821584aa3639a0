"""Results: the boxes that enclose a set, and what is proven of them."""

from __future__ import annotations

import functools
import json
import os
import tempfile
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Tuple, Union

from . import _corank, notebook, plotting
from .errors import deliver, in_python
from .optional import require
from .point import Interval, Point
from .progress import ProgressOption, Shown

if TYPE_CHECKING:
    import numpy as np
    import pandas

    from .mechanism import Mechanism
else:
    from .optional import numpy as np

PathLike = Union[str, "os.PathLike[str]"]


class Angle(NamedTuple):
    """An angle and the variables that stand for it; its range in radians."""

    cosine: str
    sine: str
    range: Interval


class Sigma(NamedTuple):
    """The largest edge of a box of proven solutions: in lengths, in the model's unit, and in sines and cosines."""

    length: float
    angle: float


class Verification(NamedTuple):
    """What the independent checker found.

    verified: every claim of the result holds. complete: and it is proven that its boxes hold all solutions. report: counts
    and failures, as `corank verify --json` prints them. text: the same as a table.
    """

    verified: bool
    complete: bool
    report: Dict[str, Any]
    text: str

    def __str__(self) -> str:
        return self.text

    def __bool__(self) -> bool:
        return self.verified


class Result:
    """A set as n boxes over named variables. Every solution in the search domain is in a box, where `complete`.

    Arrays are views of the result's own memory, which they keep alive; they cannot be written to. ``result["x"]`` is the
    array of shape (n, 2) of a variable, or of an angle in radians.
    """

    def __init__(self, core: _corank.Result) -> None:
        self._core = core
        self._angle_enclosures: Dict[Tuple[str, bool], np.ndarray] = {}
        self._points: Optional[List[Point]] = None

    # --- the boxes ---

    @property
    def boxes(self) -> np.ndarray:
        """float64 of shape (n, variables, 2): lower and upper end of each side, not copied, read-only. Lengths are in the
        model's unit; angles are there as cosine and sine."""
        return self._arrays["bounds"]

    @property
    def variables(self) -> List[str]:
        """The names of the boxes' sides: the configuration's first, then kernel vectors and auxiliary variables."""
        return [v[0] for v in self._core.variables]

    @property
    def kinds(self) -> Dict[str, str]:
        """Of each variable what it is: length, cosine, sine, kernel or auxiliary."""
        return {v[0]: v[1] for v in self._core.variables}

    @property
    def domain(self) -> Dict[str, Interval]:
        """Of each variable where it was searched."""
        return {v[0]: Interval(v[2], v[3]) for v in self._core.variables}

    @functools.cached_property
    def _arrays(self) -> Dict[str, np.ndarray]:
        require("numpy")
        return self._core.boxes()

    @property
    def kernel_unknowns(self) -> List[str]:
        """The variables that are components of kernel vectors."""
        return [name for name, kind in self.kinds.items() if kind == "kernel"]

    @property
    def angles(self) -> Dict[str, Angle]:
        """The angles of the model, by name."""
        names = self.variables
        return {a[0]: Angle(names[a[1]], names[a[2]], Interval(a[3], a[4])) for a in self._core.angles}

    @property
    def coordinates(self) -> List[str]:
        """The model's coordinates: lengths and angles, without kernel vectors and auxiliary variables."""
        configuration = self.variables[: self._core.configuration_size]
        hidden = {n for a in self.angles.values() for n in (a.cosine, a.sine)}
        lengths = [n for n in configuration if n not in hidden and self.kinds[n] == "length"]
        return lengths + [name for name, a in self.angles.items() if a.cosine in configuration]

    @property
    def verdicts(self) -> np.ndarray:
        """What is proven of each box, as words: an array of n strings; doc/certificates.md says what each means."""
        return np.array(_corank.verdicts)[self._arrays["verdict"]]

    @property
    def verdict_codes(self) -> np.ndarray:
        """The same as uint8 of shape (n,), not copied: indices of corank.VERDICTS."""
        return self._arrays["verdict"]

    @property
    def counts(self) -> Dict[str, int]:
        """How many boxes have each verdict; those that none has are left out."""
        return {word: k for word, k in zip(_corank.verdicts, self._core.counts) if k}

    @property
    def reasons(self) -> np.ndarray:
        """Why boxes are undecided, as words: an array of n strings, "none" of the others. No claim."""
        return np.array(_corank.reasons)[self._arrays["reason"]]

    @property
    def free(self) -> np.ndarray:
        """bool of shape (n, variables), not copied: is the variable free in the box? For every value of the free variables
        in a `regular` box there is exactly one solution in it."""
        return self._arrays["free"]

    @property
    def types(self) -> Dict[str, np.ndarray]:
        """Of each type of singularity that was asked for, such as "RO": in which boxes every solution has it; bool, (n,)."""
        bits = self._arrays["types_proven"]
        return {t: (bits >> k & 1).astype(bool) for k, t in enumerate(_corank.types) if self._core.types_asked >> k & 1}

    @property
    def excluded_types(self) -> Dict[str, np.ndarray]:
        """The same of types that no solution in the box has."""
        bits = self._arrays["types_excluded"]
        return {t: (bits >> k & 1).astype(bool) for k, t in enumerate(_corank.types) if self._core.types_asked >> k & 1}

    @property
    def kernel_at_most(self) -> np.ndarray:
        """The kernel's dimension at every solution in the box, at most; int32, (n,), not copied. −1: not known."""
        return self._arrays["kernel_at_most"]

    @property
    def passages(self) -> np.ndarray:
        """Of a workspace boundary: "barrier", "traversable" or "unproven" for each box, an array of n strings."""
        return np.array(_corank.passages)[self._arrays["passage"]]

    def __getitem__(self, name: str) -> np.ndarray:
        if name in self._core_angle_names:
            return self._enclosures(name, False)
        return self.boxes[:, self._index(name), :]

    def __len__(self) -> int:
        return sum(self._core.counts)

    # --- its points ---

    @property
    def points(self) -> List[Point]:
        """The solutions of a set of dimension 0, each once; empty for other sets."""
        if self._points is None:
            self._points = [Point(self, k) for k in range(len(self._point_arrays["verdict"]))]
        return list(self._points)

    @property
    def exact_points(self) -> List[Dict[str, Any]]:
        """Points of any set that are known exactly, such as those where the kernel's dimension is 2: of each variable its
        value as a number of SymPy."""
        from . import exact

        return [exact.coordinates(p) for p in self._core.exact_points]

    @property
    def _point_arrays(self) -> Dict[str, np.ndarray]:
        require("numpy")
        return self._core.points()

    @property
    def _point_verdicts(self) -> np.ndarray:
        return np.array(_corank.verdicts)[self._point_arrays["verdict"]]

    def _point_angles(self, name: str) -> np.ndarray:
        return self._enclosures(name, True)

    # --- the whole ---

    @property
    def model(self) -> str:
        """The mechanism's name."""
        return self._core.model

    @property
    def mechanism(self) -> "Mechanism":
        """The mechanism as the result has it, with its constants put in."""
        from .mechanism import Mechanism

        text = (self._core.model_text, self._core.model + ".cuik", "")
        return Mechanism._of(_corank.parse(text, None, self._core.constants))

    @property
    def set(self) -> str:
        """The name of the set; "system" for a plain system."""
        return self._core.set

    @property
    def complete(self) -> bool:
        """Is every solution in the search domain in a box? False where a limit or Ctrl-C ended the search."""
        return self._core.complete

    @property
    def stopped(self) -> Optional[str]:
        """What ended the run early, and in which stage; None where it ran to its end."""
        return self._core.stopped or None

    @property
    def assembled(self) -> Optional[bool]:
        """Can the robot be assembled within its ranges at all? True: a configuration is proven to exist (`sample`). False: it
        is proven that there is none, so that every set is empty. None: neither is known, or it is a plain system."""
        return self._core.assembled

    @property
    def sample(self) -> Optional[Dict[str, Interval]]:
        """A configuration that is proven to exist, as intervals by coordinate, angles in radians; None where none is known.
        It was looked for where the set itself is empty; else it is in the first of the set's proven boxes."""
        found = self._core.sample
        return None if found is None else {name: Interval(lo, hi) for name, lo, hi in found}

    @property
    def nearly_solved(self) -> bool:
        """A hint, of an empty set: are there solutions once the coefficients that are no integers are taken within 1e-6 of
        their size? Then `tolerance=1e-6` finds what decimals mean that somebody rounded."""
        return self._core.nearly_solved

    @property
    def sigma(self) -> Sigma:
        """The largest edge of a box of proven solutions."""
        return Sigma(*self._core.sigma)

    @property
    def dimension(self) -> int:
        """Of the set: 0 for points, 1 for curves …"""
        return self._core.dimension

    @property
    def has_proof(self) -> bool:
        """Does it hold the script of the search, with which verify() shows that no solution is missing?"""
        return self._core.has_proof

    @property
    def motions(self) -> List[str]:
        """Self-motions, each in words."""
        return list(self._core.motions)

    @property
    def parts(self) -> List["Result"]:
        """Of a set that is solved in parts (a workspace's boundary, or a union): a result of each, whose name is `part`."""
        return [Result(part) for part in self._core.parts]

    @property
    def part(self) -> str:
        """Which part of a set it is, "theta2 at its upper limit" or "psi1 = theta1"; "" of a whole."""
        return str(self._core.part)

    @property
    def summary(self) -> Dict[str, Any]:
        """Counts, options, points, times: what `corank solve --json` prints."""
        return json.loads(self._core.json())

    @property
    def system_text(self) -> str:
        """The polynomial system that was solved, in the model language."""
        return self._core.system_text

    def words(self) -> Dict[str, Any]:
        """What a report says of the set: its title, meaning, finding, and what is proven and unproven, as HTML sentences."""
        return self._core.words()

    # --- what to do with it ---

    def to_pandas(self, angles: bool = False, kernel: bool = False) -> "pandas.DataFrame":
        """A data frame with a row for each box: its verdict, and of each variable NAME_mid, NAME_lo and NAME_hi: the
        middle and the ends of its side.

        Args:
            angles: those of each angle, in radians, too.
            kernel: those of the kernel vectors' components, too.
        """
        pandas = require("pandas")

        hidden = () if kernel else self.kernel_unknowns
        shown = [k for k, name in enumerate(self.variables) if name not in hidden]
        sides = {self.variables[k]: self.boxes[:, k, :] for k in shown}
        if angles:
            sides.update({name: self[name] for name in self.angles})
        verdicts = pandas.Categorical.from_codes(self._arrays["verdict"].astype("int8"), _corank.verdicts)
        columns: Dict[str, Any] = {"verdict": verdicts}
        for name, ends in sides.items():
            columns[f"{name}_mid"] = 0.5 * ends[:, 0] + 0.5 * ends[:, 1]
            columns[f"{name}_lo"], columns[f"{name}_hi"] = ends[:, 0], ends[:, 1]
        return pandas.DataFrame(columns)

    def save(self, path: PathLike) -> None:
        """Writes a result file: HDF5, every double bit for bit, or the CUIK suite's layout where the name ends in .sol."""
        self._core.save(os.fspath(path))

    def verify(self, threads: int = 0, progress: ProgressOption = None) -> Verification:
        """Checks every box against the model with code that shares nothing with the solver, and, where the result has its
        proof, that no solution is missing.

        Args:
            threads: 0: one for each core.

        Raises:
            Interrupted: with what had been checked.
        """
        with Shown(progress) as show:
            report, table, verified, complete, raised = self._core.verify(threads, show)
        return deliver(Verification(verified, complete, json.loads(report), table), raised)

    def plot(self, *axes: str, ax: Any = None, color: str = "set", **style: Any) -> Any:
        """Draws the boxes into matplotlib's axes, over two coordinates, or three of 3-D axes; see corank.plot()."""
        return plotting.plot([self], *axes, ax=ax, color=color, **style)

    def portrait(self, path: PathLike, *axes: str, color: str = "set", title: str = "", width_mm: float = 85) -> None:
        """Writes a picture for a paper, .svg, .pdf or .png: no box is left out, and as few shapes as can be."""
        _corank.write_portrait(os.fspath(path), [self._core], list(axes), color, title, width_mm)

    def page(self) -> "notebook.Page":
        """A report of this set alone as one HTML page; a notebook shows it with its 3-D view and its moving mechanism."""
        return notebook.Page(_corank.report_page([self._core], "", [], [], None))

    def show(self, height: int = 600) -> "notebook.Page":
        """The same, for the end of a notebook's cell. `height`: in pixels."""
        page = self.page()
        page.height = height
        return page

    # --- inner ---

    def _index(self, name: str) -> int:
        try:
            return self.variables.index(name)
        except ValueError:
            raise KeyError(
                f"{name}: the variables are {', '.join(self.variables)}; angles: {', '.join(self.angles)}"
            ) from None

    @property
    def _core_angle_names(self) -> List[str]:
        return [a[0] for a in self._core.angles]

    def _enclosures(self, name: str, of_points: bool) -> np.ndarray:
        if (name, of_points) not in self._angle_enclosures:
            require("numpy")
            self._angle_enclosures[name, of_points] = self._core.angle_enclosures(name, of_points)
        return self._angle_enclosures[name, of_points]

    def _type_names(self, bits: int) -> Tuple[str, ...]:
        return tuple(t for k, t in enumerate(_corank.types) if bits >> k & 1)

    def __str__(self) -> str:
        return in_python(self._core.table())

    def __repr__(self) -> str:
        counts = ", ".join(f"{n} {word}" for word, n in self.counts.items())
        state = "complete" if self.complete else f"incomplete, stopped by {self.stopped or 'a limit'}"
        return f"<corank result: {self.model}, {self.set}: {len(self)} boxes ({counts or 'the set is empty'}), {state}>"

    def _repr_html_(self) -> str:
        return notebook.result_html(self)

    def __reduce__(self) -> Any:
        return _from_bytes, (_to_bytes(self),)


def _to_bytes(result: Result) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "result.h5")
        result.save(path)
        with open(path, "rb") as file:
            return file.read()


def _from_bytes(data: bytes) -> Result:
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "result.h5")
        with open(path, "wb") as file:
            file.write(data)
        return open_result(path)


def open_result(path: PathLike) -> Result:
    """Reads a result file (.h5). It may be a stranger's: reading it does no harm; verify() says whether it is true.

    Raises:
        ResultFileError: where it is missing, damaged, or something else.
    """
    return Result(_corank.read_result(os.fspath(path)))
