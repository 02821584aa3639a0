#include "corank/solve/exactness/exact_points.h"

#include <algorithm>

#include "corank/certify/exact_verification.h"
#include "corank/core/box.h"
#include "corank/solve/exactness/corank_system.h"
#include "corank/solve/exactness/ipopt.h"
#include "corank/solve/step/approximate_zero.h"

namespace corank::solve {
namespace {

constexpr int kBits = 512;                   // of the arithmetic of guesses
constexpr int kGuessBits = 220;              // that are right in what it finds, also at double solutions
constexpr int kDegree = 4;                   // of algebraic numbers
constexpr double kSmallSingularValue = 0.2;  // relative to the largest: worth a try
constexpr double kNextToHull = 3;            // of its width

std::vector<ExactNumber> dyadic(const std::vector<double>& x) {
  std::vector<ExactNumber> result;
  for (const double c : x) result.push_back(ExactNumber::dyadic(c));
  return result;
}

}  // namespace

double width_of(const ExactPoint& point, const Box& hull) {
  double width = 0;
  for (std::size_t j = 0; j < hull.size(); ++j)
    if (!point.coordinates[j].empty()) width = std::max(width, hull[j].width());
  return width;
}

int ExactPoints::add(ExactPoint point) {
  const auto same = [&](const ExactPoint& p) {  // whatever is known of what lies around it
    point.sole_within = p.sole_within;
    return p == point;
  };
  const auto known = std::ranges::find_if(points_, same);
  point.sole_within = 0;
  if (known != points_.end()) return static_cast<int>(known - points_.begin());
  points_.push_back(std::move(point));
  return static_cast<int>(points_.size()) - 1;
}

std::optional<int> ExactPoints::solution_in(const Box& box) {
  const std::vector<double> start = polish(system_, box, ended_).value_or(midpoint(box));
  const auto zero = approximate_zero(system_, dyadic(start), kBits, ended_);
  if (!zero) return std::nullopt;
  auto point = guess_exactly({zero->begin(), zero->end()}, kGuessBits, kDegree, ended_);
  if (!point) return std::nullopt;
  const certify::ExactVerification verified = certify::verify_exactly(system_, *point, ended_);
  if (!verified.holds || !certify::PointLocation(*point).in(box)) return std::nullopt;
  point->corank = verified.corank;
  return add(std::move(*point));
}

std::optional<int> ExactPoints::with_kernel(const PolynomialMatrix& matrix, const Box& hull, int least) {
  const std::vector<double> x = midpoint(hull);
  const std::vector<double> s = singular_values(matrix, x);
  const int k = static_cast<int>(s.size());
  for (int c = least; c <= k && s[k - c] < kSmallSingularValue * s[0]; ++c) {
    const CorankSystem extended = corank_system(system_, matrix, x, c);
    const auto zero = approximate_zero(extended.system, dyadic(extended.start), kBits, ended_);
    if (!zero) continue;
    std::vector<std::optional<ExactNumber>> coordinates(x.size());
    for (std::size_t j = 0; j < extended.configuration.size(); ++j) coordinates[extended.configuration[j]] = (*zero)[j];
    auto point = guess_exactly(coordinates, kGuessBits, kDegree, ended_);
    if (!point) continue;
    const certify::ExactVerification verified = certify::verify_exactly(system_, *point, ended_);
    if (!verified.holds || verified.corank < least) continue;
    point->corank = verified.corank;
    // Next to the boxes: no farther than they are wide together.
    const ExactNumber far = certify::reach(*point, hull);
    if ((far - ExactNumber::dyadic(kNextToHull * width_of(*point, hull))).sign() == 1) continue;
    return add(std::move(*point));
  }
  return std::nullopt;
}

}  // namespace corank::solve
