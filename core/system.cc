#include "corank/core/system.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace corank {

Variable::Variable(std::string variable_name, VariableKind variable_kind, ExactNumber lower_bound, ExactNumber upper_bound)
    : name(std::move(variable_name)), kind(variable_kind), lower(std::move(lower_bound)), upper(std::move(upper_bound)) {
  // Encloses whatever order the bounds have; an empty range is for validate() to report.
  domain = Interval::hull(lower.enclose(), upper.enclose());
}

Monomial::Monomial(ExactNumber exact_coefficient, Factors sorted_factors)
    : coefficient(std::move(exact_coefficient)), enclosure(coefficient.enclose()), factors(std::move(sorted_factors)) {}

int Monomial::degree() const {
  int sum = 0;
  for (const Factor& factor : factors) sum += factor.power;
  return sum;
}

int Polynomial::degree() const {
  int most = 0;
  for (const Monomial& monomial : monomials) most = std::max(most, monomial.degree());
  return most;
}

void widen(Polynomial& f, double tolerance) {
  for (Monomial& m : f.monomials) {
    const Interval c = m.enclosure;
    if (c.is_point() && std::nearbyint(c.lo()) == c.lo()) continue;
    const double margin = 1.000001 * tolerance * c.mag();
    m.enclosure = Interval(std::nextafter(c.lo() - margin, -HUGE_VAL), std::nextafter(c.hi() + margin, HUGE_VAL));
  }
}

int System::parameters() const {
  return static_cast<int>(std::ranges::count_if(variables, [](const Variable& v) { return v.is_parameter(); }));
}

int System::dimension() const { return std::max(0, size() - static_cast<int>(equations.size()) - parameters()); }

int System::find(const std::string& variable_name) const {
  const auto it = std::ranges::find_if(variables, [&](const Variable& v) { return v.name == variable_name; });
  return it == variables.end() ? -1 : static_cast<int>(it - variables.begin());
}

namespace {

constexpr int kMaxPower = 1000;  // powers are evaluated factor by factor

void validate_polynomial(const Polynomial& polynomial, int variables) {
  const std::string place = polynomial.source.empty() ? "a polynomial" : polynomial.source;
  std::set<Factors> seen;
  for (const Monomial& monomial : polynomial.monomials) {
    int before = -1;
    for (const Factor& factor : monomial.factors) {
      if (factor.variable < 0 || factor.variable >= variables)
        throw std::invalid_argument(place + ": variable index " + std::to_string(factor.variable) + " is out of range");
      if (factor.power < 1) throw std::invalid_argument(place + ": a power is less than 1");
      if (factor.power > kMaxPower)
        throw std::invalid_argument(place + ": a power is greater than " + std::to_string(kMaxPower));
      if (factor.function != Function::identity && (monomial.factors.size() != 1 || factor.power != 1))
        throw std::invalid_argument(place + ": a sine or cosine is not the only factor of its monomial");
      if (factor.variable <= before)
        throw std::invalid_argument(place + ": the factors of a monomial are not sorted by variable");
      before = factor.variable;
    }
    if (!seen.insert(monomial.factors).second) throw std::invalid_argument(place + ": a monomial occurs twice");
    if (!monomial.enclosure.is_bounded())
      throw std::invalid_argument(place + ": the coefficient " + monomial.coefficient.text() +
                                  " exceeds double precision's range");
  }
}

}  // namespace

std::vector<Interval> System::domain() const {
  std::vector<Interval> domain;
  for (const Variable& v : variables) domain.push_back(v.domain);
  return domain;
}

void System::validate() const {
  std::set<std::string> names;
  for (const Variable& variable : variables) {
    if (!names.insert(variable.name).second) throw std::invalid_argument("the variable " + variable.name + " occurs twice");
    const std::optional<int> order = (variable.upper - variable.lower).sign();
    if (order && *order < 0)
      throw std::invalid_argument("the domain of " + variable.name + ", [" + variable.lower.text() + ", " +
                                  variable.upper.text() + "], is empty");
    if (!variable.domain.is_bounded()) throw std::invalid_argument("the domain of " + variable.name + " is unbounded");
  }
  for (const Polynomial& polynomial : equations) validate_polynomial(polynomial, size());
  for (const Polynomial& polynomial : inequalities) validate_polynomial(polynomial, size());
  for (const Angle& angle : angles) {
    if (angle.cosine < 0 || angle.cosine >= size() || angle.sine < 0 || angle.sine >= size() || angle.cosine == angle.sine)
      throw std::invalid_argument("the angle " + angle.name + " refers to a variable that does not exist");
  }
  if (passage) {
    const std::size_t rows = passage->equations, columns = passage->columns;
    if (passage->equations < 0 || passage->columns < 0 || passage->jacobian.size() != rows * columns ||
        passage->hessian.size() != columns * (columns + 1) / 2 ||
        (!passage->multipliers.empty() && passage->multipliers.size() != rows))
      throw std::invalid_argument("the form of a passage has other sizes than it says");
    for (const auto* list : {&passage->jacobian, &passage->hessian, &passage->slack, &passage->normal})
      for (const Polynomial& polynomial : *list) validate_polynomial(polynomial, size() + passage->further_variables());
    for (const int multiplier : passage->multipliers)
      if (multiplier < 0 || multiplier >= size())
        throw std::invalid_argument("the form of a passage names a variable that does not exist");
  }
  if (!(coefficient_tolerance >= 0 && coefficient_tolerance < kCoefficientToleranceLimit))
    throw std::invalid_argument("the coefficient tolerance must be in [0, 0.1)");
  if (kernel_vectors < 1) throw std::invalid_argument("kernel_vectors is below 1");
  if (configuration_size < 0 || configuration_size > size())
    throw std::invalid_argument("configuration_size is out of range");
}

}  // namespace corank
