#include "corank/symbolic/rate_sizes.h"

#include <algorithm>
#include <cmath>

#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebrizer.h"

namespace corank::symbolic {
namespace {

double size_over(const Polynomial& f, const std::vector<Interval>& box) {
  Interval sum(0);
  for (const Monomial& m : f.monomials) {
    Interval term = m.enclosure;
    for (const Factor& x : m.factors)
      term *= x.function == Function::identity ? power(box[static_cast<std::size_t>(x.variable)], x.power) : Interval(-1, 1);
    sum += term;
  }
  return std::isfinite(sum.mag()) ? sum.mag() : 0;
}

}  // namespace

std::vector<std::vector<double>> entry_sizes(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                                             const std::vector<Interval>& box) {
  // An algebrizer makes polynomials of what a model claims, and asks nothing of them.
  TrigonometricSystem system = plain_system(mechanism);
  system.claimed.clear();
  for (const auto& row : matrix.rows)
    for (const Expression& e : row) system.claimed.push_back({e == Expression(0), "entry", {}, false});
  const System polynomials = algebrize(system);
  std::vector<Interval> whole = polynomials.domain();
  std::copy_n(box.begin(), std::min(box.size(), static_cast<std::size_t>(polynomials.configuration_size)), whole.begin());

  const UpwardRounding rounding;
  std::vector<std::vector<double>> sizes;
  std::size_t next = 0;
  for (const auto& row : matrix.rows) {
    sizes.emplace_back();
    for (std::size_t j = 0; j < row.size(); ++j) sizes.back().push_back(size_over(polynomials.claimed[next++], whole));
  }
  return sizes;
}

std::vector<double> rate_sizes(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                               const std::vector<std::vector<double>>& entries) {
  std::vector<bool> angular;
  for (const std::string& name : matrix.columns) {
    const int rate = mechanism.find_rate(name);
    CORANK_CHECK(rate >= 0);
    angular.push_back(mechanism.rates()[static_cast<std::size_t>(rate)].kind == CoordinateKind::angle);
  }
  std::vector<double> sizes(angular.begin(), angular.end());  // 0: not known yet
  for (bool more = true; more;) {
    more = false;
    const std::vector<double> before = sizes;
    for (const std::vector<double>& row : entries) {
      double known = 0;
      for (std::size_t j = 0; j < row.size(); ++j) known = std::max(known, row[j] * before[j]);
      for (std::size_t j = 0; j < row.size(); ++j) {
        if (before[j] > 0 || !(row[j] > 0) || !(known > 0)) continue;
        sizes[j] = std::max(sizes[j], known / row[j]);
        more = true;
      }
    }
  }
  double largest = 0;
  for (std::size_t j = 0; j < sizes.size(); ++j) {
    if (angular[j]) sizes[j] = 0;
    largest = std::max(largest, sizes[j]);
  }
  for (std::size_t j = 0; j < sizes.size(); ++j)
    if (!angular[j] && sizes[j] == 0) sizes[j] = largest > 0 ? largest : 1;
  return sizes;
}

}  // namespace corank::symbolic
