// A compiled system of polynomial equations and inequalities over a box: the plain value that symbolic/ makes, solve/ encloses
// and certify/ proves things about. It knows no GiNaC and may be shared by threads.
//
//   F(x) = 0 (m equations),   G(x) ≥ 0 (inequalities),   x ∈ D (n intervals)
//
// Coefficients are exact numbers with interval enclosures; every proof uses the enclosure, so it holds for the exact system.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corank/certify/exact_number.h"
#include "corank/certify/interval.h"

namespace corank::certify {

/// What a variable stands for. Only for reports and heuristics: no proof depends on it.
enum class VariableKind : std::uint8_t { length, cosine, sine, kernel };

struct Variable {
  std::string name;
  VariableKind kind = VariableKind::length;
  ExactNumber lower, upper;  ///< the search domain, exact
  Interval domain;           ///< encloses [lower, upper]

  Variable() = default;
  Variable(std::string name, VariableKind kind, ExactNumber lower, ExactNumber upper);
};

/// variable^power, power ≥ 1.
struct Factor {
  int variable = 0;
  int power = 1;
  friend bool operator==(const Factor&, const Factor&) = default;
};

/// coefficient · Π factors; the factors are sorted by variable, each variable once; none for a constant.
struct Monomial {
  ExactNumber coefficient;
  Interval enclosure;  ///< of the coefficient
  std::vector<Factor> factors;

  Monomial() = default;
  Monomial(ExactNumber coefficient, std::vector<Factor> factors);
  int degree() const;
};

/// A sparse polynomial: monomials with distinct factors.
struct Polynomial {
  std::vector<Monomial> monomials;
  std::string source;  ///< where it comes from, for messages and reports ("dextar.cuik:17", "norm of xi" …)

  int degree() const;
};

/// How an angle of the model is represented: cos θ and sin θ are the variables `cosine` and `sine`.
struct Angle {
  std::string name;
  int cosine = 0;
  int sine = 0;
  Interval range;  ///< the declared range in radians; an angle is given back within it where possible
};

inline constexpr double kCoefficientToleranceLimit = 0.1;

struct System {
  std::string name;                      ///< e.g. "dextar forward"
  std::vector<Variable> variables;       ///< n
  std::vector<Polynomial> equations;     ///< m, each = 0
  std::vector<Polynomial> inequalities;  ///< each ≥ 0
  std::vector<Angle> angles;
  /// Relative tolerance τ of the coefficients that are no integers, in [0, kCoefficientToleranceLimit). Every exclusion and
  /// every proof then holds for every choice of coefficients within τ, each on its own. Meant for over-determined systems
  /// whose printed decimals are rounded and therefore inconsistent as exact numbers. 0 (default): every coefficient is exact.
  double coefficient_tolerance = 0;
  /// Number of leading variables that describe the configuration q; the others (kernel vector) follow.
  int configuration_size = 0;

  int size() const { return static_cast<int>(variables.size()); }
  /// max(0, n − m): the dimension of the solution set where the equations are independent.
  int dimension() const;
  /// Index of the variable, or −1.
  int find(const std::string& variable_name) const;
  /// Throws std::invalid_argument where an index is out of range, a domain is empty or unbounded, or a factor list unsorted.
  void validate() const;
};

}  // namespace corank::certify
