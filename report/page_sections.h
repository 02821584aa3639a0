// Sections of a report, as HTML fragments.
#pragma once

#include <string>
#include <vector>

#include "corank/report/set_view.h"
#include "corank/symbolic/velocity_equation.h"

namespace corank::report {

/// The isolated points of results, and points that are known exactly: a table for each set that has such points; a sentence
/// where none has. Digits are those that are proven.
std::string points_html(const std::vector<SetView>& views);

/// The derivation of a mechanism's singularities, typeset in MathML: Φ, the Jacobian blocks, the systems of the sets, each
/// folded away.
std::string derivation_html(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                            const std::vector<SetView>& views);

}  // namespace corank::report
