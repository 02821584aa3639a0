// A matrix of expressions as polynomials over the rational numbers, and what leaves its zeros as they are: rows eliminated
// by entries that are numbers, the block triangular form of the rest, determinants of its blocks. It is square, or wide with
// columns that become zero, and the question where it has not the rank of its rows.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/algebra/rational_polynomial.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/velocity/block_triangular_form.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {

/// No mistake of the model's: its determinant, expanded, is too long to be of use.
class DeterminantTooLarge : public ModelError {
 public:
  using ModelError::ModelError;
};

class ExactMatrix {
 public:
  enum class Shape { square, wide };
  /// Coordinates, constants, sines, cosines and irrational numbers are the unknowns. Holds GiNaC's lock while it lives.
  /// `phi`: Φ, for in_free_coordinates(). Throws ModelError where M does not have that shape, or an entry is no polynomial
  /// in coordinates, sines and cosines.
  ExactMatrix(const Mechanism& mechanism, const ExpressionMatrix& matrix, const std::vector<Expression>& phi = {},
              Shape shape = Shape::square);
  ~ExactMatrix();

  /// det M = ± c det M', where c is an entry that is a number and M' is M without its row and column, after multiples of the
  /// row have made the rest of the column zero. M becomes M', and so on, while there is such an entry.
  void eliminate_numbers();
  /// Of a wide M: its rank is the same without them.
  void leave_out_zero_columns();
  std::size_t size() const { return rows_.size(); }
  /// The columns' names.
  const std::vector<std::string>& columns() const { return columns_; }
  /// block_triangular_form() of the pattern; nothing where M is not square.
  std::optional<std::vector<SquareBlock>> blocks() const;
  /// By Laplace's expansion along one row after the other; minors of the same columns are summed once. Throws
  /// DeterminantTooLarge above 16 rows, or above 20,000 terms.
  RationalPolynomial determinant(const SquareBlock& block) const;
  /// Of the matrix as it was given, sign and number included. Throws likewise.
  RationalPolynomial determinant() const;
  /// 0 where cos² + sin² = 1 of all angles, and √a² = a, show it, else the same polynomial or one with fewer terms.
  RationalPolynomial modulo_circles(const RationalPolynomial& f) const;

  /// The same at every configuration: coordinates that an equation of Φ gives explicitly, as a polynomial in coordinates
  /// that occur before, are replaced by it, and even powers of sines by cosines. f itself where that is longer, unless it is
  /// in fewer unknowns and at most twice as long, or once `ended` says so.
  RationalPolynomial in_free_coordinates(const RationalPolynomial& f, const Ended& ended = {}) const;

  /// Writes M in the coordinates that are left where Φ gives all others; then turns pairs of rows by angles, r_i ↦
  /// cos(θ)·r_i ± sin(θ)·r_j and r_j ↦ cos(θ)·r_j ∓ sin(θ)·r_i, while that makes entries shorter: a frame that turns with
  /// a link does not see the joints before it. At every configuration det M is the same. Where Φ does not, entries get
  /// too long, or `ended` says so, M is left as it is. `leading`: the rows are made short in so many columns, the others are
  /// turned with them; else in all.
  void put_into_free_coordinates(const Ended& ended = {}, std::optional<std::size_t> leading = {});

  /// Does every equation of Φ give a coordinate so?
  bool is_explicit() const { return explicit_.size() == equations_; }
  /// Those coordinates and what they are, x = f, in the equations' order.
  std::vector<Relation> given() const;
  /// The same as polynomials, and the ring's unknown that stands for x.
  struct Explicit {
    std::size_t unknown;
    RationalPolynomial value;
  };
  const std::vector<Explicit>& given_polynomials() const { return explicit_; }

  /// Of all polynomials here.
  const PolynomialRing& ring() const;
  struct UnknownsOfAngle {
    std::optional<std::size_t> cosine, sine;  ///< where they occur
  };
  UnknownsOfAngle unknowns_of(const std::string& angle) const;

  Expression entry(std::size_t row, std::size_t column) const;
  const RationalPolynomial& polynomial(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  Expression expression(const RationalPolynomial& f) const;
  /// The one of ±f with the shorter text; nothing where f holds no coordinate.
  std::optional<Expression> condition(const RationalPolynomial& f) const;

 private:
  bool eliminate_a_number();
  std::vector<std::vector<std::size_t>> filled() const;

  class Unknowns;
  RationalPolynomial without_squares(const RationalPolynomial& f, std::size_t gone, std::size_t kept) const;
  RationalPolynomial normal(RationalPolynomial f) const;  // no square of a sine or of √a: 0 where these show it
  bool turn_rows(std::size_t first, std::size_t second, std::size_t leading);

  SourceLocation where_;
  std::unique_ptr<Unknowns> unknowns_;
  std::vector<std::vector<RationalPolynomial>> rows_;
  std::vector<std::string> columns_;
  std::optional<RationalPolynomial> eliminated_;  // by what the determinant has been divided; none: 1
  bool in_free_coordinates_ = false;
  std::size_t equations_ = 0;
  std::vector<Explicit> explicit_;  // each in unknowns that are none, or stand before it
};

}  // namespace corank::symbolic
