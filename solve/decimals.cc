#include "corank/solve/exactness.h"

#include "corank/certify/algebraic_number.h"
#include "corank/certify/distinct.h"
#include "corank/certify/reduction.h"
#include "corank/certify/refinement.h"

namespace corank::solve {
namespace {
constexpr int kMostBits = 8192;
}

void prove_decimals(const Prepared& prepared, int digits, Cover& cover, Control& control) {
  const InStage stage(control, Stage::decimals);
  const Ended ended = [&control] { return control.ended(); };
  cover.decimals.clear();
  const certify::Reduction& reduction = prepared.reduction;
  for (const CoverBox& point : cover.points) {
    control.report(cover.decimals.size(), cover.points.size());
    std::vector<std::string>& decimals = cover.decimals.emplace_back();
    if (point.verdict == Verdict::undecided || control.ended()) continue;
    if (point.point >= 0) {
      const ExactPoint& exact = cover.exact_points[point.point];
      const certify::AlgebraicNumber t(exact.polynomial, exact.lower, exact.upper);
      const ExactNumber width = pow(ExactNumber(10), -digits - 2);
      for (const auto& x : exact.coordinates) {
        const auto bounds = t.bounds(x, width);
        decimals.push_back(certify::proven_decimal(bounds.lower, bounds.upper, digits));
      }
    } else if (point.verdict == Verdict::isolated) {
      std::vector<ExactNumber> start;
      for (const int j : reduction.kept) start.push_back(ExactNumber::dyadic(point.box[j].mid()));
      const auto zero = certify::prove_zero(reduction.system, start, digits + 2, kMostBits, ended);
      const Box& region = point.region >= 0 ? cover.regions[point.region] : point.box;
      if (!zero || !certify::is_solution_of_region(*zero, reduction, region)) continue;
      decimals.resize(prepared.system.variables.size());
      for (std::size_t j = 0; j < reduction.kept.size(); ++j)
        decimals[reduction.kept[j]] = certify::proven_decimal(zero->sides[j].first, zero->sides[j].second, digits);
      for (const auto& definition : reduction.definitions) {
        const auto value = certify::bounds(definition.value, zero->sides, zero->bits);
        decimals[definition.variable] = certify::proven_decimal(value.first, value.second, digits);
      }
    }
  }
}

}  // namespace corank::solve
