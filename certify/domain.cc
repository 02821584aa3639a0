#include "corank/certify/domain.h"

#include <algorithm>
#include <limits>

#include "corank/core/cover.h"

namespace corank::certify {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

}  // namespace

void clip_to_domain(const System& system, std::vector<Interval>& x) {
  for (std::size_t j = 0; j < x.size(); ++j) x[j].intersect(system.variables[j].domain);
}

DomainTest::DomainTest(const System& system) {
  const std::vector<ImpliedSides> implied = implied_domains(system);
  for (std::size_t j = 0; j < implied.size(); ++j) {
    const Variable& v = system.variables[j];
    domain_.push_back(v.domain);
    // The exact sides lie in these enclosures; what lies between their inner ends is certainly inside.
    const double least = v.lower.enclose().hi(), greatest = v.upper.enclose().lo();
    lower_.push_back(implied[j].lower ? -kBeyond : least);
    upper_.push_back(implied[j].upper ? kBeyond : greatest);
  }
}

template <class Value>
Location DomainTest::locate(const CompiledSystem& compiled, std::span<const Interval> x, double tolerance,
                            const std::vector<int>* dependent, Value value) const {
  Location location = Location::inside;
  const auto is_free = [&](std::size_t j) {
    return dependent && std::ranges::find(*dependent, static_cast<int>(j)) == dependent->end();
  };
  for (std::size_t j = 0; j < domain_.size(); ++j) {
    if (!domain_[j].overlaps(x[j])) return Location::outside;
    if (domain_[j].contains(x[j]) && is_free(j)) continue;
    const double slack = tolerance > 0 ? tolerance * std::max(1.0, domain_[j].mag()) : 0;
    if (!(lower_[j] - slack <= x[j].lo() && x[j].hi() <= upper_[j] + slack)) location = Location::across;
  }
  for (int row = compiled.equations(); row < compiled.rows(); ++row) {
    Interval g = compiled.evaluate(row, x);
    if (g.hi() >= 0 && g.lo() < -tolerance) g = value(row, g);
    if (g.hi() < 0) return Location::outside;
    if (g.lo() < -tolerance) location = Location::across;
  }
  return location;
}

Location DomainTest::locate(const CompiledSystem& compiled, std::span<const Interval> x, double tolerance) const {
  return locate(compiled, x, tolerance, nullptr, [](int, const Interval& g) { return g; });
}

Location DomainTest::locate_zeros(const NewtonStep& step, std::span<const Interval> x, double tolerance) const {
  return locate(step.system(), x, tolerance, &step.dependent(), [&](int row, Interval g) {
    // Both enclose the row's values at the zeros; disjoint, they say that there is none.
    if (!g.intersect(step.value_at_zeros(row, x))) return Interval(-1.0);
    return g;
  });
}

RedundantEquations::RedundantEquations(const System& system) {
  tolerance_ = kPartialTolerance * system.coefficient_tolerance;
  for (const Polynomial& f : system.equations) {
    double sum = 0;
    for (const Monomial& m : f.monomials) sum += m.enclosure.mag();
    bounds_.push_back(tolerance_ * sum);
  }
}

bool RedundantEquations::hold(const DomainTest& domain, const NewtonStep& step, std::span<const Interval> x) const {
  if (domain.locate_zeros(step, x, tolerance_) != Location::inside) return false;
  const std::vector<int>& equations = step.equations();
  for (int row = 0; row < step.system().equations(); ++row) {
    if (std::ranges::find(equations, row) != equations.end()) continue;
    if (!(step.value_at_zeros(row, x).mag() <= bounds_[row])) return false;
  }
  return true;
}

}  // namespace corank::certify
