#include "corank/certify/reduction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "corank/certify/domain.h"
#include "corank/certify/elimination.h"
#include "corank/certify/parametric_reduction.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/shortening.h"
#include "corank/core/check.h"
#include "corank/core/cover.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

std::vector<int> variables_of(const Polynomial& f) {
  std::vector<int> result;
  for (const Monomial& m : f.monomials)
    for (const Factor& x : m.factors) result.push_back(x.variable);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool is_affine(const Polynomial& f) {
  return std::all_of(f.monomials.begin(), f.monomials.end(), [](const Monomial& m) {
    return m.factors.empty() || (m.factors.size() == 1 && m.factors[0].power == 1 && !m.is_trigonometric());
  });
}

bool is_integer(const Monomial& m) {
  return m.coefficient.is_rational() && m.enclosure.is_point() && std::nearbyint(m.enclosure.lo()) == m.enclosure.lo();
}

constexpr std::size_t kMostEliminations = 4;

bool is_short(const ExactNumber& q) {
  constexpr std::size_t kMostDigits = 100;
  return q.text().size() <= kMostDigits;
}

constexpr double kRounding = 1e-12;  // relative, of quotients in doubles

// A rational number with a small denominator that close to x, relatively.
std::optional<ExactNumber> simple_rational(double x, double tolerance) {
  constexpr double kLargest = 1000;
  double p0 = 1, q0 = 0, p1 = std::floor(x), q1 = 1, rest = x;  // convergents of the continued fraction
  while (q1 <= kLargest && std::fabs(p1) <= kLargest * kLargest) {
    if (std::fabs(x - p1 / q1) <= tolerance * std::fabs(x)) return ExactNumber::dyadic(p1) / ExactNumber::dyadic(q1);
    const double fraction = rest - std::floor(rest);
    if (fraction == 0) break;
    rest = 1 / fraction;
    const double digit = std::floor(rest);
    p0 = std::exchange(p1, digit * p1 + p0);
    q0 = std::exchange(q1, digit * q1 + q0);
  }
  return std::nullopt;
}

// Thrown and caught here: the reduction is given up.
struct GivenUp {};

class Reducer {
 public:
  Reducer(const System& system, Eliminate eliminate, const Ended& ended, std::vector<int> parameters = {});
  Reduction run();

 private:
  void check_ended() const {
    if (is_over(ended_)) throw GivenUp();
  }
  // Drops what holds identically; sets consistent_. False once the system is known to be inconsistent.
  bool tidy();
  // Is |f| within `partial`'s tolerance all over the domain, for an equation of that scale?
  bool within_tolerance(const Polynomial& f, double scale) const;
  // Is the equation 0 = 0 but for its tolerance, and that small?
  bool negligible(std::size_t row) const;
  void drop_repeated();
  // Replaces variables whose domain is one number by it.
  void eliminate_fixed();
  // One step of (a), of (b). False: nothing to do.
  bool eliminate_tied();
  bool eliminate_image();
  // Steps of (c) that leave few products. False: nothing to do.
  bool eliminate_products();
  // One step of (c). False: nothing to do.
  bool shorten();
  std::vector<double> sizes() const;
  ExactNumber exact_factor(const RowSum& sum) const;
  void add(std::size_t row, std::size_t other, const ExactNumber& factor);
  // A tolerance is about the equations as given: what `partial` says of one does not hold of a sum.
  bool may_add() const { return eliminate_ != Eliminate::none && system_.coefficient_tolerance == 0; }
  bool may_define(const Polynomial& f) const;
  // Does the value put in for the variable leave polynomials of moderate length, degree and coefficients?
  bool affordable(int variable, const Polynomial& value) const;
  void eliminate(std::size_t row, int variable, const Polynomial& value);
  void erase_row(std::size_t row);
  void replace_everywhere(int variable, Polynomial value);
  // Narrows y's domain to where a·y + c lies in x's; or adds inequalities.
  void carry_domain(int x, const Polynomial& value);
  void refresh(Polynomial& f) const;

  System system_;
  const Eliminate eliminate_;
  const bool tolerant_;
  const Ended& ended_;
  const std::vector<int> parameters_;  // stay, with their domains
  std::vector<bool> gone_;
  std::vector<bool> is_argument_;                        // of a sine or cosine, or a parameter: stays
  std::vector<std::pair<int, Polynomial>> definitions_;  // values in variables that are kept, by original index
  std::vector<ReductionStep> steps_;
  std::vector<int> origins_;    // of each equation: its index in the system as given
  int given_ = 0;               // equations
  std::vector<double> scales_;  // of each equation: the sum of its |coefficients| as given, rounded downward
  bool subset_ = false;
  bool consistent_ = true;
};

Reducer::Reducer(const System& system, Eliminate eliminate, const Ended& ended, std::vector<int> parameters)
    : system_(system),
      eliminate_(eliminate),
      tolerant_(system.coefficient_tolerance > 0 && eliminate != Eliminate::exact),
      ended_(ended),
      parameters_(std::move(parameters)),
      gone_(system.variables.size(), false),
      is_argument_(system.variables.size(), false) {
  system.validate();
  for (const auto* rows : {&system_.equations, &system_.inequalities})
    for (const Polynomial& f : *rows)
      for (const Monomial& m : f.monomials)
        if (m.is_trigonometric()) is_argument_[static_cast<std::size_t>(m.factors[0].variable)] = true;
  for (const int p : parameters_) is_argument_[static_cast<std::size_t>(p)] = true;
  // From here on the tolerance stands in the enclosures.
  if (tolerant_)
    for (auto* rows : {&system_.equations, &system_.inequalities})
      for (Polynomial& f : *rows) widen(f, system_.coefficient_tolerance);
  const std::vector<ImpliedSides> implied = implied_domains(system_);
  for (std::size_t j = 0; j < implied.size(); ++j)
    system_.variables[j].lower_implied = implied[j].lower, system_.variables[j].upper_implied = implied[j].upper;
  const UpwardRounding rounding;
  given_ = static_cast<int>(system_.equations.size());
  for (const Polynomial& f : system_.equations) {
    origins_.push_back(static_cast<int>(origins_.size()));
    scales_.push_back(0);
    for (const Monomial& m : f.monomials) scales_.back() = -(-scales_.back() - m.enclosure.mig());
  }
}

bool Reducer::may_define(const Polynomial& f) const {
  switch (eliminate_) {
    case Eliminate::none: return false;
    case Eliminate::exact: return true;
    case Eliminate::integers: return std::all_of(f.monomials.begin(), f.monomials.end(), is_integer);
  }
  return false;
}

bool Reducer::affordable(int variable, const Polynomial& value) const {
  constexpr double kMostTerms = 1000, kLargestCoefficient = 1e100;
  constexpr int kLargestPower = 100;
  if (has_long_number(value)) return false;
  int degree = 0;
  double size = 1;
  for (const Monomial& m : value.monomials) degree = std::max(degree, m.degree()), size += m.enclosure.mag();
  const auto fits = [&](const Polynomial& f) {
    return std::all_of(f.monomials.begin(), f.monomials.end(), [&](const Monomial& m) {
      for (const Factor& x : m.factors) {
        if (x.variable != variable || x.power == 1) continue;
        // value^p has at most C(p + t − 1, p) terms, t those of the value.
        double terms = 1;
        for (int k = 1; k <= x.power && terms <= kMostTerms; ++k)
          terms *= (static_cast<double>(value.monomials.size()) + k - 1) / k;
        return terms <= kMostTerms && degree <= kLargestPower / x.power && std::pow(size, x.power) <= kLargestCoefficient;
      }
      return true;
    });
  };
  return std::all_of(system_.equations.begin(), system_.equations.end(), fits) &&
         std::all_of(system_.inequalities.begin(), system_.inequalities.end(), fits) &&
         std::all_of(definitions_.begin(), definitions_.end(), [&](const auto& d) { return fits(d.second); });
}

// In exact arithmetic an enclosure is the coefficient's own.
void Reducer::refresh(Polynomial& f) const {
  if (tolerant_) return;
  for (Monomial& m : f.monomials) m.enclosure = m.coefficient.enclose();
}

bool Reducer::within_tolerance(const Polynomial& f, double scale) const {
  return evaluate(f, system_.domain()).mag() <= -(-kPartialTolerance * system_.coefficient_tolerance * scale);
}

bool Reducer::negligible(std::size_t row) const {
  const auto& monomials = system_.equations[row].monomials;
  return tolerant_ &&
         std::all_of(monomials.begin(), monomials.end(), [](const Monomial& m) { return m.coefficient.is_zero(); }) &&
         within_tolerance(system_.equations[row], scales_[row]);
}

bool Reducer::tidy() {
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
  return true;
}

void Reducer::erase_row(std::size_t row) {
  const auto at = static_cast<std::ptrdiff_t>(row);
  system_.equations.erase(system_.equations.begin() + at);
  origins_.erase(origins_.begin() + at);
  scales_.erase(scales_.begin() + at);
}

void Reducer::drop_repeated() {
  auto& rows = system_.equations;
  const auto is_exact = [](const Polynomial& f) {
    return std::none_of(f.monomials.begin(), f.monomials.end(), carries_tolerance);
  };
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
    check_ended();
    std::vector<std::size_t>& others = alike[products_of(rows[row])];
    if (std::any_of(others.begin(), others.end(), [&](std::size_t other) { return repeats(row, rows[other]); })) {
      erase_row(row);
    } else {
      others.push_back(row++);
    }
  }
}

void Reducer::carry_domain(int x, const Polynomial& value) {
  const Variable& from = system_.variables[static_cast<std::size_t>(x)];
  const std::vector<int> others = variables_of(value);
  const auto is_parameter = [&](int j) { return std::find(parameters_.begin(), parameters_.end(), j) != parameters_.end(); };
  if (others.size() == 1 && is_affine(value) && !is_parameter(others[0])) {
    // x = a·y + c ∈ [l, u]  ⇔  y ∈ [(l − c)/a, (u − c)/a], swapped where a < 0.
    Variable& y = system_.variables[static_cast<std::size_t>(others[0])];
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

void Reducer::eliminate(std::size_t row, int variable, const Polynomial& value) {
  steps_.push_back(Elimination{variable, origins_[row]});
  erase_row(row);
  carry_domain(variable, value);
  replace_everywhere(variable, value);
}

void Reducer::eliminate_fixed() {
  if (eliminate_ == Eliminate::none) return;
  for (std::size_t j = 0; j < system_.variables.size(); ++j) {
    const Variable& v = system_.variables[j];
    if (!(v.lower == v.upper) || is_argument_[j]) continue;
    Polynomial value{{}, "domain of " + v.name};
    if (!v.lower.is_zero()) value.monomials.emplace_back(v.lower, std::vector<Factor>{});
    if (!affordable(static_cast<int>(j), value)) continue;
    steps_.push_back(Elimination{static_cast<int>(j), {}});
    replace_everywhere(static_cast<int>(j), std::move(value));
  }
}

void Reducer::replace_everywhere(int variable, Polynomial value) {
  refresh(value);
  gone_[static_cast<std::size_t>(variable)] = true;
  const auto replace = [&](Polynomial& f) {
    if (!mentions(f, variable)) return;
    check_ended();
    f = substitute(f, variable, value);
    refresh(f);
  };
  for (Polynomial& f : system_.equations) replace(f);
  for (Polynomial& g : system_.inequalities) replace(g);
  for (auto& [x, p] : definitions_) replace(p);
  definitions_.emplace_back(variable, std::move(value));
}

bool Reducer::eliminate_tied() {
  check_ended();
  for (std::size_t i = 0; i < system_.equations.size(); ++i) {
    const Polynomial& f = system_.equations[i];
    const std::vector<int> variables = variables_of(f);
    if (variables.empty() || variables.size() > 2 || !is_affine(f) || !may_define(f)) continue;
    // The later variable goes: kernel unknowns and auxiliaries stand behind the configuration.
    for (auto v = variables.rbegin(); v != variables.rend(); ++v)
      if (const auto value = is_argument_[static_cast<std::size_t>(*v)] ? std::nullopt : solved_for(f, *v);
          value && affordable(*v, *value)) {
        eliminate(i, *v, *value);
        return true;
      }
  }
  return false;
}

bool Reducer::eliminate_image() {
  check_ended();
  std::vector<int> uses(system_.variables.size(), 0);
  for (const auto* rows : {&system_.equations, &system_.inequalities})
    for (const Polynomial& f : *rows)
      for (int v : variables_of(f)) ++uses[static_cast<std::size_t>(v)];
  for (std::size_t i = 0; i < system_.equations.size(); ++i) {
    const Polynomial& f = system_.equations[i];
    if (!may_define(f)) continue;
    for (int v : variables_of(f)) {
      if (is_argument_[static_cast<std::size_t>(v)] || uses[static_cast<std::size_t>(v)] != 1 || variables_of(f).size() < 2)
        continue;
      const auto value = solved_for(f, v);
      if (!value || !affordable(v, *value)) continue;
      // A sine or cosine is no factor: c = cos t stays where another image is r·c.
      const bool has_function = std::any_of(value->monomials.begin(), value->monomials.end(),
                                            [](const Monomial& m) { return m.is_trigonometric(); });
      if (has_function && std::any_of(definitions_.begin(), definitions_.end(),
                                      [&](const auto& definition) { return mentions(definition.second, v); }))
        continue;
      eliminate(i, v, *value);
      return true;
    }
  }
  return false;
}

std::vector<double> Reducer::sizes() const {
  std::vector<double> result;
  for (const Variable& v : system_.variables) result.push_back(v.domain.mag());
  return result;
}

// The quotient of two coefficients itself, of which the factor is a rounded value, where that is rational and short.
ExactNumber Reducer::exact_factor(const RowSum& sum) const {
  const Polynomial &f = system_.equations[sum.row], &g = system_.equations[sum.other];
  const auto is_it = [&](const ExactNumber& q) {
    return (q - sum.factor).enclose().mag() <= kRounding * sum.factor.enclose().mag() && is_short(q);
  };
  const std::optional<ExactNumber> simple = simple_rational(sum.factor.enclose().mid(), kRounding);
  for (const Monomial& b : g.monomials)
    for (const Monomial& a : f.monomials) {
      if (a.factors != b.factors || b.coefficient.is_zero()) continue;
      if (a.coefficient.is_rational() && b.coefficient.is_rational()) {
        if (ExactNumber q = -(a.coefficient / b.coefficient); is_it(q)) return q;
      } else if (simple && cancels(a.coefficient, *simple, b.coefficient)) {
        return *simple;
      }
    }
  return sum.factor;
}

bool Reducer::eliminate_products() {
  if (!may_add()) return false;
  std::vector<Polynomial> rows = system_.equations;
  for (Polynomial& f : rows)
    if (has_long_number(f)) f.monomials.clear();
  const std::vector<RowSum> sums = certify::eliminate_products(rows, sizes(), [this] { check_ended(); });
  for (const RowSum& sum : sums) {
    check_ended();
    add(sum.row, sum.other, exact_factor(sum));
  }
  return !sums.empty();
}

bool Reducer::shorten() {
  if (!may_add()) return false;
  const std::vector<double> of_variables = sizes();
  std::vector<Polynomial> rows;
  for (const Polynomial& f : system_.equations) rows.push_back(has_long_number(f) ? f : without_residues(f, of_variables));
  const BestShortening best = best_shortening(rows, [this] { check_ended(); });
  if (best.saved == 0) return false;
  add(best.row, best.other, best.factor);
  return true;
}

void Reducer::add(std::size_t row, std::size_t other, const ExactNumber& factor) {
  steps_.push_back(SumOfEquations{origins_[row], origins_[other], factor});
  system_.equations[row] = sum(system_.equations[row], factor, system_.equations[other]);
}

Reduction Reducer::run() {
  const UpwardRounding rounding;
  eliminate_fixed();
  // Images first: a shorter equation may have its variable in two.
  std::size_t eliminated = 0, variables_left = system_.variables.size() + 1;
  const auto go_on = [&] {  // products again where there are fewer variables
    const std::size_t left = system_.variables.size() - definitions_.size();
    if (eliminated < kMostEliminations && left < std::exchange(variables_left, left)) {
      ++eliminated;
      if (eliminate_products()) return true;
    }
    return shorten();
  };
  do {
    while (tidy() && consistent_ && eliminate_tied()) {
    }
    drop_repeated();
    while (consistent_ && eliminate_image()) {
    }
  } while (consistent_ && go_on());
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
      for (Factor& x : m.factors) x.variable = index[static_cast<std::size_t>(x.variable)];
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

Reduction unreduced(const System& system) {
  Reduction result;
  result.system = system;
  result.kept.resize(system.variables.size());
  std::iota(result.kept.begin(), result.kept.end(), 0);
  result.given_equations = static_cast<int>(system.equations.size());
  result.origins.resize(system.equations.size());
  std::iota(result.origins.begin(), result.origins.end(), 0);
  result.tolerant = system.coefficient_tolerance > 0;
  for (auto* rows : {&result.system.equations, &result.system.inequalities})
    for (Polynomial& f : *rows) widen(f, system.coefficient_tolerance);
  return result;
}

}  // namespace

std::vector<Interval> Reduction::lift(const std::vector<Interval>& sides) const {
  CORANK_CHECK(sides.size() == kept.size() + definitions.size());
  std::vector<Interval> box(sides.size());
  for (std::size_t j = 0; j < kept.size(); ++j) box[static_cast<std::size_t>(kept[j])] = sides[j];
  for (std::size_t d = 0; d < definitions.size(); ++d)
    box[static_cast<std::size_t>(definitions[d].variable)] = sides[kept.size() + d];
  return box;
}

Reduction reduce(const System& system, Eliminate eliminate, const Ended& ended) {
  try {
    return Reducer(system, eliminate, ended).run();
  } catch (const GivenUp&) {
    return unreduced(system);
  }
}

Reduction reduce_with_parameters(const System& system, const std::vector<int>& parameters, const Ended& ended) {
  try {
    return Reducer(system, Eliminate::exact, ended, parameters).run();
  } catch (const GivenUp&) {
    return unreduced(system);
  }
}

Reduction reduce(const System& system, const Ended& ended) {
  if (system.coefficient_tolerance > 0 && system.equations.size() <= system.variables.size())
    return reduce(system, Eliminate::integers, ended);
  Reduction exact = reduce(system, Eliminate::exact, ended);
  if (system.coefficient_tolerance == 0) return exact;
  if (exact.consistent && exact.system.equations.size() <= exact.system.variables.size()) return exact;
  return reduce(system, Eliminate::integers, ended);
}

}  // namespace corank::certify
