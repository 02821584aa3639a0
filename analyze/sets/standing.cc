#include "corank/analyze/sets/standing.h"

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/requirement.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/requirements.h"

namespace corank::analyze {

Standings::Standings(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space) {
  const symbolic::Requirements requirements(mechanism);
  requirements_ = requirements.of_functions();
  functions_ = symbolic::polynomials(space, requirements.functions());
}

Standing Standings::of(const Box& box) const {
  const UpwardRounding rounding;
  return certify::standing(requirements_,
                           [&](int k) {
                             return certify::AffineForm{certify::evaluate(functions_[k], box), {}};
                           },
                           {});
}

std::vector<Standing> Standings::of(const std::vector<Box>& boxes) const {
  std::vector<Standing> list;
  for (const Box& box : boxes) list.push_back(of(box));
  return list;
}

}  // namespace corank::analyze
