#include "corank/check/problem.h"

#include <gmpxx.h>

#include <algorithm>

namespace corank::check {
namespace {

Terms variable_as_terms(int j) { return Terms(Polynomial{{Monomial(1, {{j, 1}})}, ""}, 0); }

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
  for (std::size_t k = 0; k < kept_.size(); ++k) place_[kept_[k]] = static_cast<int>(k);
  std::vector<Terms> sources;
  for (const Polynomial& f : system.equations)
    sources.emplace_back(f, system.equations.size() <= system.variables.size() ? system.coefficient_tolerance : 0);
  for (const Terms& f : reduced.equations) {
    equations_.emplace_back(f, place_), terms_.push_back(f);
    sources.push_back(f);
  }
  for (const Terms& h : reduced.implied) implied_equations_.emplace_back(h, place_);
  implied_ = Implied(system, sources);
  implied_lower_.assign(kept_.size(), 0);
  implied_upper_.assign(kept_.size(), 0);
  for (int j = 0; j < system.size(); ++j) {
    stop.poll();
    const auto& value = reduced.values[j];
    if (value) values_.push_back({j, Row(*value, place_)});
    for (const int sign : {-1, 1}) add_domain(j, value, sign);
  }
  for (const Terms& g : reduced.inequalities) conditions_.push_back({Row(without_denominators(g), place_), false, -1});
}

// sign 1: upper − x ≥ 0, sign −1: x − lower ≥ 0.
void Problem::add_domain(int variable, const std::optional<Terms>& value, int sign) {
  const Variable& v = system_.variables[variable];
  const ExactNumber& end = sign > 0 ? v.upper : v.lower;
  const Terms difference = (value ? *value : variable_as_terms(variable)) - end;
  bool holds = implied_.holds(variable, end, sign);
  std::optional<Condition::Image> image;
  if (value && !holds) {
    const auto affine = value->affine();
    const auto direction = affine && value->is_exact() ? affine->a.sign() : std::nullopt;
    if (direction && *direction != 0) {
      const ExactNumber own = (end - affine->c) / affine->a;
      const bool is_lower = sign * *direction < 0;
      holds = implied_.holds(affine->variable, own, sign * *direction);
      image = {affine->variable, is_lower ? own.enclose().lo() : own.enclose().hi(), is_lower};
    }
  }
  if (!value) (sign > 0 ? implied_upper_ : implied_lower_)[place(variable)] = holds;
  conditions_.push_back({Row(without_denominators(sign > 0 ? -difference : difference), place_), holds, variable, image});
}

bool is_box(const Box& box, std::size_t sides) {
  const auto is_side = [](const Interval& side) { return side.is_bounded() && side.lo() <= side.hi(); };
  return box.size() == sides && std::ranges::all_of(box, is_side);
}

Sides Problem::kept(const Box& box) const {
  Sides x;
  for (const int j : kept_) x.emplace_back(box[j]);
  return x;
}

bool Problem::is_end(const Condition& c) const {
  if (c.implied) return false;
  if (c.variable < 0) return true;
  const Variable& v = system_.variables[c.variable];
  return !(v.kind == VariableKind::length && v.lower == v.upper);
}

bool Problem::clip_to_implied(Sides& x) const {
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Variable& v = system_.variables[kept_[k]];
    if (implied_lower_[k] && !x[k].intersect(Enclosure::hull(Enclosure(v.lower), Enclosure(kInfinity)))) return false;
    if (implied_upper_[k] && !x[k].intersect(Enclosure::hull(Enclosure(v.upper), Enclosure(-kInfinity)))) return false;
  }
  return true;
}

std::vector<double> Problem::lengths() const {
  const std::vector<double> all = domain_lengths(system_);
  std::vector<double> result;
  for (const int j : kept_) result.push_back(all[j]);
  return result;
}

Sides Problem::domain() const {
  Sides x;
  for (const int j : kept_) {
    const Variable& v = system_.variables[j];
    x.push_back(Enclosure::hull(Enclosure(v.lower), Enclosure(v.upper)));
  }
  return x;
}

}  // namespace corank::check
