"""Exact expressions: from numbers of Python, expressions of SymPy and texts of the model language."""

from __future__ import annotations

import math
import numbers
from fractions import Fraction
from typing import Any, List, Mapping, Sequence, Tuple, Union

from . import _corank
from ._corank import Expression, Relation
from .optional import require

#: What can be given as an expression: one of corank's or SymPy's, a text of the model language, or a number.
ExpressionLike = Union[Expression, str, int, float, Fraction, Any]
#: What can be given as an equation or an inequality: ``a == b`` of corank's expressions, a text such as "a = b" or "a <= b",
#: a relation of SymPy, or an expression e, which means e = 0.
RelationLike = Union[Relation, str, Any]
#: A lower and an upper end.
RangeLike = Union[Tuple[ExpressionLike, ExpressionLike], Sequence[ExpressionLike]]


def as_expression(value: ExpressionLike) -> Expression:
    """Returns the value as an exact expression.

    A float means its shortest decimal, as in a model file: 0.9 is 9/10. Write other exact numbers as texts ("sqrt(2)/3"),
    Fractions, or numbers of SymPy.

    Raises:
        ModelError: if a text is not in the model language, or a function of SymPy is not known there.
        TypeError: if the value is of another type.
    """
    if isinstance(value, Expression):
        return value
    if isinstance(value, str):
        return _corank.parse_expression(value)
    if isinstance(value, bool):
        raise TypeError("a truth value is not an expression")
    if isinstance(value, numbers.Integral):
        return _corank.parse_expression(str(int(value)))
    if isinstance(value, Fraction):
        return _corank.fraction(str(value.numerator), str(value.denominator))
    if isinstance(value, numbers.Real) and hasattr(value, "__float__") and not hasattr(value, "free_symbols"):
        if not math.isfinite(float(value)):
            raise ValueError("a number of a model has to be finite")
        return _corank.parse_expression(repr(float(value)))
    if hasattr(value, "free_symbols") and hasattr(value, "func"):
        return _from_sympy(value)
    raise TypeError(f"{type(value).__name__} is not an expression")


def _from_sympy(e: Any) -> Expression:
    sympy = require("sympy")

    if e.is_Symbol:
        return _corank.symbol(e.name)
    if e.is_Rational:
        return _corank.fraction(str(e.p), str(e.q))
    if e.is_Float:
        return _corank.parse_expression(str(e))
    if e is sympy.pi:
        return pi
    if e is sympy.E:
        return _corank.function("exp", as_expression(1))
    if e.is_Add or e.is_Mul:
        terms = [_from_sympy(a) for a in e.args]
        total = terms[0]
        for term in terms[1:]:
            total = total + term if e.is_Add else total * term
        return total
    if e.is_Pow and e.exp == sympy.Rational(1, 2):
        return sqrt(_from_sympy(e.base))
    if e.is_Pow and e.exp == -sympy.Rational(1, 2):
        return 1 / sqrt(_from_sympy(e.base))
    if e.is_Pow and e.exp == -1:
        return 1 / _from_sympy(e.base)
    if e.is_Pow:
        return _from_sympy(e.base) ** _from_sympy(e.exp)
    if e.is_Function and len(e.args) == 1:
        return _corank.function({"Abs": "abs"}.get(e.func.__name__, e.func.__name__), _from_sympy(e.args[0]))
    raise TypeError(f"SymPy's {e.func.__name__} is not known to the model language")


def as_relation(value: RelationLike) -> Relation:
    """Returns the value as an equation or an inequality; an expression e means e = 0.

    Raises:
        ModelError, TypeError: as as_expression() does; TypeError also for a strict inequality.
    """
    if isinstance(value, Relation):
        return value
    if isinstance(value, str):
        for sign in ("<=", ">=", "="):
            left, found, right = value.partition(sign)
            if found:
                return Relation(as_expression(left), sign, as_expression(right))
        return Relation(as_expression(value), "=", as_expression(0))
    if getattr(value, "is_Relational", False):
        signs = {"Equality": "=", "LessThan": "<=", "GreaterThan": ">="}
        known = signs.get(type(value).__name__)
        if known is None:
            raise TypeError(f"{value}: expected an equation, <= or >=")
        return Relation(as_expression(value.lhs), known, as_expression(value.rhs))
    if value is True or value is False:
        raise TypeError("a truth value is not an equation; SymPy's a == b compares structures, so write sympy.Eq(a, b)")
    return Relation(as_expression(value), "=", as_expression(0))


def sin(x: ExpressionLike) -> Expression:
    """The sine of an angle in radians."""
    return _corank.function("sin", as_expression(x))


def cos(x: ExpressionLike) -> Expression:
    """The cosine of an angle in radians."""
    return _corank.function("cos", as_expression(x))


def tan(x: ExpressionLike) -> Expression:
    """The tangent of an angle in radians."""
    return _corank.function("tan", as_expression(x))


def sqrt(x: ExpressionLike) -> Expression:
    """The square root."""
    return _corank.function("sqrt", as_expression(x))


#: The circle constant, exactly.
pi: Expression = _corank.symbol("pi")


def degrees(angle: ExpressionLike) -> Expression:
    """Converts an angle from degrees to radians, exactly: degrees(15) is pi/12."""
    return as_expression(angle) * pi / 180


def linspace(start: Union[str, int, float, Fraction], stop: Union[str, int, float, Fraction], count: int) -> List[Fraction]:
    """Returns `count` equally spaced rational numbers from start to stop, both included.

    A float means its shortest decimal: linspace(0.9, 1.6, 8) is 9/10, 1, 11/10 …
    """
    if count < 2:
        raise ValueError(f"count {count}: expected 2 or more")
    first, last = (Fraction(repr(x) if isinstance(x, float) else x) for x in (start, stop))
    return [first + (last - first) * Fraction(k, count - 1) for k in range(count)]


def constant_text(value: ExpressionLike) -> str:
    """Returns a constant's value as a text of the model language; a text may have a tolerance."""
    return value if isinstance(value, str) else text_of(value)


def text_of(value: ExpressionLike) -> str:
    """Returns the value as a text of the model language."""
    return str(as_expression(value))


def _ranges(ranges: Mapping[str, RangeLike]) -> List[Tuple[str, Expression, Expression]]:
    return [(name, as_expression(lower), as_expression(upper)) for name, (lower, upper) in ranges.items()]
