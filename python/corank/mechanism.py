"""Mechanisms: their coordinates, constraints, inputs and outputs, and the questions that corank answers about them."""

from __future__ import annotations

import os
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Union

from . import _corank, analyses, clearing, live, mapping, notebook, pages, pathing, posturing, result, sweeping
from ._corank import Expression
from .errors import deliver
from .expression import ExpressionLike, RelationLike, as_expression, as_relation, constant_text, pi
from .options import ask, make_options
from .progress import ProgressOption, Shown
from .result import PathLike, Result


class Coordinate(NamedTuple):
    """A coordinate: a "length" in the model's unit, or an "angle" in radians. lower and upper are the ends of its range;
    None: the equations bound it."""

    name: str
    kind: str
    lower: Optional[Expression]
    upper: Optional[Expression]


class Mechanism:
    """A mechanism. Without inputs and outputs it is a plain system of equations.

    >>> m = Mechanism("three-slider")
    >>> y_A, y_B, x_C = m.length("y_A", -1, 1), m.length("y_B", -1, 1), m.length("x_C", -1, 1)
    >>> m.constrain(y_A**2 + x_C**2 == 1, "y_B^2 + x_C^2 = 1")
    >>> m.inputs, m.outputs = [y_A], [y_B]
    """

    def __init__(self, name: str = "mechanism") -> None:
        self._core = _corank.Model(name)

    @classmethod
    def _of(cls, core: _corank.Model) -> "Mechanism":
        mechanism = cls.__new__(cls)
        mechanism._core = core
        return mechanism

    # --- building one ---

    def constant(self, name: str, value: ExpressionLike) -> Expression:
        """Declares a constant. A float means its shortest decimal: 0.9 is 9/10. Returns the name as an expression."""
        return self._core.constant(name, as_expression(value))

    def length(
        self, name: str, lower: Optional[ExpressionLike] = None, upper: Optional[ExpressionLike] = None
    ) -> Expression:
        """Declares a length with its range, in the model's unit. Without a range, the equations have to bound it."""
        return self._core.length(name, *(None if x is None else as_expression(x) for x in (lower, upper)))

    def angle(self, name: str, lower: ExpressionLike = -pi, upper: ExpressionLike = pi) -> Expression:
        """Declares an angle with its range, in radians."""
        return self._core.angle(name, as_expression(lower), as_expression(upper))

    def unit_vector(self, name: str) -> List[Expression]:
        """Declares the unit vector NAME_x, NAME_y, NAME_z and its equation."""
        return self._core.unit_vector(name)

    def rotation(self, name: str) -> List[Expression]:
        """Declares the rotation matrix NAME_xx, NAME_xy … NAME_zz, row by row, and its six independent equations."""
        return self._core.rotation(name)

    def constrain(self, *relations: RelationLike) -> None:
        """Adds assembly constraints (equations) and inequalities: texts, or relations of corank's expressions or of SymPy.
        An expression e means e = 0."""
        for relation in relations:
            self._core.constrain(as_relation(relation))

    #: Another name of constrain().
    equation = constrain

    def imply(self, *relations: RelationLike) -> None:
        """Adds equations that follow from the constraints, to make searches faster. corank searches for a proof that they
        follow."""
        for relation in relations:
            self._core.imply(as_relation(relation))

    def limit(self, coordinate: Union[str, Expression], lower: ExpressionLike, upper: ExpressionLike) -> None:
        """Limits a joint: the mechanism ends there. The set "boundary" takes such limits into account."""
        self._core.limit(str(coordinate), as_expression(lower), as_expression(upper))

    def rate(self, name: str, role: str = "passive", angle: bool = True) -> Expression:
        """Declares a rate of the mechanism's own velocity equation. Its role is "input", "output" or "passive". With
        angle=True it is in radians per second, else in units of length per second."""
        return self._core.rate(name, angle, role)

    def velocity(self, *relations: RelationLike) -> None:
        """Adds rows of the mechanism's own velocity equation. They are linear in the rates."""
        for relation in relations:
            self._core.velocity(as_relation(relation))

    @property
    def inputs(self) -> List[str]:
        """The coordinates that the actuators hold. Assign names or expressions, once."""
        return self._core.inputs

    @inputs.setter
    def inputs(self, symbols: Iterable[Union[str, Expression]]) -> None:
        self._choose("inputs", self._core.inputs, symbols, self._core.add_inputs)

    @property
    def outputs(self) -> List[str]:
        """The coordinates that the task is about. Assign names or expressions, once."""
        return self._core.outputs

    @outputs.setter
    def outputs(self, symbols: Iterable[Union[str, Expression]]) -> None:
        self._choose("outputs", self._core.outputs, symbols, self._core.add_outputs)

    def _choose(self, role: str, known: List[str], symbols: Iterable[Union[str, Expression]], add: Any) -> None:
        if known:
            raise ValueError(f"the {role} are {', '.join(known)} already")
        add([as_expression(s) for s in ([symbols] if isinstance(symbols, (str, Expression)) else symbols)])

    # --- looking at one ---

    @property
    def name(self) -> str:
        """The mechanism's name, by default that of its file."""
        return self._core.name

    @property
    def constants(self) -> Dict[str, Expression]:
        """The constants and their values."""
        return self._core.constants

    @property
    def constant_values(self) -> Dict[str, float]:
        """The constants as rounded floats, for computations. corank itself takes them exactly."""
        return self._core.constant_values

    @property
    def coordinates(self) -> List[Coordinate]:
        """The coordinates q, in their order."""
        return [Coordinate(*c) for c in self._core.coordinates]

    @property
    def constraints(self) -> List[str]:
        """The constraints, in the model language."""
        return self._core.constraints

    @property
    def robot(self) -> Optional[str]:
        """A robot from parts in words: "planar, 5 links, mobility 2". None for others."""
        return self._core.robot

    @property
    def notices(self) -> List[str]:
        """Notices about the file: what was passed over, and what is special."""
        return self._core.notices

    @property
    def text(self) -> str:
        """The mechanism in the model language, as equations also if it is a robot from parts."""
        self._core.validate()
        return self._core.text()

    def _role(self, name: str) -> str:
        return "input" if name in self.inputs else "output" if name in self.outputs else ""

    def with_constants(
        self, constants: Optional[Mapping[str, ExpressionLike]] = None, **more: ExpressionLike
    ) -> "Mechanism":
        """Returns the mechanism with other values of constants: m.with_constants(l2="4/5").

        Raises:
            ModelError: if it does not have such a constant.
        """
        pairs = [(name, constant_text(value)) for name, value in {**(constants or {}), **more}.items()]
        return Mechanism._of(self._core.with_constants(pairs))

    def with_requirements(self, *texts: str) -> "Mechanism":
        """Returns the mechanism with requirements beside its own: m.with_requirements("amplification(outputs) <= 2")
        (doc/as_built.md). The set "requirements" is where one of them reaches its limit.

        Raises:
            ModelError: if a text is no requirement.
        """
        return Mechanism._of(self._core.with_requirements(list(texts)))

    @property
    def requirements(self) -> List[str]:
        """What is required of a configuration, as texts."""
        return self._core.requirements

    def copy(self) -> "Mechanism":
        """Returns a copy."""
        return Mechanism._of(self._core.copy())

    # --- asking about one ---

    def derive(
        self,
        set: Optional[str] = None,
        format: str = "text",
        *,
        kernel: Optional[str] = None,
        corank: int = 1,
        outputs: Sequence[str] = (),
    ) -> str:
        """Returns, as text, the constraints, the blocks of the velocity equation and the equations of a set.

        Args:
            set: the name of the set; None: "cspace".
            format: "text", "latex" (a fragment for amsmath) or "cuik" (the polynomial system, a model that can be solved).
        """
        if set is None and not self._core.plain:
            set = "cspace"
        return _corank.derive(_corank.Question(self._core, set, kernel, corank, list(outputs)), format)

    def solve(
        self,
        set: Optional[str] = None,
        *,
        sigma: Optional[float] = None,
        sigma_length: Optional[float] = None,
        sigma_angle: Optional[float] = None,
        kernel: Optional[str] = None,
        corank: int = 1,
        outputs: Sequence[str] = (),
        tolerance: Optional[float] = None,
        digits: int = 0,
        proof: bool = False,
        threads: int = 0,
        max_boxes: int = 0,
        max_found: int = 0,
        max_solutions: int = 0,
        time_limit: float = 0,
        memory_limit: Optional[int] = None,
        coarser: float = 1,
        surfaces_whole: bool = True,
        progress: ProgressOption = None,
        client: Any = None,
    ) -> Result:
        """Encloses a set in boxes, and proves what each box holds.

        Args:
            set: a name of corank.SETS ("cspace", "forward", "inverse" …), or "nodes"; None for a plain system.
            sigma: the largest edge of a box of proven solutions, in lengths and in the sines and cosines of angles; None: a
                share of the size of a curve, and no limit for larger sets (surfaces_whole); math.inf: whole sheets.
            sigma_length, sigma_angle: the same for lengths, and for sines and cosines.
            kernel: the side of the kernel vector, "right" or "left"; "none": the set is solved in parts, each with an
                equation of its own and no kernel vector; None: "none" if there are such parts, unless the set is points
                and the vector would have fewer than ten unknowns (of an arm six), else the side that fits the matrix.
            corank: only configurations at which the kernel has at least this dimension.
            outputs: the outputs for the set "boundary", instead of the model's.
            tolerance: how far each coefficient that is not an integer may vary, relative to its size; 0: not at all; None:
                1e-6 for a plain system with more equations than variables, else 0.
            digits: the number of proven digits after the point that isolated points get (Point.decimals).
            proof: record the search, so that verify() can show that no solution is missing.
            threads: the number of threads; 0: one for each core. The result depends on it only if a limit ends the search.
            max_boxes, max_found, max_solutions, time_limit (seconds), memory_limit (bytes): limits that end the search; 0:
                no limit. memory_limit=None: three quarters of the machine's memory.
            coarser: a factor for the default of sigma.
            surfaces_whole: if no sigma is given, leave the boxes of a surface or a larger set as they are proven: with a
                sheet, or a part of one (doc/theory.md, "Verdicts"). Pictures cut them, and so does Result.cut(). False: cut
                sheets to a share of the size of the set.
            progress: None: show it on a terminal and in a notebook; True, False, or a function (stage, share, text).
            client: a client of dask.distributed whose workers search (corank.cluster). Limits hold there, too. `threads` is
                then the number for one unit; 0: one.

        Raises:
            ModelError: if the model does not fit the question.
            OptionError: if a number is out of its range.
            Interrupted: on Ctrl-C, with the partial result.
        """
        options = make_options(
            sigma=sigma,
            sigma_length=sigma_length,
            sigma_angle=sigma_angle,
            proof=proof,
            threads=threads,
            max_boxes=max_boxes,
            max_found=max_found,
            max_solutions=max_solutions,
            time_limit=time_limit,
            memory_limit=memory_limit,
            coarser=coarser,
            surfaces_whole=surfaces_whole,
        )
        question = _corank.Question(self._core, set, kernel, corank, list(outputs), tolerance)
        if client is not None:
            from . import cluster  # needs a package that is not always there

            run = _corank.SpreadRun(question, options, digits)
            return cluster.solve_run(run, client, cluster.Plan(threads=threads or 1), progress=progress)
        with Shown(progress) as show:
            core, raised = _corank.solve(question, options, digits, show)
        return deliver(Result(core), raised)

    def topology(
        self, *, threads: int = 0, refinements: int = 5, time_limit: float = 0, progress: ProgressOption = None
    ) -> "analyses.Topology":
        """Finds the shape of the C-space, or of a plain system's solutions: pieces, Euler characteristic, genus. All is
        proven.

        Args:
            refinements: halve σ at most this often while something is not known.
            time_limit: in seconds; 0: no limit.
        """
        with Shown(progress) as show:
            json, text, raised = _corank.topology(ask(self._core), threads, refinements, time_limit, show)
        return deliver(analyses.Topology(json, text), raised)

    def aspects(
        self,
        *,
        threads: int = 0,
        halvings: int = 16,
        rounds: int = 16,
        cusps: bool = False,
        areas: bool = False,
        certificate: bool = False,
        time_limit: float = 0,
        progress: ProgressOption = None,
    ) -> "analyses.Aspects":
        """Finds the pieces into which singularities divide the C-space: aspects, assembly modes, working modes.

        Args:
            halvings, rounds: limits of how finely cells are divided.
            cusps: find the cusps of both loci, and for each cusp the aspect in which the robot can move around it, from one
                configuration to another with the same inputs or the same outputs.
            areas: if the two outputs are lengths: bound the area of the outputs that each aspect reaches, and say which
                aspects have outputs in common.
            certificate: keep the proofs of the numbers, for save() and verify().
            time_limit: in seconds; 0: no limit.
        """
        with Shown(progress) as show:
            json, text, file, raised = _corank.aspects(
                ask(self._core), threads, halvings, rounds, cusps, areas, certificate, time_limit, show
            )
        return deliver(analyses.Aspects(json, text, file), raised)

    clearance = clearing.clearance
    tolerance_factor = clearing.tolerance_factor
    aspects_factor = analyses.aspects_factor
    path_factor = analyses.path_factor
    postures = posturing.postures
    cuspidal = posturing.cuspidal
    best_center = clearing.best_center
    clearance_map = clearing.clearance_map
    area = analyses.area
    map = mapping.map
    path = pathing.path
    report = pages.report
    studio = live.studio
    sweep = sweeping.sweep

    def show(self, **options: Any) -> "pages.Report":
        """Shows a report inside a notebook; the options are those of report()."""
        return self.report(None, **options)

    # --- inner ---

    def __str__(self) -> str:
        return self._core.text() if self.coordinates else self.name

    def __repr__(self) -> str:
        roles = f"inputs {', '.join(self.inputs) or 'none'}, outputs {', '.join(self.outputs) or 'none'}"
        return f"<mechanism {self.name}: {len(self.coordinates)} coordinates, {len(self.constraints)} constraints, {roles}>"

    def _repr_html_(self) -> str:
        return notebook.mechanism_html(self)

    def __reduce__(self) -> Any:
        return Mechanism._of, (self._core,)


result._mechanism_of = Mechanism._of


def load(path: PathLike, loops: Optional[PathLike] = None, **constants: ExpressionLike) -> Mechanism:
    """Reads a mechanism: equations (.cuik), parts (.world, or .cuik with [LINKS]) or URDF (.urdf).

    Args:
        loops: the companion of a URDF file: the joints that close loops, the inputs and the outputs.
        constants: other values of constants: load("dextar.cuik", l2="4/5", d="1.18 ± 0.001").

    Raises:
        ModelError: if the file is wrong; it names file, line and column.
    """
    pairs = [(name, constant_text(value)) for name, value in constants.items()]
    return Mechanism._of(_corank.load(os.fspath(path), None if loops is None else os.fspath(loops), pairs))


def parse(text: str, name: str = "model.cuik", loops: Optional[str] = None, **constants: ExpressionLike) -> Mechanism:
    """Makes a mechanism from a text in the model language, the parts language or URDF.

    Args:
        name: the name of the file in messages, which also names the mechanism. Its extension (.cuik, .world or .urdf;
            default: .cuik) says what the text is.
        loops: the text of the companion of a URDF text.
        constants: other values of constants.
    """
    if not os.path.splitext(name)[1]:
        name += ".cuik"
    companion = None if loops is None else (loops, os.path.splitext(name)[0] + ".loops", "")
    pairs = [(constant, constant_text(value)) for constant, value in constants.items()]
    return Mechanism._of(_corank.parse((text, name, ""), companion, pairs))
