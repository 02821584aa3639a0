// A system after given steps of a reduction, by the checks of certify/reduction.h alone.
#pragma once

#include <variant>
#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

/// Without what then holds identically or repeats another equation. No step may be an implied equation. Enclosures carry the
/// tolerance unless equations outnumber variables, as in a checker.
inline Reduction apply(const System& system, const std::vector<ReductionStep>& steps) {
  Rewriting rewriting(system, system.equations.size() <= system.variables.size());
  const UpwardRounding rounding;
  for (const ReductionStep& step : steps)
    if (const auto* sum = std::get_if<SumOfEquations>(&step)) {
      rewriting.apply(*sum);
    } else {
      const auto* elimination = std::get_if<Elimination>(&step);
      CORANK_CHECK(elimination);
      rewriting.apply(*elimination);
    }
  if (rewriting.drop_identities()) rewriting.drop_repeated();
  return rewriting.result();
}

}  // namespace corank::certify
