// Solutions that are known exactly, verified in rational arithmetic (core/exact_point.h).
//
// With p the polynomial that defines t: g(t) = 0 wherever p divides g, and g(t) ≠ 0 wherever an enclosure of g over an
// interval around t has no 0. Sturm's theorem: a polynomial has as many distinct real roots in (a, b] as its Sturm chain
// loses changes of sign from a to b.
#pragma once

#include <optional>
#include <string>

#include "corank/check/enclosure.h"
#include "corank/check/stop.h"
#include "corank/core/cover.h"
#include "corank/core/singularity_types.h"

namespace corank::check {

class ExactCheck {
 public:
  /// Checks that the point defines numbers: fault() is empty where it does.
  ExactCheck(const System& system, const ExactPoint& point, const StopFlag& stop = {});
  const std::string& fault() const { return fault_; }

  /// Each of these returns what could not be shown, nothing where all was.
  /// All equations, domains and inequalities that have no variable of unknown value hold.
  std::string holds() const;
  /// The kernel of M(q), M(q) ξ = 0 the equations that are linear in the variables of kind kernel, has the dimension that
  /// the point says: exact elimination with pivots that are not 0 at t, until all that remains is 0 modulo p.
  std::string kernel() const;
  /// The rank of a matrix at the point, likewise; nothing where it is not shown.
  std::optional<int> rank(const PolynomialMatrix& matrix) const;
  /// The known coordinates lie in the box.
  std::string inside(const Box& box) const;
  /// No point of the box is farther from the point, in any known variable, than the radius.
  std::string within(double radius, const Box& box) const;
  bool knows(int variable) const { return !point_.coordinates[variable].empty(); }
  /// Encloses a known coordinate.
  const Enclosure& coordinate(int variable) const { return coordinates_[variable]; }

  // Arithmetic modulo p: no coefficients stand for 0.
  const RationalPolynomial& polynomial(int variable) const { return reduced_[variable]; }
  const RationalPolynomial& minimal() const { return p_; }  ///< p, monic
  const StopFlag& stop() const { return stop_; }
  const ExactNumber& lower() const { return lower_; }  ///< bounds of t, narrow
  const ExactNumber& upper() const { return upper_; }
  RationalPolynomial product(const RationalPolynomial& f, const RationalPolynomial& g) const;
  RationalPolynomial sum(RationalPolynomial f, const RationalPolynomial& g) const;
  Enclosure enclose(const RationalPolynomial& f) const;

 private:
  std::string check_root();
  RationalPolynomial reduced(RationalPolynomial f) const;
  using Rows = std::vector<std::vector<RationalPolynomial>>;
  std::optional<int> rank(Rows rows, std::size_t columns) const;
  // Nothing where an entry is not known or not rational.
  std::optional<Rows> values(const PolynomialMatrix& matrix) const;
  // Nothing where a value is not known or not rational.
  std::optional<RationalPolynomial> value(const Monomial& m) const;
  std::optional<RationalPolynomial> value(const Polynomial& f) const;
  bool is_nonnegative(const RationalPolynomial& f) const { return f.empty() || enclose(f).is_positive(); }
  bool is_known(const Polynomial& f) const;

  const System& system_;
  const ExactPoint& point_;
  StopFlag stop_;
  RationalPolynomial p_;
  ExactNumber lower_, upper_;
  Enclosure t_;
  std::vector<RationalPolynomial> reduced_;  // coordinates modulo p
  std::vector<Enclosure> coordinates_;
  std::string fault_;
};

}  // namespace corank::check
