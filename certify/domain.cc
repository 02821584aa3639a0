#include "corank/certify/domain.h"

#include <algorithm>
#include <cmath>

#include "corank/certify/polynomial_algebra.h"

namespace corank::certify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Is f = Σ a_i x_i² − b with rational a_i > 0 and rational b? Then b = −constant.
bool is_positive_sum_of_squares(const Polynomial& f) {
  bool any = false;
  for (const Monomial& m : f.monomials) {
    if (!m.coefficient.is_rational()) return false;
    if (m.factors.empty()) continue;
    if (m.factors.size() != 1 || m.factors[0].power != 2 || m.coefficient.sign() != 1) return false;
    any = true;
  }
  return any;
}

// The lemma about squares, for the variables of f.
void imply_by_squares(const Polynomial& f, const System& system, std::vector<bool>& implied) {
  if (!is_positive_sum_of_squares(f)) return;
  ExactNumber b;
  for (const Monomial& m : f.monomials)
    if (m.factors.empty()) b = b - m.coefficient;
  for (const Monomial& m : f.monomials) {
    if (m.factors.empty()) continue;
    const int j = m.factors[0].variable;
    const Variable& v = system.variables[j];
    const auto reaches = [&](const ExactNumber& h) {  // a h² ≥ b
      return h.is_rational() && (m.coefficient * h * h - b).sign().value_or(-1) >= 0;
    };
    if (reaches(v.lower) && reaches(v.upper) && v.lower.sign() == -1 && v.upper.sign() == 1) implied[j] = true;
  }
}

ExactNumber magnitude(const ExactNumber& x) { return x.sign() == -1 ? -x : x; }

// The lemma about sines and cosines, for f's one other variable.
void imply_by_functions(const Polynomial& f, const System& system, std::vector<bool>& implied) {
  const Monomial* linear = nullptr;
  ExactNumber bound;
  for (const Monomial& m : f.monomials) {
    if (!m.coefficient.is_rational()) return;
    if (m.factors.empty() || m.is_trigonometric()) {
      bound = bound + magnitude(m.coefficient);
    } else {
      if (linear || m.degree() > 1) return;
      linear = &m;
    }
  }
  if (!linear) return;
  const int j = linear->factors[0].variable;
  const Variable& v = system.variables[j];
  const auto reaches = [&](const ExactNumber& h) {  // |a| h ≥ Σ|b|
    return h.is_rational() && (magnitude(linear->coefficient) * h - bound).sign().value_or(-1) >= 0;
  };
  if (!linear->coefficient.is_zero() && reaches(v.upper) && reaches(-v.lower)) implied[j] = true;
}

}  // namespace

std::vector<bool> implied_domains(const System& system) {
  std::vector<bool> implied(system.variables.size(), false);
  for (const Polynomial& f : system.equations) {
    if (std::any_of(f.monomials.begin(), f.monomials.end(), carries_tolerance)) continue;
    imply_by_squares(f, system, implied);
    imply_by_functions(f, system, implied);
  }
  return implied;
}

void clip_to_domain(const System& system, std::vector<Interval>& x) {
  for (std::size_t j = 0; j < x.size(); ++j) x[j].intersect(system.variables[j].domain);
}

DomainTest::DomainTest(const System& system) {
  const std::vector<bool> implied = implied_domains(system);
  for (std::size_t j = 0; j < implied.size(); ++j) {
    const Variable& v = system.variables[j];
    domain_.push_back(v.domain);
    // The exact sides lie in these enclosures; what lies between their inner ends is certainly inside.
    const double least = v.lower.enclose().hi(), greatest = v.upper.enclose().lo();
    lower_.push_back(implied[j] || v.lower_implied ? -kInfinity : least);
    upper_.push_back(implied[j] || v.upper_implied ? kInfinity : greatest);
  }
}

template <class Value>
Location DomainTest::locate(const CompiledSystem& compiled, const Interval* x, double tolerance, Value value) const {
  Location location = Location::inside;
  for (std::size_t j = 0; j < domain_.size(); ++j) {
    if (!domain_[j].overlaps(x[j])) return Location::outside;
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

Location DomainTest::locate(const CompiledSystem& compiled, const Interval* x, double tolerance) const {
  return locate(compiled, x, tolerance, [](int, const Interval& g) { return g; });
}

Location DomainTest::locate_zeros(const CompiledSystem& compiled, const Preconditioner& p, const Interval* x,
                                  NewtonWorkspace& w, double tolerance) const {
  return locate(compiled, x, tolerance, [&](int row, Interval g) {
    // Both enclose the row's values at the zeros; disjoint, they say that there is none.
    if (!g.intersect(value_at_zeros(compiled, p, row, x, w))) return Interval(-1.0);
    return g;
  });
}

}  // namespace corank::certify
