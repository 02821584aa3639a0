#include "corank/certify/domain.h"

namespace corank::certify {
namespace {

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

}  // namespace

std::vector<bool> implied_domains(const System& system) {
  std::vector<bool> implied(system.variables.size(), false);
  for (const Polynomial& f : system.equations) {
    if (!is_positive_sum_of_squares(f)) continue;
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
  return implied;
}

DomainTest::DomainTest(const System& system) : implied_(implied_domains(system)) {
  for (const Variable& v : system.variables) domain_.push_back(v.domain);
}

Location DomainTest::locate(const CompiledSystem& compiled, const Interval* x) const {
  Location location = Location::inside;
  for (std::size_t j = 0; j < domain_.size(); ++j) {
    if (!domain_[j].overlaps(x[j])) return Location::outside;
    if (!implied_[j] && !domain_[j].contains(x[j])) location = Location::across;
  }
  for (int row = compiled.equations(); row < compiled.rows(); ++row) {
    const Interval g = compiled.evaluate(row, x);
    if (g.hi() < 0) return Location::outside;
    if (g.lo() < 0) location = Location::across;
  }
  return location;
}

}  // namespace corank::certify
