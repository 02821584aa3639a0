"""Exact solutions as SymPy's numbers. An exact point's coordinates are polynomials, with rational coefficients, in one real
algebraic number t: the only root of a polynomial between two rational numbers."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

from .optional import require


def _root(coefficients: List[str], between: Tuple[str, str]) -> Any:
    sympy = require("sympy")

    t = sympy.Symbol("t")
    polynomial = sympy.Poly([sympy.Rational(c) for c in reversed(coefficients)], t)
    low, high = (sympy.Rational(x) for x in between)
    if polynomial.degree() == 1:
        return sympy.Rational(-polynomial.nth(0), polynomial.nth(1))
    for factor, _ in polynomial.factor_list()[1]:
        if factor.count_roots(low, high) == 0:
            continue
        if factor.degree() == 2:
            a, b, c = factor.all_coeffs()
            roots = [(-b + sign * sympy.sqrt(b * b - 4 * a * c)) / (2 * a) for sign in (-1, 1)]
            return next(r for r in roots if low <= r <= high)
        return sympy.CRootOf(factor, factor.count_roots(None, low))
    raise ValueError("the point's number is not a root of its polynomial")


def coordinates(point: Dict[str, Any]) -> Dict[str, Any]:
    """Of an exact point as the extension gives it: each variable's value."""
    sympy = require("sympy")

    values: Dict[str, Any] = {}
    t: Any = None
    for name, coefficients in point["coordinates"].items():
        if len(coefficients) == 1:
            values[name] = sympy.Rational(coefficients[0])
            continue
        if t is None:
            t = _root(point["polynomial"], point["between"])
        total = sum((sympy.Rational(c) * t**k for k, c in enumerate(coefficients)), sympy.Integer(0))
        values[name] = sympy.expand(total) if t.is_number and not t.has(sympy.CRootOf) else total
    return values


def angle(cosine: Any, sine: Any, enclosure: Tuple[float, float]) -> Any:
    """The angle in radians with this cosine and sine, in the turn of its enclosure."""
    sympy = require("sympy")

    value = sympy.atan2(sine, cosine)
    middle = (enclosure[0] + enclosure[1]) / 2
    turns = round((middle - float(value)) / float(2 * sympy.pi))
    return value + 2 * sympy.pi * turns
