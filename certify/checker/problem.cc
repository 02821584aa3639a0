#include "corank/certify/checker/problem.h"

#include <gmpxx.h>

#include <algorithm>
#include <limits>

namespace corank::certify::checker {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Terms variable_as_terms(int j) { return Terms(Polynomial{{Monomial(1, {{j, 1}})}, ""}, 0); }

ExactNumber magnitude(const ExactNumber& x) { return x.sign() == -1 ? -x : x; }

// f times the least common denominator of its coefficients: at points of few bits its values are then exact, so that a
// bound is seen to be touched.
// f itself where a coefficient is not rational or not exact, or where the denominators are long.
Terms without_denominators(const Terms& f) {
  constexpr std::size_t kMostBits = 64;
  mpz_class common = 1;
  for (const auto& [factors, c] : f.list()) {
    if (!c.exact.is_rational() || c.tolerant) return f;
    common = lcm(common, mpq_class(c.exact.text()).get_den());
    if (mpz_sizeinbase(common.get_mpz_t(), 2) > kMostBits) return f;
  }
  return Terms().plus(ExactNumber::rational(common.get_str()), f);
}

}  // namespace

Problem::Problem(const System& system, const std::vector<ReductionStep>& reduction, const StopFlag& stop)
    : system_(system), stop_(stop) {
  const Reduced reduced = reduce(system, reduction, stop);
  contradiction_ = reduced.contradiction;
  kept_ = reduced.kept;
  place_.assign(system.variables.size(), -1);
  for (std::size_t k = 0; k < kept_.size(); ++k) place_[static_cast<std::size_t>(kept_[k])] = static_cast<int>(k);
  for (const Polynomial& f : system.equations)
    sources_.emplace_back(f, system.equations.size() <= system.variables.size() ? system.coefficient_tolerance : 0);
  for (const Terms& f : reduced.equations) {
    equations_.emplace_back(f, place_);
    sources_.push_back(f);
  }
  implied_lower_.assign(kept_.size(), 0);
  implied_upper_.assign(kept_.size(), 0);
  for (int j = 0; j < system.size(); ++j) {
    stop.poll();
    const auto& value = reduced.values[static_cast<std::size_t>(j)];
    if (value) values_.push_back({j, Row(*value, place_)});
    for (const int sign : {-1, 1}) add_domain(j, value, sign);
  }
  for (const Terms& g : reduced.inequalities) conditions_.push_back({Row(without_denominators(g), place_), false, -1});
}

// sign 1: upper − x ≥ 0, sign −1: x − lower ≥ 0.
void Problem::add_domain(int variable, const std::optional<Terms>& value, int sign) {
  const Variable& v = system_.variables[static_cast<std::size_t>(variable)];
  const ExactNumber& end = sign > 0 ? v.upper : v.lower;
  const Terms difference = (value ? *value : variable_as_terms(variable)) - end;
  bool holds = implied(variable, end, sign);
  if (value && !holds) {
    const auto affine = value->affine();
    const auto direction = affine && value->is_exact() ? affine->a.sign() : std::nullopt;
    if (direction && affine->a.is_rational() && *direction != 0)
      holds = implied(affine->variable, (end - affine->c) / affine->a, sign * *direction);
  }
  if (!value) (sign > 0 ? implied_upper_ : implied_lower_)[static_cast<std::size_t>(place(variable))] = holds;
  conditions_.push_back({Row(without_denominators(sign > 0 ? -difference : difference), place_), holds, variable});
}

// Lemma: if Σ aᵢxᵢ² = b with every aᵢ > 0, then a_y y² ≤ b; so |y| ≤ h wherever h ≥ 0 and a_y h² ≥ b.
bool Problem::implied_by_squares(const Terms& f, int y, const ExactNumber& h) const {
  ExactNumber a, b;
  for (const auto& [factors, c] : f.list()) {
    if (!c.exact.is_rational()) return false;
    if (factors.empty()) {
      b = -c.exact;
      continue;
    }
    if (factors.size() != 1 || factors[0].power != 2 || c.exact.sign() != 1) return false;
    if (factors[0].variable == y) a = c.exact;
  }
  return !a.is_zero() && (a * h * h - b).sign().value_or(-1) >= 0;
}

// Lemma: if a y = Σ bᵢ fᵢ + b₀, each fᵢ a sine or cosine, then |a y| ≤ Σ|bᵢ|; so |y| ≤ h wherever |a| h ≥ Σ|bᵢ|.
bool Problem::implied_by_functions(const Terms& f, int y, const ExactNumber& h) const {
  ExactNumber a, bound;
  for (const auto& [factors, c] : f.list()) {
    if (!c.exact.is_rational()) return false;
    if (factors.empty() || factors[0].function != Function::identity) {
      bound = bound + magnitude(c.exact);
    } else {
      if (!a.is_zero() || factors.size() != 1 || factors[0].power != 1 || factors[0].variable != y) return false;
      a = c.exact;
    }
  }
  return !a.is_zero() && (magnitude(a) * h - bound).sign().value_or(-1) >= 0;
}

bool Problem::implied(int y, const ExactNumber& end, int sign) const {
  const ExactNumber h = sign > 0 ? end : -end;
  if (!h.is_rational() || h.sign() == -1) return false;
  return std::any_of(sources_.begin(), sources_.end(), [&](const Terms& f) {
    return f.is_exact() && (implied_by_squares(f, y, h) || implied_by_functions(f, y, h));
  });
}

bool Problem::clip_to_implied(Sides& x) const {
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Variable& v = system_.variables[static_cast<std::size_t>(kept_[k])];
    if (implied_lower_[k] && !x[k].intersect(Enclosure::hull(Enclosure(v.lower), Enclosure(kInfinity)))) return false;
    if (implied_upper_[k] && !x[k].intersect(Enclosure::hull(Enclosure(v.upper), Enclosure(-kInfinity)))) return false;
  }
  return true;
}

Sides Problem::domain() const {
  Sides x;
  for (const int j : kept_) {
    const Variable& v = system_.variables[static_cast<std::size_t>(j)];
    x.push_back(Enclosure::hull(Enclosure(v.lower), Enclosure(v.upper)));
  }
  return x;
}

}  // namespace corank::certify::checker
