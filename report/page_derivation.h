// The derivation of a mechanism's singularities for a report, typeset in MathML: Φ, the Jacobian blocks, the systems.
#pragma once

#include <string>
#include <vector>

#include "corank/report/set_view.h"
#include "corank/symbolic/velocity_equation.h"

namespace corank::report {

/// An HTML fragment; the systems of the sets, each folded away.
std::string derivation_html(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                            const std::vector<SetView>& views);

}  // namespace corank::report
