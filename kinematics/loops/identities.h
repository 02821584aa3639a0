// Which equations of a robot follow from others, by exact identities.
//
// A robot that is over-constrained by its count, such as the 3-UPU translator, has closure equations that say again what
// others say. Where e = Σ pᵢ fᵢ with polynomials pᵢ and equations fᵢ = 0 that are known, e = 0 adds nothing and is left out.
// Multiplying out Σ pᵢ fᵢ again is the proof.
//
// Found by division: known polynomials are divided by in the order in which they were added, with the circles
// sin² + cos² = 1 of all angles among them. They are no Gröbner basis, so a remainder that is not 0 proves nothing.
// Work is bounded by a count of operations on terms, the same on each machine; after those nothing more is implied.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "corank/kinematics/robot/algebra.h"

namespace corank::kinematics {

class Identities {
 public:
  static constexpr std::size_t kOperations = 4'000;  // an Exechon takes 2,000 of them
  explicit Identities(const Algebra& algebra, std::size_t operations = kOperations)
      : algebra_(algebra), operations_left_(operations) {}

  /// Of equations that were added.
  using Numbers = std::set<std::size_t>;

  /// From now on e = 0 is known, by this number. e: a polynomial in coordinates, and sines and cosines of them.
  void add(const ex& e, std::size_t equation);
  /// Equations fᵢ with which e = Σ pᵢ fᵢ, circles aside; that is proven. Nothing where none were found, which says nothing.
  std::optional<Numbers> sources(const ex& e);
  bool imply(const ex& e) { return sources(e).has_value(); }

 private:
  using Monomial = std::map<std::size_t, int>;  // powers of numbered bases
  /// By degree, then reverse lexicographically, the largest first: an order that products keep, so that a division replaces
  /// a monomial by smaller ones only. (Lexicographically, coefficients grow: 44 s for 60 random robots in place of 12.)
  struct Before {
    bool operator()(const Monomial& a, const Monomial& b) const;
  };
  using Polynomial = std::map<Monomial, ex, Before>;  // coefficients that are not 0
  struct Known {
    Polynomial value;  // whose first coefficient is 1
    Numbers of;        // the equations that it is a combination of
  };

  void insert(Polynomial& sum, const Monomial& monomial, const ex& coefficient) const;
  std::size_t number(const ex& base);
  Polynomial polynomial(const ex& e);
  /// Of the division; nothing once the operations are used up.
  std::optional<Known> remainder(const ex& e);
  void add(Known rest);

  const Algebra& algebra_;
  std::size_t operations_left_;
  std::map<ex, std::size_t, GiNaC::ex_is_less> numbers_;
  std::vector<Known> known_;
};

}  // namespace corank::kinematics
