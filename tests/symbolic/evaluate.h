// Expressions, systems and random mechanisms in long double: the oracle of the symbolic tests, which shares no code with
// GiNaC.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "corank/core/system.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

using Values = std::map<std::string, long double>;

inline long double evaluate(const Expression& e, const Values& values) {
  const auto operand = [&](std::size_t i) { return evaluate(e.operands()[i], values); };
  switch (e.kind()) {
    case Expression::Kind::number: return std::stold(e.name());
    case Expression::Kind::symbol: return e.name() == "pi" ? std::numbers::pi_v<long double> : values.at(e.name());
    case Expression::Kind::sum: {
      long double sum = 0;
      for (const Expression& term : e.operands()) sum += evaluate(term, values);
      return sum;
    }
    case Expression::Kind::product: {
      long double product = 1;
      for (const Expression& factor : e.operands()) product *= evaluate(factor, values);
      return product;
    }
    case Expression::Kind::quotient: return operand(0) / operand(1);
    case Expression::Kind::power: return std::pow(operand(0), operand(1));
    case Expression::Kind::negation: return -operand(0);
    case Expression::Kind::function: {
      static const std::map<std::string, long double (*)(long double)> kFunctions = {
          {"sin", std::sin},   {"cos", std::cos},   {"tan", std::tan}, {"asin", std::asin}, {"acos", std::acos},
          {"atan", std::atan}, {"sqrt", std::sqrt}, {"exp", std::exp}, {"log", std::log},   {"abs", std::fabs}};
      return kFunctions.at(e.name())(operand(0));
    }
  }
  throw std::logic_error("no such kind");
}

inline long double residual(const Relation& relation, const Values& values) {
  return evaluate(relation.lhs, values) - evaluate(relation.rhs, values);
}

/// By Gauss' elimination with pivots of columns.
template <typename Number>
Number determinant_of(std::vector<std::vector<Number>> m) {
  Number value = 1;
  for (std::size_t k = 0; k < m.size(); ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < m.size(); ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (m[pivot][k] == 0) return 0;
    if (pivot != k) {
      std::swap(m[pivot], m[k]);
      value = -value;
    }
    value *= m[k][k];
    for (std::size_t i = k + 1; i < m.size(); ++i)
      for (std::size_t j = m.size(); j-- > k;) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
  }
  return value;
}

/// Constants of a mechanism or system, in order.
inline Values constant_values(const std::vector<Constant>& constants) {
  Values values;
  for (const Constant& constant : constants) values[constant.name] = evaluate(constant.value, values);
  return values;
}

inline long double evaluate(const Polynomial& polynomial, const std::vector<long double>& x) {
  long double sum = 0;
  for (const Monomial& monomial : polynomial.monomials) {
    // The middle of an enclosure of width ≤ 2 ulp: good to 10^-16.
    long double term = (static_cast<long double>(monomial.enclosure.lo()) + monomial.enclosure.hi()) / 2;
    for (const Factor& factor : monomial.factors) {
      const long double at = x[static_cast<std::size_t>(factor.variable)];
      switch (factor.function) {
        case Function::identity: term *= std::pow(at, static_cast<long double>(factor.power)); break;
        case Function::sine: term *= std::sin(at); break;
        case Function::cosine: term *= std::cos(at); break;
      }
    }
    sum += term;
  }
  return sum;
}

/// The point of the compiled system's variables that belongs to the coordinates and kernel unknowns in `values`.
inline std::vector<long double> compiled_point(const System& system, const Values& values) {
  std::vector<long double> x;
  for (const Variable& variable : system.variables)
    x.push_back(values.contains(variable.name) ? values.at(variable.name) : 0);
  for (const Angle& angle : system.angles) {
    x[static_cast<std::size_t>(angle.cosine)] = std::cos(values.at(angle.name));
    x[static_cast<std::size_t>(angle.sine)] = std::sin(values.at(angle.name));
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const Polynomial& equation : system.equations)  // 1·x_i − … = 0, with variables known by now
      if (equation.source == "definition of " + system.variables[i].name) x[i] = -evaluate(equation, x);
  return x;
}

/// Polynomials with their coefficients' texts, for comparison: "3/4·x0^2·x3 + …".
inline std::string canonical(const Polynomial& polynomial) {
  std::string out;
  for (const Monomial& monomial : polynomial.monomials) {
    out += " + " + monomial.coefficient.text();
    for (const Factor& factor : monomial.factors) {
      const std::string name = "x" + std::to_string(factor.variable);
      switch (factor.function) {
        case Function::identity: out += "·" + name + "^" + std::to_string(factor.power); break;
        case Function::sine: out += "·sin(" + name + ")"; break;
        case Function::cosine: out += "·cos(" + name + ")"; break;
      }
    }
  }
  return out;
}

inline std::vector<std::string> canonical(const std::vector<Polynomial>& polynomials) {
  std::vector<std::string> out;
  for (const Polynomial& polynomial : polynomials) out.push_back(canonical(polynomial));
  return out;
}

/// Random mechanisms of lengths x1, x2, angles t1, t2, t3 and constants: sums of products of what the algebrizer
/// understands.
class RandomMechanism {
 public:
  explicit RandomMechanism(unsigned seed) : random_(seed) {}

  Mechanism make(int equations) {
    Mechanism mechanism("random");
    mechanism.constant("a", "7/5");
    mechanism.constant("b", "sqrt(2)*a");
    mechanism.constant("phi", "pi/5");
    for (const char* name : {"x1", "x2"}) mechanism.length(name, -3, 3);
    for (const char* name : {"t1", "t2", "t3"}) mechanism.angle(name);
    for (int i = 0; i < equations; ++i) {
      // The first term keeps the equation from being constant.
      Expression lhs = integer(1, 5) * (i % 2 ? Expression::symbol("x1") : sin(Expression::symbol("t1")));
      for (int k = 0; k < 4; ++k) lhs = random_() % 3 ? lhs + term(3) : lhs - term(3);
      mechanism.constrain(lhs == term(2));
    }
    return mechanism;
  }

  /// Constants and a random configuration.
  Values point(const Mechanism& mechanism) {
    Values values = constant_values(mechanism.constants());
    std::uniform_real_distribution<double> uniform(-3, 3);
    for (const Coordinate& coordinate : mechanism.coordinates()) values[coordinate.name] = uniform(random_);
    return values;
  }

  long double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }

 private:
  Expression integer(int lo, int hi) {
    return Expression(lo + static_cast<int>(random_() % static_cast<unsigned>(hi - lo + 1)));
  }
  Expression any(const std::vector<const char*>& names) { return Expression::symbol(names[random_() % names.size()]); }

  Expression angle_sum() {
    Expression sum = integer(1, 5) * any({"t1", "t2", "t3"});
    if (random_() % 2) sum = sum - any({"t1", "t2", "t3"});
    if (random_() % 2) sum = sum + any({"phi", "a"}) / integer(1, 3);
    if (random_() % 4 == 0) sum = sum - any({"x1", "x2"}) * integer(1, 3) / integer(1, 2);
    if (random_() % 4 == 0) sum = -sum;
    return random_() % 4 == 0 ? any({"x1", "x2"}) : sum;
  }

  Expression term(int depth) {
    if (depth == 0) return any({"a", "b", "x1", "x2"});
    switch (random_() % 8) {
      case 0: return Expression::number("0.75") * term(depth - 1);
      case 1: return any({"x1", "x2"}) * term(depth - 1);
      case 2: return cos(angle_sum()) * term(depth - 1);
      case 3: return sin(angle_sum());
      case 4: return pow(any({"x2", "b"}) - any({"x1", "a"}), integer(2, 3)) * term(depth - 1);
      case 5: return term(depth - 1) / any({"a", "b"});
      case 6: return cos(any({"phi", "b"})) * term(depth - 1);
      default: return term(depth - 1) - sin(angle_sum()) * cos(angle_sum());
    }
  }

  std::mt19937_64 random_;
};

}  // namespace corank::symbolic
