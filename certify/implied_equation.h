// Equations that follow from others: h = Σ c·p·f with rational numbers c, products p of powers of variables, and equations
// f.
//
// Theorem: where all f vanish, so does h. So boxes may be shrunk by h = 0 (certify/projection.h), and no solution is lost,
// whatever the c and p are. It is no equation of the system: no statement about existence, uniqueness or rank rests on it.
// Proof: put in. The c and p stand in the reduction's steps, so that a checker forms h itself.
#pragma once

#include "corank/certify/reduction.h"

namespace corank::certify {

/// Σ factor · product · equation over the reduced system: `of` names the equations of `system` by their indices, then its
/// implied ones; variables are `system`'s. Requires UpwardRounding::active().
Polynomial implied_equation(const System& system, const ImpliedEquation& of);

/// Adds the equation to reduction.system.implied and, by the names of the original system, to reduction.steps. Requires
/// UpwardRounding::active().
void add_implied(Reduction& reduction, const ImpliedEquation& of, const std::string& source);

}  // namespace corank::certify
