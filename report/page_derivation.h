// The derivation of a mechanism's singularities for a report, typeset in MathML: Φ, the Jacobian blocks, the systems.
#pragma once

#include <string>
#include <vector>

#include "corank/result/result.h"
#include "corank/symbolic/mechanism.h"

namespace corank::report {

/// An HTML fragment; the systems of the results' sets, each folded away.
std::string derivation_html(const symbolic::Mechanism& mechanism, const std::vector<result::Result>& results);

}  // namespace corank::report
