// The checker's own Newton steps and proof of existence and uniqueness; theorems and proofs as in doc/theory.md ("A sheet").
#pragma once

#include <vector>

#include "corank/certify/checker/rows.h"

namespace corank::certify::checker {

/// Equations F, r of them, over the kept variables.
class Krawczyk {
 public:
  explicit Krawczyk(const std::vector<Row>& equations, int variables);

  /// Chooses the r dependent variables, the centre c (a point, the middle of x) and Y, about the inverse of the dependent columns of the
  /// Jacobian at c. Any Y is valid. False where that matrix is singular.
  bool set(const std::vector<int>& dependent, const Sides& x);

  /// K = c_D − Y·F(c) + (I − Y·S_D)(Z − c_D) − Y·S_F (X_F − c_F) over x = X_F × Z, with slopes S about c: every zero of F in x has its dependent
  /// variables in K. Entry a belongs to dependent[a].
  Sides image(const Sides& x);
  /// Is |I − Y·J_D| r < r for some r > 0, J the Jacobian over x? Then F has at most one zero in x for each value of the free variables.
  bool is_injective(const Sides& x);
  /// Is the centre a zero of all equations, exactly?
  bool center_is_zero() const;
  /// After image(x0), of x ⊂ x0: encloses the row at the zeros of F in x.
  Enclosure value_at_zeros(const Row& row, const Sides& x) const;
  /// After image: about |∂(dependent a)/∂x_j|.
  double steepness(std::size_t a, int j) const { return product_[a][static_cast<std::size_t>(j)].mag(); }

  const std::vector<double>& center() const { return center_; }

 private:
  // y_ := the inverse to all bits (Newton–Schulz steps from a rough one): where exact cancellation makes a variable all but constant, a Y of
  // doubles would couple it to the others by its rounding.
  void refine(const std::vector<double>& rough, const std::vector<int>& row_of);
  // product_ := Y·M, M the rows' entries in their columns.
  void multiply(const std::vector<Sides>& rows);

  const std::vector<Row>& equations_;
  int n_;
  std::vector<int> dependent_;
  std::vector<double> center_;
  Sides y_;                                    // points
  Sides center_sides_, at_center_, residual_;  // c, F(c), Y·F(c)
  std::vector<Sides> entries_, product_;
};

}  // namespace corank::certify::checker
