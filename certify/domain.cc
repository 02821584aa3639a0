#include "corank/certify/domain.h"

#include <algorithm>
#include <cmath>

namespace corank::certify {
namespace {

// Contains no bounded interval: the inner enclosure of a domain between two neighbouring doubles.
const Interval kNowhere(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());

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

bool is_integer(const ExactNumber& x) {
  const Interval enclosure = x.enclose();
  return x.is_rational() && enclosure.is_point() && std::nearbyint(enclosure.lo()) == enclosure.lo();
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
    // Coefficients with a tolerance imply nothing, unless they are integers, which carry none.
    if (system.coefficient_tolerance > 0 && !(is_integer(b) && is_integer(m.coefficient))) continue;
    if (reaches(v.lower) && reaches(v.upper) && v.lower.sign() == -1 && v.upper.sign() == 1) implied[j] = true;
  }
}

ExactNumber magnitude(const ExactNumber& x) { return x.sign() == -1 ? -x : x; }

// The lemma about sines and cosines, for f's one other variable.
void imply_by_functions(const Polynomial& f, const System& system, std::vector<bool>& implied) {
  const Monomial* linear = nullptr;
  ExactNumber bound;
  for (const Monomial& m : f.monomials) {
    if (!m.coefficient.is_rational() || (system.coefficient_tolerance > 0 && !is_integer(m.coefficient))) return;
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
    imply_by_squares(f, system, implied);
    imply_by_functions(f, system, implied);
  }
  return implied;
}

DomainTest::DomainTest(const System& system, double tolerance) : tolerance_(tolerance), implied_(implied_domains(system)) {
  for (const Variable& v : system.variables) {
    domain_.push_back(v.domain);
    // The exact sides lie in these enclosures; what lies between their inner ends is certainly inside.
    const double least = v.lower.enclose().hi(), greatest = v.upper.enclose().lo();
    const double slack = tolerance * std::max(1.0, v.domain.mag());
    inner_.push_back(least - slack <= greatest + slack ? Interval(least - slack, greatest + slack) : kNowhere);
  }
}

Location DomainTest::locate(const CompiledSystem& compiled, const Interval* x) const {
  Location location = Location::inside;
  for (std::size_t j = 0; j < domain_.size(); ++j) {
    if (!domain_[j].overlaps(x[j])) return Location::outside;
    if (!implied_[j] && !inner_[j].contains(x[j])) location = Location::across;
  }
  for (int row = compiled.equations(); row < compiled.rows(); ++row) {
    const Interval g = compiled.evaluate(row, x);
    if (g.hi() < 0) return Location::outside;
    if (g.lo() < -tolerance_) location = Location::across;
  }
  return location;
}

}  // namespace corank::certify
