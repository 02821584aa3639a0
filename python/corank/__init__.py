"""corank: all singularities of a robot mechanism, each with a proof.

>>> import corank
>>> m = corank.load("models/dextar.cuik")
>>> r = m.solve("forward", sigma=0.01)
>>> r.complete
True

``load`` and ``parse`` read a mechanism, and ``Mechanism`` builds one. ``Mechanism.solve`` returns a ``Result``, and ``open``
reads a ``Result`` from a file.
"""

from . import _corank
from ._corank import Expression, Relation
from .analyses import (
    Analysis,
    Aspects,
    AspectsFactor,
    Bounds,
    Cusp,
    Factor,
    PathFactor,
    Topology,
)
from .clearing import BestCenter, Clearance, ClearanceMap, ToleranceFactor
from .errors import Interrupted, ModelError, OptionError, ResultFileError
from .expression import as_expression, as_relation, cos, degrees, linspace, pi, sin, sqrt, tan
from .live import Studio
from .mapping import ParameterMap
from .mechanism import Coordinate, Mechanism, load, parse
from .notebook import Page
from .pages import USUAL_SETS, Report
from .pathing import Path
from .plotting import plot
from .point import Interval, Point
from .posturing import Cuspidality, Postures
from .result import Angle, Result, Sigma, Verification
from .result import open_result as open
from .sweeping import Member, Sweep

__version__: str = _corank.__version__

#: The sets of a mechanism: name and meaning.
SETS = {s[0]: s[2] for s in _corank.sets}
#: The verdicts, in the order of their codes.
VERDICTS = tuple(_corank.verdicts)

__all__ = [
    "Analysis",
    "Angle",
    "Aspects",
    "AspectsFactor",
    "BestCenter",
    "Bounds",
    "Clearance",
    "ClearanceMap",
    "Coordinate",
    "Cusp",
    "Cuspidality",
    "Factor",
    "Expression",
    "Interrupted",
    "Interval",
    "Mechanism",
    "Member",
    "ModelError",
    "OptionError",
    "Page",
    "ParameterMap",
    "Path",
    "PathFactor",
    "Point",
    "Postures",
    "Relation",
    "Report",
    "Result",
    "ResultFileError",
    "SETS",
    "Sigma",
    "Studio",
    "Sweep",
    "ToleranceFactor",
    "Topology",
    "USUAL_SETS",
    "VERDICTS",
    "Verification",
    "as_expression",
    "as_relation",
    "cos",
    "degrees",
    "linspace",
    "load",
    "open",
    "parse",
    "pi",
    "plot",
    "sin",
    "sqrt",
    "tan",
]
