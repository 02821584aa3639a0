"""Results: the boxes that enclose a set, and what is proven about them."""

from __future__ import annotations

import functools
import json
import os
import tempfile
from typing import TYPE_CHECKING, Any, Callable, Dict, List, NamedTuple, Optional, Tuple, Union

from . import _corank, exact, notebook, plotting
from .errors import deliver, in_python
from .optional import require
from .options import make_options
from .point import Interval, Point
from .progress import ProgressOption, Shown

if TYPE_CHECKING:
    import numpy as np
    import pandas

    from .mechanism import Mechanism
else:
    from .optional import numpy as np

PathLike = Union[str, "os.PathLike[str]"]

#: Makes the mechanism of a result. mechanism.py, which imports this module, sets it.
_mechanism_of: Callable[[_corank.Model], "Mechanism"]


class Angle(NamedTuple):
    """The two variables that stand for an angle, and its range in radians."""

    cosine: str
    sine: str
    range: Interval


class Sigma(NamedTuple):
    """The largest edge of a box of proven solutions: in lengths, in the model's unit, and in sines and cosines."""

    length: float
    angle: float


class Verification(NamedTuple):
    """What the independent checker found.

    verified: every claim of the result holds. complete: it is also proven that the boxes hold all solutions. report: counts
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


def verification(text: str, table: str) -> Verification:
    """Of the JSON text and the table that the checker gives."""
    report = json.loads(text)
    return Verification(report["verified"], report["complete"], report, table)


class Certified:
    """What an analysis has found with its proofs, if they were asked for."""

    _file: Any = None
    _missing = "there is no certificate: expected certificate=True"

    def _need(self) -> Any:
        if self._file is None:
            raise ValueError(self._missing)
        return self._file

    def save(self, path: PathLike) -> None:
        """Writes the claims with their proofs (.h5), which `corank verify` checks. Raises ValueError if certificate=True was
        not given."""
        self._need().write(os.fspath(path))

    def verify(self, threads: int = 0, *, progress: ProgressOption = None) -> Verification:
        """Checks the claims with code that shares nothing with the code that found them. verified: every lower bound is
        confirmed; complete: every upper bound, too. Raises ValueError if certificate=True was not given."""
        with Shown(progress) as show:
            text, table, raised = self._need().verify(threads, show)
        return deliver(verification(text, table), raised)


class Result:
    """A set, enclosed in n boxes over named variables. If `complete`, every solution in the search domain is in a box.

    Arrays are read-only views of the result's own memory, which they keep alive. ``result["x"]`` is the array of shape
    (n, 2) of a variable, or of an angle in radians.
    """

    def __init__(self, core: _corank.Result) -> None:
        self._core = core
        self._angle_enclosures: Dict[Tuple[str, bool], np.ndarray] = {}
        self._points: Optional[List[Point]] = None

    # --- the boxes ---

    @property
    def boxes(self) -> np.ndarray:
        """The boxes: float64 of shape (n, variables, 2), the lower and upper end of each side; not copied, read-only.
        Lengths are in the model's unit. Angles are represented by cosine and sine."""
        return self._arrays["bounds"]

    @property
    def variables(self) -> List[str]:
        """The names of the boxes' sides: first the configuration, then kernel vectors and auxiliary variables."""
        return [v[0] for v in self._core.variables]

    @property
    def kinds(self) -> Dict[str, str]:
        """The kind of each variable: length, cosine, sine, kernel or auxiliary."""
        return {v[0]: v[1] for v in self._core.variables}

    @property
    def domain(self) -> Dict[str, Interval]:
        """The range of each variable that was searched."""
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
        """What is proven about each box: an array of n words. doc/certificates.md says what each word means."""
        return np.array(_corank.verdicts)[self._arrays["verdict"]]

    @property
    def verdict_codes(self) -> np.ndarray:
        """The verdicts as uint8 of shape (n,), not copied: indices of corank.VERDICTS."""
        return self._arrays["verdict"]

    @property
    def counts(self) -> Dict[str, int]:
        """The number of boxes with each verdict; verdicts without a box are left out."""
        return {word: k for word, k in zip(_corank.verdicts, self._core.counts) if k}

    @property
    def reasons(self) -> np.ndarray:
        """Why boxes are undecided: an array of n words, "none" for the other boxes. A reason is a hint, not a claim."""
        return np.array(_corank.reasons)[self._arrays["reason"]]

    @property
    def free(self) -> np.ndarray:
        """Is the variable free in the box? bool of shape (n, variables), not copied. For every value of the free variables
        in a `regular` box there is exactly one solution in it, or at most one if it is among `parts_of_sheets`. If the set
        has `parts`, there is one at least, since coordinates of a part may be left out; boxes of the parts say more."""
        return self._arrays["free"]

    @property
    def parts_of_sheets(self) -> np.ndarray:
        """Does the box hold a part of a sheet only: at most one solution for each value of the free variables, and one for
        some? bool of shape (n,), False for boxes that are neither `regular` nor `boundary`."""
        require("numpy")
        return self._core.on_parts_of_sheets()

    @property
    def types(self) -> Dict[str, np.ndarray]:
        """For each requested type of singularity, such as "RO": does every solution in the box have it? bool of shape
        (n,)."""
        bits = self._arrays["types_proven"]
        return {t: (bits >> k & 1).astype(bool) for k, t in enumerate(_corank.types) if self._core.types_asked >> k & 1}

    @property
    def excluded_types(self) -> Dict[str, np.ndarray]:
        """For each requested type of singularity: is it proven that no solution in the box has it? bool of shape (n,)."""
        bits = self._arrays["types_excluded"]
        return {t: (bits >> k & 1).astype(bool) for k, t in enumerate(_corank.types) if self._core.types_asked >> k & 1}

    @property
    def kernel_at_most(self) -> np.ndarray:
        """An upper bound of the kernel's dimension at the solutions in the box: int32 of shape (n,), not copied; −1: not
        known."""
        return self._arrays["kernel_at_most"]

    @property
    def passages(self) -> np.ndarray:
        """For a workspace boundary: can the output pass? An array of n words: "barrier", "traversable" or "unproven". Each is
        about the solutions of the part that the box comes from; the parts have their own lists (``parts``).
        """
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
        """The points of the set that are known exactly, such as those where the kernel has dimension 2: the value of each
        variable as a number of SymPy."""
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
        """The mechanism that was solved, with the values of its constants."""
        text = (self._core.model_text, self._core.model + ".cuik", "")
        return _mechanism_of(_corank.parse(text, None, self._core.constants))

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
        """What ended the run early, and in which stage; None if nothing did."""
        return self._core.stopped or None

    @property
    def assembled(self) -> Optional[bool]:
        """Can the robot be assembled within its ranges at all? True: a configuration is proven to exist (`sample`). False: it
        is proven that no configuration exists, so every set is empty. None: this is not known, or it is a plain system."""
        return self._core.assembled

    @property
    def sample(self) -> Optional[Dict[str, Interval]]:
        """A configuration that is proven to exist, as intervals by coordinate, angles in radians; None if none is known. It
        is in the first proven box of the set; if the set is empty, corank has searched for it."""
        found = self._core.sample
        return None if found is None else {name: Interval(lo, hi) for name, lo, hi in found}

    @property
    def nearly_solved(self) -> bool:
        """A hint for an empty set: are there solutions if the coefficients that are not integers may vary by 1e-6 of their
        size? Then decimals in the model may be rounded, and `tolerance=1e-6` finds the solutions."""
        return self._core.nearly_solved

    @property
    def sigma(self) -> Sigma:
        """The largest edge of a box of proven solutions."""
        return Sigma(*self._core.sigma)

    @property
    def dimension(self) -> int:
        """The dimension of the set: 0 for points, 1 for curves …"""
        return self._core.dimension

    @property
    def has_proof(self) -> bool:
        """Does the result hold a record of the search, with which verify() shows that no solution is missing?"""
        return self._core.has_proof

    @property
    def motions(self) -> List[str]:
        """The self-motions, each in words."""
        return list(self._core.motions)

    @property
    def free_coordinates(self) -> List[str]:
        """The coordinates that take every value in their ranges, whatever the others are: the set is a product with
        these ranges."""
        return list(self._core.free_coordinates)

    @property
    def parts(self) -> List["Result"]:
        """The results of the parts of a set that is solved in parts (a workspace's boundary, or a union); else empty."""
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
        """What a report says about the set: title, meaning, finding, and what is proven and what is not, as HTML
        sentences."""
        return self._core.words()

    # --- what to do with it ---

    def to_pandas(self, angles: bool = False, kernel: bool = False) -> "pandas.DataFrame":
        """Returns a data frame with a row for each box: its verdict, for each variable NAME_mid, NAME_lo and NAME_hi, the
        middle and the ends of its side, and part_of_sheet (`parts_of_sheets`).

        Args:
            angles: add the columns of each angle, in radians.
            kernel: add the columns of the kernel vectors' components.
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
        columns["part_of_sheet"] = self.parts_of_sheets
        return pandas.DataFrame(columns)

    def save(self, path: PathLike) -> None:
        """Writes a result file: HDF5, every double bit for bit, or the CUIK suite's format if the name ends in .sol."""
        self._core.save(os.fspath(path))

    def cut(
        self,
        sigma: Optional[float] = None,
        *,
        sigma_length: Optional[float] = None,
        sigma_angle: Optional[float] = None,
        threads: int = 0,
        time_limit: float = 0,
        progress: ProgressOption = None,
    ) -> "Result":
        """Returns the same set in narrower boxes: each sheet, a proven piece of the set, is cut, and what it is cut into
        inherits its proof. Wider boxes with parts of sheets are searched again. The proof of completeness stays with this
        result.

        Args:
            sigma: the largest edge of a box; None: a share of the size of the set.
            sigma_length, sigma_angle: the same for lengths, and for sines and cosines.
            threads: the number of threads; 0: one for each core.
            time_limit: in seconds; 0: no limit. Boxes that are not cut by then are pending.

        Raises:
            ResultFileError: if the coefficients have a tolerance, so that the search itself depends on sigma.
            Interrupted: on Ctrl-C, with the partial result.
        """
        options = make_options(
            sigma=sigma, sigma_length=sigma_length, sigma_angle=sigma_angle, threads=threads, time_limit=time_limit
        )
        with Shown(progress) as show:
            core, raised = self._core.cut(options, show)
        return deliver(Result(core), raised)

    def verify(self, threads: int = 0, progress: ProgressOption = None) -> Verification:
        """Checks every box against the model, with code that shares nothing with the solver. If the result has a proof, also
        checks that no solution is missing.

        Args:
            threads: the number of threads; 0: one for each core.

        Raises:
            Interrupted: on Ctrl-C, with what was checked by then.
        """
        with Shown(progress) as show:
            text, table, raised = self._core.verify(threads, show)
        return deliver(verification(text, table), raised)

    def plot(self, *axes: str, ax: Any = None, color: str = "set", **style: Any) -> Any:
        """Draws the boxes into axes of matplotlib, over two coordinates, or over three in 3-D axes; see corank.plot()."""
        return plotting.plot([self], *axes, ax=ax, color=color, **style)

    def portrait(self, path: PathLike, *axes: str, color: str = "set", title: str = "", width_mm: float = 85) -> None:
        """Writes a picture for a paper (.svg, .pdf or .png). It shows every box, with as few shapes as possible."""
        _corank.write_portrait(os.fspath(path), [self._core], list(axes), color, title, width_mm)

    def page(self) -> "notebook.Page":
        """Returns a report about this set only, as one HTML page. A notebook shows it with the 3-D view and the moving
        mechanism."""
        return notebook.Page(_corank.report_page([self._core], "", [], [], None))

    def show(self, height: int = 600) -> "notebook.Page":
        """Shows page() at the end of a notebook's cell. `height` is in pixels."""
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
    """Reads a result file (.h5). The file may come from a stranger: reading it does no harm, and verify() says whether its
    claims are true.

    Raises:
        ResultFileError: if the file is missing, damaged, or not a result.
    """
    return Result(_corank.read_result(os.fspath(path)))
