// Where polynomials in the sines and cosines of an arm's joints vanish: by factors, those in one joint by its angles.
//
// With S = sin(θ/2) and C = cos(θ/2), cos θ = C² − S², sin θ = 2 S C and 1 = C² + S² make of a polynomial one that has
// the same degree in S and C in each of its terms, for each joint. Its factors are those of its zeros; as polynomials in
// cos θ and sin θ 1 − cos θ and sin θ have a zero in common, but no factor.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/sets/free_coordinates.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {

/// A joint at a multiple of π/2: so many quarters of a turn, from 0 to 3.
struct QuarterTurns {
  std::string joint;
  int quarters = 0;
  friend auto operator<=>(const QuarterTurns&, const QuarterTurns&) = default;
};

class JointZeros {
 public:
  /// Of polynomials in the unknowns of `matrix`, which is in joints.
  JointZeros(const Mechanism& mechanism, const FreeCoordinates& free, const ExactMatrix& matrix, const Ended& ended);

  /// Where a polynomial vanishes: at one of these values, which are in the joints' ranges, or where one of these factors
  /// does. Neither: nowhere.
  struct Zeros {
    std::vector<QuarterTurns> values;
    std::vector<RationalPolynomial> factors;
    bool empty() const { return values.empty() && factors.empty(); }
    bool has(const QuarterTurns& value) const { return std::ranges::find(values, value) != values.end(); }
    bool has(const RationalPolynomial& factor) const { return std::ranges::find(factors, factor) != factors.end(); }
    /// Those that `other` has, or has not.
    Zeros chosen(const Zeros& other, bool has) const;
    void add(const Zeros& other);
    bool is_within(const Zeros& other) const { return chosen(other, false).empty(); }
  };
  /// Nothing where the factors are not found.
  std::optional<Zeros> of(const RationalPolynomial& f);
  RationalPolynomial at(RationalPolynomial f, const QuarterTurns& value) const;
  /// The angle in the joint's range, exactly; modulo 2π.
  std::optional<Expression> value_of(const QuarterTurns& value) const;
  /// Are these shown to have no zero in common in the joints' ranges? By intervals of the joints.
  bool have_no_common_zero(const std::vector<RationalPolynomial>& polynomials) const;
  /// A polynomial with these zeros; of an angle one minus the cosine of the difference to it.
  RationalPolynomial product(const Zeros& zeros) const;
  /// The joints that turn.
  std::vector<std::string> joints() const;
  /// How many joints turn that these are about.
  std::size_t joints_in(const std::vector<RationalPolynomial>& polynomials) const;

 private:
  /// A joint and its unknowns, S and C those of half_.
  struct Turning {
    std::string name;
    std::optional<std::size_t> cosine, sine;  // where they occur
    std::size_t half_sine, half_cosine;
    std::uint64_t cosines(const RationalPolynomial::Term& t) const { return cosine ? t.powers[*cosine] : 0; }
    std::uint64_t sines(const RationalPolynomial::Term& t) const { return sine ? t.powers[*sine] : 0; }
  };
  /// In half_, behind two of each joint.
  std::size_t other(std::size_t unknown) const { return 2 * turning_.size() + unknown; }
  const Coordinate& coordinate(const std::string& joint) const;
  /// All that can take an angle from −π/2 to 3π/2 into the joint's range, as does the least that takes it to the range's
  /// lower end or beyond; those nearest to 0 first.
  std::array<int, 4> turns_to(const Coordinate& joint) const;
  RationalPolynomial by_half_angles(const RationalPolynomial& f) const;
  /// Back again; nothing where f's degree in a joint is odd.
  std::optional<RationalPolynomial> by_whole_angles(const RationalPolynomial& f) const;
  std::optional<Zeros> by_factors(const RationalPolynomial& f) const;
  std::optional<Zeros> found(const RationalPolynomial& f) const;
  bool add_zeros_of_joint(const RationalPolynomial& f, const Turning& joint, Zeros& zeros) const;
  /// A sine or a cosine of a joint's angle, or of half of it, as an unknown.
  struct Function {
    std::size_t unknown;
    const Turning* joint;
    bool is_sine;
  };
  bool have_no_common_zero(const std::vector<RationalPolynomial>& polynomials, const std::vector<Function>& functions,
                           double share) const;

  const Mechanism& mechanism_;
  const std::vector<Coordinate>& coordinates_;
  const ExactMatrix& matrix_;
  const Ended& ended_;
  std::vector<Turning> turning_;
  std::vector<bool> is_of_joint_;  // of the matrix's unknowns
  PolynomialRing half_{0};
  std::vector<std::pair<RationalPolynomial, std::optional<Zeros>>> known_;  // cases meet the same ones again
};

}  // namespace corank::symbolic
