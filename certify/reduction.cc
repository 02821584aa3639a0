#include "corank/certify/reduction.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "corank/certify/implied.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/check.h"
#include "corank/core/cover.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

bool is_integer(const Monomial& m) {
  return m.coefficient.is_rational() && m.enclosure.is_point() && std::nearbyint(m.enclosure.lo()) == m.enclosure.lo();
}

}  // namespace

Rewriting::Rewriting(const System& system, bool tolerant, std::vector<int> parameters, std::function<void()> poll)
    : system_(system),
      tolerant_(tolerant && system.coefficient_tolerance > 0),
      poll_(std::move(poll)),
      parameters_(std::move(parameters)),
      gone_(system.variables.size(), false),
      stays_(system.variables.size(), false) {
  system.validate();
  for (const auto* rows : {&system_.equations, &system_.inequalities})
    for (const Polynomial& f : *rows)
      for (const Monomial& m : f.monomials)
        if (m.is_trigonometric()) stays_[m.factors[0].variable] = true;
  for (int j = 0; j < system_.size(); ++j)
    if (system_.variables[j].is_parameter()) parameters_.push_back(j);
  for (const int p : parameters_) stays_[p] = true;
  // From here on the tolerance stands in the enclosures.
  if (tolerant_)
    for (auto* rows : {&system_.equations, &system_.inequalities})
      for (Polynomial& f : *rows) widen(f, system_.coefficient_tolerance);
  const std::vector<ImpliedSides> implied = implied_domains(system_);
  for (std::size_t j = 0; j < implied.size(); ++j)
    if (!system_.variables[j].is_parameter())
      system_.variables[j].lower_implied = implied[j].lower, system_.variables[j].upper_implied = implied[j].upper;
  const UpwardRounding rounding;
  given_ = static_cast<int>(system_.equations.size());
  for (const Polynomial& f : system_.equations) {
    origins_.push_back(static_cast<int>(origins_.size()));
    scales_.push_back(0);
    for (const Monomial& m : f.monomials) scales_.back() = -(-scales_.back() - m.enclosure.mig());
  }
}

// In exact arithmetic an enclosure is the coefficient's own.
void Rewriting::refresh(Polynomial& f) const {
  if (tolerant_) return;
  for (Monomial& m : f.monomials) m.enclosure = m.coefficient.enclose();
}

bool Rewriting::within_tolerance(const Polynomial& f, double scale) const {
  return evaluate(f, system_.domain()).mag() <= -(-kPartialTolerance * system_.coefficient_tolerance * scale);
}

bool Rewriting::negligible(std::size_t row) const {
  const auto& monomials = system_.equations[row].monomials;
  return tolerant_ && std::ranges::all_of(monomials, [](const Monomial& m) { return m.coefficient.is_zero(); }) &&
         within_tolerance(system_.equations[row], scales_[row]);
}

bool Rewriting::drop_identities() {
  auto& rows = system_.equations;
  for (std::size_t i = 0; i < rows.size();) {
    const bool constant = variables_of(rows[i]).empty();
    // A constant that may be 0 within its tolerance, or whose sign cannot be decided, is no contradiction.
    if (constant && !rows[i].monomials.empty() && !rows[i].monomials[0].enclosure.contains_zero())
      return consistent_ = false;
    if (rows[i].monomials.empty() || negligible(i)) {
      subset_ = subset_ || !rows[i].monomials.empty();
      erase_row(i);
    } else {
      ++i;
    }
  }
  return consistent_;
}

void Rewriting::erase_row(std::size_t row) {
  const std::ptrdiff_t at = row;
  system_.equations.erase(system_.equations.begin() + at);
  origins_.erase(origins_.begin() + at);
  scales_.erase(scales_.begin() + at);
}

void Rewriting::drop_repeated() {
  auto& rows = system_.equations;
  const auto is_exact = [](const Polynomial& f) { return std::ranges::none_of(f.monomials, carries_tolerance); };
  const auto repeats = [&](std::size_t row, const Polynomial& g) {
    Polynomial f = rows[row];
    const auto ratio = proportional(f, g);
    if (!ratio) return false;
    if (is_exact(f) && is_exact(g)) {
      // 0 = 0 for a checker, too, whatever becomes of g.
      if (may_add()) steps_.push_back(SumOfEquations{origins_[row], origins_[&g - rows.data()], -*ratio});
      return true;
    }
    for (Monomial& m : f.monomials)  // f − q·g
      for (const Monomial& other : g.monomials)
        if (other.factors == m.factors) m.enclosure -= ratio->enclose() * other.enclosure;
    const bool nearly = within_tolerance(f, scales_[row]);
    subset_ = subset_ || nearly;
    return nearly;
  };
  std::map<Products, std::vector<std::size_t>> alike;  // the rows that stay
  for (std::size_t row = 0; row < rows.size();) {
    poll_();
    std::vector<std::size_t>& others = alike[products_of(rows[row])];
    if (std::ranges::any_of(others, [&](std::size_t other) { return repeats(row, rows[other]); })) {
      erase_row(row);
    } else {
      others.push_back(row++);
    }
  }
}

void Rewriting::carry_domain(int x, const Polynomial& value) {
  const Variable& from = system_.variables[x];
  const std::vector<int> others = variables_of(value);
  const auto is_parameter = [&](int j) { return std::ranges::find(parameters_, j) != parameters_.end(); };
  if (others.size() == 1 && is_affine(value) && !is_parameter(others[0])) {
    // x = a·y + c ∈ [l, u]  ⇔  y ∈ [(l − c)/a, (u − c)/a], swapped where a < 0.
    Variable& y = system_.variables[others[0]];
    ExactNumber a, c;
    for (const Monomial& m : value.monomials) (m.factors.empty() ? c : a) = m.coefficient;
    ExactNumber lower = (from.lower - c) / a, upper = (from.upper - c) / a;
    bool lower_implied = from.lower_implied, upper_implied = from.upper_implied;
    const auto sign = a.sign();
    if (sign == -1) std::swap(lower, upper), std::swap(lower_implied, upper_implied);
    const auto above = (lower - y.lower).sign(), below = (upper - y.upper).sign();
    if (sign && above && below) {
      if (*above > 0) y.lower = lower, y.lower_implied = lower_implied;
      if (*below < 0) y.upper = upper, y.upper_implied = upper_implied;
      if (*above == 0) y.lower_implied = y.lower_implied || lower_implied;
      if (*below == 0) y.upper_implied = y.upper_implied || upper_implied;
      if ((y.upper - y.lower).sign() == -1) {
        consistent_ = false;  // no value of y remains
        y.upper = y.lower;
      }
      y.domain = Interval::hull(y.lower.enclose(), y.upper.enclose());
      return;
    }
  }
  const Interval image = evaluate(value, system_.domain());
  const auto bound = [&](const ExactNumber& end, int sign) {  // sign·(value − end) ≥ 0
    Polynomial g = value;
    Polynomial shifted{{}, "range of " + from.name};
    ExactNumber constant = -end;
    Interval enclosure = -end.enclose();
    for (const Monomial& m : g.monomials) {
      if (!m.factors.empty()) {
        shifted.monomials.push_back(m);
      } else {
        constant = constant + m.coefficient;
        enclosure += m.enclosure;
      }
    }
    if (!constant.is_zero()) {
      shifted.monomials.emplace_back(constant, std::vector<Factor>{});
      shifted.monomials.back().enclosure = enclosure;
    }
    if (sign < 0)
      for (Monomial& m : shifted.monomials) m.coefficient = -m.coefficient, m.enclosure = -m.enclosure;
    refresh(shifted);
    system_.inequalities.push_back(std::move(shifted));
  };
  if (!from.lower_implied && !(image.lo() >= from.lower.enclose().hi())) bound(from.lower, 1);
  if (!from.upper_implied && !(image.hi() <= from.upper.enclose().lo())) bound(from.upper, -1);
}

std::size_t Rewriting::row_of(int equation) const {
  const auto at = std::ranges::find(origins_, equation);
  CORANK_CHECK(at != origins_.end());
  return at - origins_.begin();
}

std::optional<Polynomial> Rewriting::value_of(int variable, std::size_t row) const {
  const Polynomial& f = system_.equations[row];
  const bool is_definition = !tolerant_ || std::ranges::all_of(f.monomials, is_integer);
  return is_definition && may_go(variable) ? solved_for(f, variable) : std::nullopt;
}

std::optional<Polynomial> Rewriting::fixed_value(int variable) const {
  const Variable& v = system_.variables[variable];
  if (!may_go(variable) || !(v.lower == v.upper)) return std::nullopt;
  Polynomial value{{}, "domain of " + v.name};
  if (!v.lower.is_zero()) value.monomials.emplace_back(v.lower, std::vector<Factor>{});
  return value;
}

void Rewriting::apply(const Elimination& step) {
  const auto value = step.equation ? value_of(step.variable, row_of(*step.equation)) : fixed_value(step.variable);
  CORANK_CHECK(value.has_value());
  if (step.equation) {
    erase_row(row_of(*step.equation));
    carry_domain(step.variable, *value);
  }
  steps_.emplace_back(step);
  replace_everywhere(step.variable, *value);
}

void Rewriting::apply(const SumOfEquations& step) {
  CORANK_CHECK(may_add() && step.equation != step.other && step.factor.is_rational());
  Polynomial& f = system_.equations[row_of(step.equation)];
  f = sum(f, step.factor, system_.equations[row_of(step.other)]);
  steps_.emplace_back(step);
}

void Rewriting::replace_everywhere(int variable, Polynomial value) {
  refresh(value);
  gone_[variable] = true;
  const auto replace = [&](Polynomial& f) {
    if (!mentions(f, variable)) return;
    poll_();
    f = substitute(f, variable, value);
    refresh(f);
  };
  for (Polynomial& f : system_.equations) replace(f);
  for (Polynomial& g : system_.inequalities) replace(g);
  for (auto& [x, p] : definitions_) replace(p);
  definitions_.emplace_back(variable, std::move(value));
}

Reduction Rewriting::result() const {
  Reduction result;
  result.consistent = consistent_;
  result.subset = subset_;
  std::vector<int> index(gone_.size(), -1);
  for (std::size_t j = 0; j < gone_.size(); ++j)
    if (!gone_[j]) {
      index[j] = static_cast<int>(result.kept.size());
      result.kept.push_back(static_cast<int>(j));
      result.system.variables.push_back(system_.variables[j]);
      if (static_cast<int>(j) < system_.configuration_size) ++result.system.configuration_size;
    }
  const auto renamed = [&](Polynomial f) {
    for (Monomial& m : f.monomials)
      for (Factor& x : m.factors) x.variable = index[x.variable];
    return f;
  };
  result.system.name = system_.name;
  result.system.coefficient_tolerance = system_.coefficient_tolerance;
  result.tolerant = tolerant_;
  for (const Polynomial& f : system_.equations) result.system.equations.push_back(renamed(f));
  for (const Polynomial& g : system_.inequalities) result.system.inequalities.push_back(renamed(g));
  for (const auto& [x, p] : definitions_) result.definitions.push_back({x, renamed(p)});
  result.origins = origins_;
  result.given_equations = given_;
  result.steps = steps_;
  return result;
}

std::vector<Interval> Reduction::lift(const std::vector<Interval>& sides) const {
  CORANK_CHECK(sides.size() == kept.size() + definitions.size());
  std::vector<Interval> box(sides.size());
  for (std::size_t j = 0; j < kept.size(); ++j) box[kept[j]] = sides[j];
  for (std::size_t d = 0; d < definitions.size(); ++d) box[definitions[d].variable] = sides[kept.size() + d];
  return box;
}

Polynomial implied_equation(const System& system, const ImpliedEquation& of) {
  Polynomial h;
  for (const ImpliedEquation::Multiple& part : of.parts) {
    CORANK_CHECK(part.equation >= 0 && part.factor.is_rational());
    const std::size_t k = part.equation;
    const std::size_t m = system.equations.size();
    CORANK_CHECK(k < m + system.implied.size());
    h = sum(h, part.factor, product(k < m ? system.equations[k] : system.implied[k - m], part.product));
  }
  return h;
}

void add_implied(Reduction& reduction, const ImpliedEquation& of, const std::string& source) {
  Polynomial h = implied_equation(reduction.system, of);
  h.source = source;
  ImpliedEquation step = of;
  const int m = static_cast<int>(reduction.system.equations.size());
  for (ImpliedEquation::Multiple& part : step.parts) {
    part.equation = part.equation < m ? reduction.origins[part.equation] : reduction.given_equations + (part.equation - m);
    for (Factor& x : part.product) x.variable = reduction.kept[x.variable];
    // `kept` ascends, so the factors stay sorted.
  }
  reduction.system.implied.push_back(std::move(h));
  reduction.steps.emplace_back(std::move(step));
}

}  // namespace corank::certify
