#include "corank/certify/stratum.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "corank/certify/inertia.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

const ExactNumber kOne(1);

Polynomial variable(int j, int power = 1) {
  Polynomial p;
  p.monomials.emplace_back(kOne, std::vector<Factor>{{j, power}});
  return p;
}

Polynomial partial_derivative(const Polynomial& f, int j) {
  Polynomial result;
  for (const Monomial& m : f.monomials) {
    const auto at = std::ranges::find_if(m.factors, [j](const Factor& x) { return x.variable == j; });
    if (at == m.factors.end()) continue;
    std::vector<Factor> factors = m.factors;
    const auto here = factors.begin() + (at - m.factors.begin());
    const int power = here->power;
    if (--here->power == 0) factors.erase(here);
    result.monomials.emplace_back(m.coefficient * ExactNumber(power), std::move(factors));
  }
  return result;
}

// c² + s² − 1, whatever its factor.
bool is_circle(const Polynomial& f, const Angle& angle) {
  Polynomial circle;
  circle.monomials.emplace_back(kOne, std::vector<Factor>{{std::min(angle.cosine, angle.sine), 2}});
  circle.monomials.emplace_back(kOne, std::vector<Factor>{{std::max(angle.cosine, angle.sine), 2}});
  circle.monomials.emplace_back(-kOne, std::vector<Factor>{});
  return proportional(f, circle).has_value();
}

bool is_value_of(const Polynomial& f, int j) {
  return mentions(f, j) && std::ranges::all_of(f.monomials, [j](const Monomial& m) {
           return m.factors.empty() || (m.factors.size() == 1 && m.factors[0] == Factor{j});
         });
}

// Number k of a fixed sequence without pattern, its size in [0.2, 1.2), in ten-thousandths.
ExactNumber coefficient(int height, int k) {
  const unsigned long place = 7919UL * static_cast<unsigned long>(height) + static_cast<unsigned long>(k) + 1;
  const ExactNumber size(static_cast<long>(2000 + place * 618'034UL % 1'000'000UL / 100));
  return (place * 414'214UL % 1'000'000UL < 500'000UL ? size : -size) / ExactNumber(10'000);
}

ExactNumber power_of_two_near(double x) {
  return std::isfinite(x) && x > 0 ? ExactNumber::dyadic(std::exp2(std::round(std::log2(x)))) : kOne;
}

bool has_tolerance_or_sine(const Polynomial& f) {
  return std::ranges::any_of(f.monomials, [](const Monomial& m) { return m.is_trigonometric() || carries_tolerance(m); });
}

}  // namespace

Strata::Strata(const System& system, std::vector<End> ends, int height) : system_(system), ends_(std::move(ends)) {
  const auto odd = [](const auto& f) { return has_tolerance_or_sine(f); };
  if (std::ranges::any_of(system_.equations, odd) ||
      std::ranges::any_of(ends_, [](const End& e) { return has_tolerance_or_sine(e.function); }))
    problem_ = "sines or cosines of lengths, or coefficients with a tolerance";
  else
    find_coordinates();
  if (!problem_.empty()) return;
  if (dimension() < 1) problem_ = "as many equations as coordinates";
  make_height(height);
}

void Strata::find_coordinates() {
  std::set<int> of_angles, dropped;
  for (const Angle& angle : system_.angles) {
    of_angles.insert({angle.cosine, angle.sine});
    int circles = 0, values = 0;
    for (int row = 0; row < static_cast<int>(system_.equations.size()); ++row) {
      const Polynomial& f = system_.equations[row];
      const bool circle = is_circle(f, angle), value = is_value_of(f, angle.cosine) || is_value_of(f, angle.sine);
      if (circle || value) dropped.insert(row);
      circles += circle, values += value;
    }
    if (circles == 1 && values == 0)
      coordinates_.push_back({-1, angle.cosine, angle.sine});
    else if (circles != 0 || values != 2)
      problem_ = "an equation in one angle only";
  }
  for (int j = 0; j < system_.size(); ++j) {
    const Variable& v = system_.variables[j];
    if (!of_angles.contains(j) && !(v.lower == v.upper)) coordinates_.push_back({j, -1, -1});
  }
  for (int row = 0; row < static_cast<int>(system_.equations.size()); ++row)
    if (!dropped.contains(row)) rows_.push_back(row);
}

double Strata::size(const Coordinate& q) const {
  return q.length < 0 ? 1.0 : 0.5 * system_.variables[q.length].domain.width();
}

void Strata::make_height(int height) {
  for (const Coordinate& q : coordinates_)
    for (const int j : {q.length, q.cosine, q.sine})
      if (j >= 0 && !system_.variables[j].auxiliary)
        height_.monomials.emplace_back(coefficient(height, j) / power_of_two_near(size(q)), std::vector<Factor>{{j}});
}

Polynomial Strata::derivative(const Polynomial& f, const Coordinate& q) {
  if (q.length >= 0) return partial_derivative(f, q.length);
  return sum(product(partial_derivative(f, q.sine), {{q.cosine}}), -kOne,
             product(partial_derivative(f, q.cosine), {{q.sine}}));
}

std::vector<std::vector<int>> Strata::strata() const {
  std::vector<std::vector<int>> all{{}};
  for (std::size_t from = 0; from < all.size(); ++from)
    for (int j = all[from].empty() ? 0 : all[from].back() + 1; j < static_cast<int>(ends_.size()); ++j) {
      const End& end = ends_[j];
      const bool opposite = std::ranges::any_of(all[from], [&](int i) {
        const End& other = ends_[i];
        return end.with != Contact::With::inequality && other.with != Contact::With::inequality && other.index == end.index;
      });
      if (opposite || static_cast<int>(all[from].size()) == dimension()) continue;
      std::vector<int> next = all[from];
      next.push_back(j);
      all.push_back(std::move(next));
    }
  return all;
}

void Strata::relax(System& system, const std::vector<int>& ends) const {
  const auto imply = [&](int j) {
    Variable& v = system.variables[j];
    v = Variable(v.name, v.kind, -kOne, kOne);
    v.lower_implied = v.upper_implied = true;
  };
  std::set<int> inequalities;
  for (const int j : ends) {
    const End& end = ends_[j];
    if (end.with == Contact::With::inequality) {
      inequalities.insert(end.index);
      for (const Coordinate& q : coordinates_)
        if (q.length < 0 && (mentions(end.function, q.cosine) || mentions(end.function, q.sine)))
          for (const int k : {q.cosine, q.sine}) imply(k);
      continue;
    }
    Variable& v = system.variables[end.index];
    const bool lower = end.with == Contact::With::lower_end;
    const ExactNumber room = power_of_two_near(v.domain.width());
    Variable wider(v.name, v.kind, lower ? v.lower - room : v.lower, lower ? v.upper : v.upper + room);
    wider.auxiliary = v.auxiliary;
    wider.direction = v.direction;
    wider.size = v.size;
    v = std::move(wider);
  }
  std::vector<Polynomial> rest;
  for (int k = 0; k < static_cast<int>(system.inequalities.size()); ++k)
    if (!inequalities.contains(k)) rest.push_back(std::move(system.inequalities[k]));
  system.inequalities = std::move(rest);
}

System Strata::closed(const std::vector<int>& ends) const {
  System system = system_;
  relax(system, ends);
  for (const int j : ends) system.equations.push_back(ends_[j].function);
  return system;
}

Strata::Stratum Strata::stratum(const std::vector<int>& ends) const {
  CORANK_CHECK(UpwardRounding::active() && problem_.empty());
  Stratum result{ends, system_, {}, {}, 0, static_cast<int>(coordinates_.size())};
  System& system = result.system;
  relax(system, ends);
  std::vector<Polynomial> functions;
  for (const int row : rows_) functions.push_back(system_.equations[row]);
  for (const int j : ends) {
    functions.push_back(ends_[j].function);
    system.equations.push_back(functions.back());
  }
  result.rows = static_cast<int>(functions.size());
  functions.push_back(height_);

  // A function's multiplier is its unknown over the function's size, so that the unknowns are of one size in every unit.
  const std::vector<Interval> domain = system_.domain();
  const int first = system.size();
  Polynomial norm, lagrangian;
  for (std::size_t k = 0; k < functions.size(); ++k) {
    double largest = 0;
    for (const Coordinate& q : coordinates_)
      largest = std::max(largest, evaluate(derivative(functions[k], q), domain).mag() * size(q));
    const bool of_height = k + 1 == functions.size();
    system.variables.emplace_back("multiplier_" + std::to_string(k + 1), VariableKind::kernel, of_height ? 0 : -kOne, kOne);
    const int unknown = first + static_cast<int>(k);
    norm = sum(norm, kOne, variable(unknown, 2));
    const ExactNumber scale = of_height ? kOne : kOne / power_of_two_near(largest);
    lagrangian = sum(lagrangian, scale, product(functions[k], {{unknown}}));
  }
  norm.monomials.emplace_back(-kOne, std::vector<Factor>{});
  for (const Coordinate& q : coordinates_) {
    const Polynomial slope = derivative(lagrangian, q);
    system.equations.push_back(slope);
    system.equations.back().source = "critical point";
    for (const Coordinate& p : coordinates_) result.hessian.push_back(derivative(slope, p));
  }
  for (int k = 0; k < result.rows; ++k)
    for (const Coordinate& q : coordinates_) result.jacobian.push_back(derivative(functions[k], q));
  system.equations.push_back(std::move(norm));
  system.equations.back().source = "norm of the multipliers";
  return result;
}

namespace {

std::vector<Polynomial> values(const Strata& strata, const Strata::Stratum& stratum) {
  std::vector<Polynomial> list;
  const int n = stratum.system.size(), in = static_cast<int>(stratum.ends.size());
  for (int k = n - 1 - in; k < n; ++k) list.push_back(variable(k));  // ν, then μ
  for (int j = 0; j < static_cast<int>(strata.ends().size()); ++j)
    if (std::ranges::find(stratum.ends, j) == stratum.ends.end()) list.push_back(strata.ends()[j].function);
  list.insert(list.end(), stratum.jacobian.begin(), stratum.jacobian.end());
  list.insert(list.end(), stratum.hessian.begin(), stratum.hessian.end());
  return list;
}

}  // namespace

StratumTest::StratumTest(const Strata& strata, const Strata::Stratum& stratum)
    : ends_in_(stratum.ends.size()),
      others_(strata.ends().size() - ends_in_),
      rows_(stratum.rows),
      coordinates_(stratum.coordinates),
      compiled_(stratum.system, values(strata, stratum)) {}

bool StratumTest::Kind::counted() const {
  return std::ranges::all_of(inward, [](int sign) { return sign > 0; });
}

std::optional<StratumTest::Kind> StratumTest::kind(const Box& point) const {
  CORANK_CHECK(UpwardRounding::active());
  Kind result;
  std::size_t k = 0;
  for (; k < ends_in_; ++k) {
    const Interval nu = value(k, point);
    if (nu.contains_zero()) return std::nullopt;
    result.inward.push_back(nu.hi() < 0 ? 1 : -1);  // a = −ν/μ
  }
  for (const std::size_t positive = k + 1 + others_; k < positive; ++k)  // μ, then the other ends
    if (!(value(k, point).lo() > 0)) return std::nullopt;
  IntervalMatrix jacobian(rows_, coordinates_), hessian(coordinates_, coordinates_);
  for (Interval& entry : jacobian.entries) entry = value(k++, point);
  for (Interval& entry : hessian.entries) entry = value(k++, point);
  const std::optional<Inertia> form = inertia_on_kernel(hessian, jacobian);
  if (!form) return std::nullopt;
  result.index = form->negative;
  return result;
}

}  // namespace corank::certify
