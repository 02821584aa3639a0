#include "corank/analyze/sets/standing.h"

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/requirement.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/requirements.h"

namespace corank::analyze {

namespace {

Standing standing_of(const symbolic::Requirements& requirements, const std::vector<Polynomial>& functions, const Box& box) {
  const auto form = [&](int function) { return certify::AffineForm{certify::evaluate(functions[function], box), {}}; };
  return certify::standing(requirements.of_functions(), form, {});
}

}  // namespace

Standing standing_in(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space, const Box& box) {
  const symbolic::Requirements requirements(mechanism);
  const std::vector<Polynomial> functions = symbolic::polynomials(space, requirements.functions());
  const UpwardRounding rounding;
  return standing_of(requirements, functions, box);
}

std::vector<Standing> standings_in(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space,
                                   std::span<const CoverBox> boxes, const Ended& ended) {
  const symbolic::Requirements requirements(mechanism);
  const std::vector<Polynomial> functions = symbolic::polynomials(space, requirements.functions());
  const UpwardRounding rounding;
  std::vector<Standing> standings(boxes.size(), Standing::open);
  for (std::size_t i = 0; i < boxes.size() && !is_over(ended); ++i)
    standings[i] = standing_of(requirements, functions, boxes[i].box);
  return standings;
}

}  // namespace corank::analyze
