"""All postures of a robot at a pose, and whether it changes them without a singularity."""

from __future__ import annotations

from typing import TYPE_CHECKING, Dict, List, Mapping, Optional, Sequence, Union

from . import _corank
from .analyses import Analysis, _values
from .errors import deliver
from .expression import ExpressionLike, as_expression
from .options import ask
from .pathing import Path
from .progress import ProgressOption, Shown

if TYPE_CHECKING:
    from .mechanism import Mechanism


class Postures(Analysis):
    """All configurations in which some coordinates have given values.

    Attributes:
        postures: for each one its joints and coordinates, intervals by name; sorted.
        proven: for each one: is it proven to exist within the ranges? False only at the end of a range.
        at_least, at_most: proven bounds of their number; at_most is None if it is not known.
        families: sets of postures of a larger dimension: (dimension, proven, intervals by name).
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.postures = [_values(p) for p in self.data["postures"]]
        self.proven: List[bool] = self.data["proven"]
        self.at_least: int = self.data["at_least"]
        self.at_most: Optional[int] = self.data["at_most"]
        self.families = [(f["dimension"], f["proven"], _values(f["values"])) for f in self.data["families"]]


class Cuspidality(Analysis):
    """Whether a robot changes its posture, at the same pose, without meeting a singularity. bool(c): is it proven to do so?

    Attributes:
        cuspidal: True or False if that is proven; None if it is open.
        of: "inverse" or "forward": the singularities that are not met.
        given: the pose, or the motors' values, by coordinate.
        quaternion: the orientation (w, x, y, z); None if the pose has none in space.
        from_, to: the two postures, intervals by coordinate; None unless it is.
        same_sign: the number of pairs of postures that no sign of a determinant's factor tells apart.
        path: the path between them, with its certificate (path.save, path.verify) and its page (path.animate); None unless
            it is.
        reason: why it is not, or why it is open.
    """

    def __init__(self, text: str, table: str, path: Optional[Path] = None) -> None:
        super().__init__(text, table)
        self.path = path
        self.cuspidal: Optional[bool] = self.data["cuspidal"]
        self.of: str = self.data["of"]
        self.given: Dict[str, float] = self.data["given"]
        self.quaternion: Optional[List[float]] = self.data["quaternion"]
        self.from_ = None if self.data["from"] is None else _values(self.data["from"])
        self.to = None if self.data["to"] is None else _values(self.data["to"])
        self.same_sign: int = self.data["same_sign"]
        self.reason: Optional[str] = self.data["reason"]

    def __bool__(self) -> bool:
        return bool(self.cuspidal)


def postures(
    self: "Mechanism",
    at: Mapping[str, ExpressionLike],
    orientation: Union[None, str, Sequence[float]] = None,
    *,
    orientation_of: str = "",
    threads: int = 0,
    time_limit: float = 0,
    progress: ProgressOption = None,
) -> Postures:
    """Finds all configurations in which coordinates have these values: the postures of an arm at a pose, or the poses of a
    parallel robot for the values of its motors.

    Args:
        at: the values. Angles are in radians: corank.degrees(15).
        orientation: of a link that is an output: turns such as "Rz(0.2)*Ry(pi/18)", or a quaternion (w, x, y, z) of any
            length.
        orientation_of: the link that `orientation` is for, if there are several.
    """
    turns = orientation if isinstance(orientation, str) else None
    quaternion = None if orientation is None or turns is not None else [format(x, ".17g") for x in orientation]
    values = [(name, as_expression(v)) for name, v in at.items()]
    with Shown(progress) as show:
        text, table, raised = _corank.postures(
            ask(self._core, None, "cspace"), values, turns, quaternion, orientation_of, threads, time_limit, show
        )
    return deliver(Postures(text, table), raised)


def cuspidal(
    self: "Mechanism",
    of: Optional[str] = None,
    *,
    poses: int = 20,
    threads: int = 0,
    time_limit: float = 0,
    progress: ProgressOption = None,
) -> Cuspidality:
    """Finds out whether the robot changes its posture, at the same pose, without meeting a singularity. With a proof if it
    does. That it does not is proven for arms with a spherical wrist, or three parallel axes, as most industrial robots have.

    Args:
        of: "inverse": postures of an arm at a pose (default for robots without loops); "forward": poses for the same values
            of the motors (default for robots with loops).
        poses: how many poses are tried.
    """
    with Shown(progress) as show:
        text, table, path, raised = _corank.cuspidal(ask(self._core, None, "cspace"), of, poses, threads, time_limit, show)
    return deliver(Cuspidality(text, table, path and Path(*path, self)), raised)
