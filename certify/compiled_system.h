// A System in the form that evaluates fast: flat terms with interval coefficients, one sparsity pattern for all Jacobians.
//
// Rows 0 … m−1 are the equations (= 0), rows m … m+p−1 the inequalities (≥ 0); then come implied equations, which serve
// projections alone, and value rows, any further polynomials whose values are asked for. Every interval function requires
// UpwardRounding::active() and, but for evaluate(), bounded arguments. Derivatives are stored sparsely: entry k of row i,
// row_begin(i) ≤ k < row_begin(i+1), belongs to variable column(k).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "corank/core/system.h"

namespace corank::certify {

class CompiledSystem {
 public:
  /// How a term depends on its variables: c, c·x, c·x², c·x·y, c·sin x, c·cos x, or any other monomial.
  enum class Shape : std::uint8_t { constant, linear, square, bilinear, sine, cosine, general };
  struct GeneralFactor {
    int variable, power, entry;
  };
  struct Term {
    Interval c;
    Shape shape;
    int x = -1, y = -1;                      ///< variables
    int x_entry = -1, y_entry = -1;          ///< their derivative entries
    int factors_begin = 0, factors_end = 0;  ///< general terms: range in factors()
  };

  /// Throws std::invalid_argument where System::validate does.
  explicit CompiledSystem(const System& system, std::span<const Polynomial> values = {});

  /// Typical sizes of the variables, positive, at first Variable::size: so that choices (which vector r to try in a proof,
  /// when a proof is near, what to solve for) do not depend on the units of the model. No statement rests on them.
  const std::vector<double>& scales() const { return scales_; }
  void set_scales(std::vector<double> scales);

  int variables() const { return variables_; }
  /// Those that are parameters (Variable::is_parameter), ascending.
  const std::vector<int>& parameters() const { return parameters_; }
  /// The number of the other variables.
  int unknowns() const { return variables_ - static_cast<int>(parameters_.size()); }
  /// Gives each parameter its whole domain: what is then proven of x holds for every robot, and nothing of x is lost.
  void free_parameters(std::span<Interval> x) const;
  int equations() const { return equations_; }
  int inequalities() const { return rows() - equations_; }
  int rows() const { return rows_; }                     ///< equations and inequalities
  int contracting_rows() const { return contracting_; }  ///< with the implied equations
  bool is_equation(int row) const { return row < equations_ || row >= rows_; }
  int values() const { return static_cast<int>(term_begin_.size()) - 1 - contracting_; }
  int value_row(int k) const { return contracting_ + k; }
  int entries() const { return static_cast<int>(columns_.size()); }

  std::span<const Term> terms(int row) const {
    return {terms_.data() + term_begin_[row], terms_.data() + term_begin_[row + 1]};
  }
  std::span<const GeneralFactor> factors(const Term& t) const {
    return {factors_.data() + t.factors_begin, factors_.data() + t.factors_end};
  }
  int row_begin(int row) const { return row_begin_[row]; }
  int column(int entry) const { return columns_[entry]; }
  const int* columns() const { return columns_.data(); }  ///< of all entries
  /// Contracting rows in which the variable occurs.
  std::span<const int> rows_of(int variable) const {
    return {rows_of_.data() + rows_of_begin_[variable], rows_of_.data() + rows_of_begin_[variable + 1]};
  }

  /// Encloses {term(x) : x ∈ X}.
  Interval evaluate(const Term& term, std::span<const Interval> x) const;
  /// Encloses {f_row(x) : x ∈ X}: the natural interval extension.
  Interval evaluate(int row, std::span<const Interval> x) const;
  /// Encloses f_row at a point.
  Interval evaluate_at(int row, const double* x) const;
  /// Slopes of the equations: s with f(x) − f(c) ∈ s (x − c) for every x ∈ X, c the given point (inside X or not). For a
  /// quadratic f this is J((X + c)/2), half as wide as J(X). Slopes about one centre serve existence, never uniqueness.
  /// Source: key Neumaier1990, § 2.3; certify/trigonometric.h.
  void slopes(std::span<const Interval> x, const double* c, std::span<Interval> s) const { slopes(0, equations_, x, c, s); }
  /// The same of one row of any kind, into its own entries of s.
  void slopes(int row, std::span<const Interval> x, const double* c, std::span<Interval> s) const {
    slopes(row, row + 1, x, c, s);
  }
  /// Interval Jacobian of the equations: encloses ∂f_i/∂x_j(x) for every x ∈ X.
  void jacobian(std::span<const Interval> x, std::span<Interval> j) const { jacobian(0, equations_, x, j); }
  /// The same of one row of any kind, into its own entries of j.
  void jacobian(int row, std::span<const Interval> x, std::span<Interval> j) const { jacobian(row, row + 1, x, j); }
  /// Jacobian at a point in plain floating point, for heuristics only: nothing is proven by it.
  void approximate_jacobian(const double* x, double* j) const;

 private:
  void slopes(int from, int to, std::span<const Interval> x, const double* c, std::span<Interval> s) const;
  void jacobian(int from, int to, std::span<const Interval> x, std::span<Interval> j) const;

  int variables_ = 0, equations_ = 0, rows_ = 0, contracting_ = 0;
  std::vector<Term> terms_;
  std::vector<GeneralFactor> factors_;
  std::vector<int> term_begin_, row_begin_, columns_, rows_of_, rows_of_begin_;
  std::vector<double> scales_;
  std::vector<int> parameters_;
  std::vector<Interval> parameter_domains_;
};

}  // namespace corank::certify
