#include "corank/analyze/paths/standing.h"

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/requirement.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/requirements.h"

namespace corank::analyze {

Standing standing_in(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space, const Box& box) {
  const symbolic::Requirements requirements(mechanism);
  const std::vector<Polynomial> functions = symbolic::polynomials(space, requirements.functions());
  const UpwardRounding rounding;
  const auto form = [&](int function) { return certify::AffineForm{certify::evaluate(functions[function], box), {}}; };
  return certify::standing(requirements.of_functions(), form, {});
}

}  // namespace corank::analyze
