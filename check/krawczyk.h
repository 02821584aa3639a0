// The checker's own Newton steps and proof of existence and uniqueness; theorems and proofs as in doc/theory.md ("A sheet").
#pragma once

#include <Eigen/Core>
#include <vector>

#include "corank/check/form.h"
#include "corank/check/rows.h"

namespace corank::check {

/// Sets entries that are rounding noise beside the largest of their row to 0: where a variable is 0 on the whole set, its
/// equations then bound it on their own, however small its side.
void drop_noise(Eigen::MatrixXd& y);

/// The equations' Jacobian at a point, in doubles: nothing is proven by it.
Eigen::MatrixXd approximate_jacobian(const std::vector<Row>& equations, const std::vector<double>& point);

/// Complete pivoting: rows and columns of a matrix that make a well-conditioned submatrix, at most `most` of each. Ends
/// where no pivot is larger than `least`.
struct Pivots {
  std::vector<int> rows, columns;
};
Pivots pivots(Eigen::MatrixXd t, std::size_t most, double least = 0);

/// Is E·x < x for some x > 0? Then every matrix I − A with |A| ≤ E is regular: the spectral radius of E is below 1. E ≥ 0.
bool is_contraction(const Eigen::MatrixXd& e);

/// Equations F, r of them, over the kept variables.
class Krawczyk {
 public:
  explicit Krawczyk(const std::vector<Row>& equations, int variables);

  /// Chooses the r dependent variables, the centre c (a point) and Y, about the inverse of the dependent columns of the
  /// Jacobian at c. Any c and Y are valid. c: the middle of x; `polished`: moved towards a zero, within x, by Newton's
  /// method in doubles; `refined`: so with values and an inverse computed from enclosures, for solutions so close to a
  /// double one that doubles do not tell them apart. False where the matrix is singular.
  enum class Center { middle, polished, refined };
  bool set(const std::vector<int>& dependent, const Sides& x, Center around);

  /// K = c_D − Y·F(c) + (I − Y·S_D)(Z − c_D) − Y·S_F (X_F − c_F) over x = X_F × Z, with slopes S about c: every zero of F in
  /// x has its dependent variables in K. Entry a belongs to dependent[a].
  Sides image(const Sides& x);
  /// Does an image lie in the interior of x's dependent sides? Then the box holds a zero for every value of the free ones.
  bool is_inside(const Sides& image, const Sides& x) const;
  /// Intersects the dependent sides with it. False: x holds no zero.
  bool shrink(Sides& x, const Sides& image) const;
  /// Is |I − Y·J_D| r < r for some r > 0, J the Jacobian over x? Then F has at most one zero in x for each value of the free
  /// variables.
  bool is_injective(const Sides& x);
  /// Is the centre's dependent part, with every value of the free variables in x, a zero of all equations, exactly?
  bool center_solves(const Sides& x) const;
  /// After image(x0), for x ⊂ x0: encloses the row at the zeros of F in x.
  Enclosure value_at_zeros(const Row& row, const Sides& x) const;
  /// The same as a form in the offsets of the free variables from the centre; of a row, or of one of the variables.
  Form form_at_zeros(const Row& row, const Sides& x, const std::vector<int>& free) const;
  Form form_of_variable(int variable, const Sides& x, const std::vector<int>& free) const;
  /// After image: about |∂(dependent a)/∂x_j|.
  double steepness(std::size_t a, int j) const { return product_[a][j].mag(); }

  const std::vector<double>& center() const { return center_; }

 private:
  // y_ := inverse of the dependent columns at the centre.
  bool invert();
  // The same from the Jacobian in enclosures, by elimination with their midpoints.
  bool invert_refined();
  // One step of Newton's method with Y; did it move the centre?
  bool polish(const Sides& x, const std::vector<double>& values);
  // Of a function value + gradient·(z − c) the same at the zeros z, dependent variables' entries nearly 0.
  void eliminate_dependents(Enclosure& value, Sides& gradient) const;
  // row(c); gradient := its slopes about c over x.
  Enclosure value_and_slopes(const Row& row, const Sides& x, Sides& gradient) const;
  Form form_of(Enclosure value, Sides gradient, const Sides& x, const std::vector<int>& free) const;
  // Y·M, M the rows' entries in their columns.
  void multiply(const std::vector<Sides>& rows, std::vector<Sides>& product) const;

  const std::vector<Row>& equations_;
  int n_;
  std::vector<int> dependent_;
  std::vector<double> center_;
  Eigen::MatrixXd y_;
  Sides center_sides_, residual_;                       // c, Y·F(c)
  std::vector<Sides> entries_, product_, derivatives_;  // product_: Y·S of image()
};

}  // namespace corank::check
