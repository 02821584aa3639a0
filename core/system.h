// A compiled system of equations and inequalities over a box: the plain value that symbolic/ makes, solve/ encloses and
// certify/ proves things about. It knows no GiNaC and may be shared by threads.
//
//   F(x) = 0 (m equations),   G(x) ≥ 0 (inequalities),   x ∈ D (n intervals)
//
// Each of F and G is a polynomial plus multiples of sines and cosines of single variables.
// Coefficients are exact numbers with interval enclosures; every proof uses the enclosure, so it holds for the exact system.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/exact_number.h"
#include "corank/core/interval.h"
#include "corank/core/passage_form.h"
#include "corank/core/polynomial.h"

namespace corank {

/// What a variable stands for; auxiliary: a sine, a cosine or a sum of lengths, defined by an equation of its own;
/// parameter: a constant that is known within a tolerance, its domain, where each value belongs to another robot. Every
/// proof about a box leaves parameters free over their whole domains, so that it holds for every robot. The other kinds are
/// only for reports and heuristics: no proof depends on them.
enum class VariableKind : std::uint8_t { length, cosine, sine, kernel, auxiliary, parameter };

struct Variable {
  std::string name;
  VariableKind kind = VariableKind::length;
  ExactNumber lower, upper;                           ///< the search domain, exact
  Interval domain;                                    ///< encloses [lower, upper]
  bool lower_implied = false, upper_implied = false;  ///< the equations imply this side of the domain: it is no boundary
  bool auxiliary = false;  ///< of no interest by itself, as in [DUMMY VARS]: a box may be wide in it, whatever σ
  bool direction = false;  ///< a length without a unit: a component of a unit vector or of a rotation
  /// In [-1, 1] at every real solution of the exact equations, inside the domain or not, by what they were made from
  /// (symbolic/sets/unit_vectors.h).
  bool within_one = false;
  /// A typical size of its changes, positive, so that no choice depends on the model's unit of length. Only for heuristics.
  double size = 1;

  bool is_parameter() const { return kind == VariableKind::parameter; }
  /// One of the model's own lengths.
  bool is_plain_length() const { return kind == VariableKind::length && !direction && !auxiliary; }

  Variable() = default;
  Variable(std::string name, VariableKind kind, ExactNumber lower, ExactNumber upper);
};

/// How an angle of the model is represented: cos θ and sin θ are the variables `cosine` and `sine`.
struct Angle {
  std::string name;
  int cosine = 0;
  int sine = 0;
  Interval range;  ///< the declared range in radians; an angle is given back within it where possible
};

inline constexpr double kCoefficientToleranceLimit = 0.1;

/// Row by row.
struct PolynomialMatrix {
  int rows = 0, columns = 0;
  std::vector<Polynomial> entries;
};

struct System {
  std::string name;                      ///< e.g. "dextar forward"
  std::vector<Variable> variables;       ///< n
  std::vector<Polynomial> equations;     ///< m, each = 0
  std::vector<Polynomial> inequalities;  ///< each ≥ 0
  std::vector<Polynomial> claimed;       ///< a model says that each = 0 wherever all equations are; nothing rests on that
  std::vector<Polynomial> implied;       ///< of a reduced system: that is so, and they serve to shrink boxes
  std::vector<Angle> angles;
  /// Relative tolerance τ of the coefficients that are no integers, in [0, kCoefficientToleranceLimit); solve::reduce()
  /// puts it into their enclosures. Every exclusion and every proof then holds for every choice of coefficients within τ,
  /// each on its own. Where there are more equations than variables, it is for decimals that were rounded and are
  /// inconsistent as exact numbers, and used only where that makes a difference. 0 (default): every coefficient is exact.
  double coefficient_tolerance = 0;
  /// Number of leading variables that describe the configuration q; the others (kernel vector, auxiliaries) follow.
  int configuration_size = 0;
  /// c, where the equations ask for c independent kernel vectors: M(q) ξ¹ = … = M(q) ξᶜ = 0. The variables of kind `kernel`
  /// are those of ξ¹, then those of ξ² …; they are equally many of each.
  int kernel_vectors = 1;
  /// by which number each column of M was multiplied, as exact text; none: all are 1
  std::vector<std::string> kernel_scales;
  /// M is one whose passive rates were eliminated where that can be done (symbolic/velocity/passive_rates.h): some of its
  /// rows give such a rate, and the normalization of the ξʲ is without them.
  bool passive_rates_eliminated = false;
  /// Of a part of a workspace boundary: what decides whether the output can pass.
  std::optional<PassageForm> passage;
  /// M, of a part that has an equation in place of M(q) ξ = 0: singular at every solution.
  std::optional<PolynomialMatrix> singular{};

  int size() const { return static_cast<int>(variables.size()); }
  /// Of each variable the enclosure of its search domain.
  std::vector<Interval> domain() const;
  /// How many of the variables are parameters.
  int parameters() const;
  /// max(0, n − m − parameters): the dimension of each robot's solution set where the equations are independent.
  int dimension() const;
  /// Index of the variable, or −1.
  int find(const std::string& variable_name) const;
  /// Throws std::invalid_argument where an index is out of range, a domain is empty or unbounded, a factor list unsorted, or
  /// a sine or cosine is raised to a power or multiplied by a variable.
  void validate() const;
};

}  // namespace corank
