#include "corank/symbolic/algebra/expression_range.h"

#include "corank/core/exact_number.h"

namespace corank::symbolic {

std::optional<Interval> range_of(const Expression& e,
                                 const std::function<std::optional<Interval>(const Expression&)>& known) {
  using Kind = Expression::Kind;
  if (const std::optional<Interval> range = known(e)) return range;
  if (e.kind() == Kind::symbol || e.kind() == Kind::function || e.kind() == Kind::number) return std::nullopt;
  if (e.kind() == Kind::power) {
    const Expression& n = e.operands()[1];
    const std::optional<Interval> base = range_of(e.operands()[0], known);
    return base && n.kind() == Kind::number && n.text() == "2" ? std::optional(square(*base)) : std::nullopt;
  }
  std::optional<Interval> result;
  for (const Expression& operand : e.operands()) {
    const std::optional<Interval> part = range_of(operand, known);
    if (!part) return std::nullopt;
    if (!result) {
      result = e.kind() == Kind::negation ? -*part : *part;
    } else if (e.kind() == Kind::sum) {
      *result += *part;
    } else if (e.kind() == Kind::product) {
      *result *= *part;
    } else if (part->contains(0)) {
      return std::nullopt;
    } else {
      result = divide(*result, *part, Interval::whole());
    }
  }
  return result;
}

Coordinate with_range(Coordinate length, const Interval& range) {
  constexpr double kMargin = 0.02;
  const double margin = kMargin * range.width();
  length.lower = Expression(ExactNumber::dyadic(range.lo() - margin).text());
  length.upper = Expression(ExactNumber::dyadic(range.hi() + margin).text());
  return length;
}

}  // namespace corank::symbolic
