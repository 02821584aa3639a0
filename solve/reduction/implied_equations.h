// Equations that follow from others by short identities, such as |w|² = 1 from w = u × v, |u|² = |v|² = 1, u·v = 0.
//
// They are sought among the sums Σ c·x·f of equations times one variable each: linear elimination, modulo a prime, of all
// products of three variables from them. What is left over are equations of degree two; those of few terms are kept, and are
// multiplied in turn. Heuristic: which equation is found proves nothing. certify/reduction.h forms it, from the
// factors given here, in exact arithmetic.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/ended.h"
#include "corank/core/reduction_step.h"
#include "corank/core/system.h"

namespace corank::solve {

/// Equations of degree two and few terms that follow from those of small integer coefficients, each by the indices of
/// `system` as certify::add_implied takes them in this order. None where `ended` has become true.
std::vector<ImpliedEquation> find_implied_equations(const System& system, const Ended& ended = {});

/// h as a sum Σ c·p·f of the system's equations and implied ones, the degrees of the p·f at most that of h, or two more:
/// then h = 0 wherever they all are 0. Nothing where there is no such sum of moderate length, or where a coefficient that
/// matters is not rational.
std::optional<ImpliedEquation> express_by_equations(const Polynomial& h, const System& system, const Ended& ended = {});

/// Adds to the reduced system what follows from it: those of the claimed equations, which are in the variables of the
/// original system, for which a sum is found, then what find_implied_equations finds. Nothing where coefficients carry a
/// tolerance: the sums are about the exact numbers. Returns which of the claimed ones are not proven.
std::vector<std::size_t> add_implied_equations(const std::vector<Polynomial>& claimed, certify::Reduction& reduction,
                                               const Ended& ended = {});

}  // namespace corank::solve
