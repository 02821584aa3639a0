"""Points: the solutions of a set of dimension 0, one by one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Tuple

from . import exact

if TYPE_CHECKING:
    import numpy as np

    from .result import Result


class Interval(NamedTuple):
    """A closed interval of real numbers."""

    lo: float
    hi: float

    @property
    def mid(self) -> float:
        """A number near the middle."""
        return 0.5 * (self.lo + self.hi)


class Point:
    """One solution; or, if it is undecided, a cluster of boxes that may hold any number of solutions.

    ``point["theta"]`` is the value of a coordinate: an exact number of SymPy if it is known, else an Interval. Lengths are
    in the model's unit, angles in radians.
    """

    def __init__(self, result: "Result", index: int) -> None:
        self._result = result
        self._index = index
        self._exact: Optional[Dict[str, Any]] = None

    @property
    def verdict(self) -> str:
        """ "isolated": exactly one solution; "exact": known exactly; "undecided": nothing is proven."""
        return str(self._result._point_verdicts[self._index])

    @property
    def box(self) -> np.ndarray:
        """The point's box: float64 of shape (variables, 2), lower and upper ends."""
        return self._result._point_arrays["bounds"][self._index]

    @property
    def enclosures(self) -> Dict[str, Interval]:
        """An interval around each coordinate (angles instead of their cosines and sines) and each kernel unknown."""
        r = self._result
        at = {name: Interval(*self.box[j].tolist()) for j, name in enumerate(r.variables)}
        hidden = set()
        for angle in r.angles.values():
            hidden |= {angle.cosine, angle.sine}
        values = {a: Interval(*r._point_angles(a)[self._index].tolist()) for a in r.angles}
        return {**{n: v for n, v in at.items() if n not in hidden}, **values}

    @property
    def exact(self) -> Optional[Dict[str, Any]]:
        """The exact value of each variable, and of each angle in radians, as numbers of SymPy; None if the point is not
        known exactly. For an undecided point, it is the exact point that explains why nothing more is proven."""
        number = int(self._result._point_arrays["point"][self._index])
        if number < 0:
            return None
        if self._exact is None:
            values = exact.coordinates(self._result._core.exact_points[number])
            for name, a in self._result.angles.items():
                if a.cosine in values and a.sine in values:
                    values[name] = exact.angle(values[a.cosine], values[a.sine], self.enclosures[name])
            self._exact = values
        return dict(self._exact)

    @property
    def decimals(self) -> Optional[Dict[str, str]]:
        """A decimal for each variable, wrong by less than a unit of its last digit; None if no digits were requested or
        nothing is proven."""
        digits: List[List[str]] = self._result._core.decimals
        if not digits or not digits[self._index]:
            return None
        return dict(zip(self._result.variables, digits[self._index]))

    @property
    def types(self) -> Tuple[str, ...]:
        """The types of singularity that it is proven to have, such as ("RO", "II")."""
        return self._result._type_names(int(self._result._point_arrays["types_proven"][self._index]))

    def __getitem__(self, name: str) -> Any:
        known = self.exact or {}
        return known[name] if name in known and self.verdict != "undecided" else self.enclosures[name]

    def __repr__(self) -> str:
        return f"<{self.verdict}: " + ", ".join(f"{n} = {_short(self[n])}" for n in self._result.coordinates) + ">"


def _short(value: Any) -> str:
    if not isinstance(value, Interval):
        text = str(value)
        return text if len(text) <= 40 else f"{float(value):.10g}…"
    return (
        f"{value.mid:.10g}"
        if abs(value.hi - value.lo) < 1e-9 * max(1.0, abs(value.mid))
        else f"[{value.lo:.6g}, {value.hi:.6g}]"
    )
