// Critical points of a height on the strata of a set that ends where functions e_j ≥ 0 end it: its shape by Morse theory.
//
// M = {F = 0, e_j ≥ 0 for each end j}; the stratum of a set A of ends is where e_j = 0 for j ∈ A and e_j > 0 for the others;
// h is a linear function of lengths, cosines and sines. In coordinates q, an angle one of them, the closed stratum's system
//   F = 0,   e_j = 0 (j ∈ A),   Σ λ_i D_q F_i + Σ_A ν_j D_q e_j + μ D_q h = 0,   ‖(λ, ν, μ)‖ = 1,   μ ≥ 0
// is square. Let d be the dimension of {F = 0}, and for each A with |A| ≤ d let the solutions of its system in M be known,
// all of them isolated and of a known kind (StratumTest::kind). Then (doc/theory.md, "The shape of a smooth set")
// 1. M is a manifold with corners: at each of its points the gradients of F and of the ends that are 0 there are
//    independent.
// 2. h is a Morse function on M. With Dh = Σ a_j De_j on the tangent space of {F = 0} at a critical point of the stratum,
//    a_j = −ν_j/μ, no a_j is 0, and h has a nondegenerate second-order form along the stratum. The point is *counted* where
//    all a_j > 0: h grows inward across every end. Theorem (Goresky, MacPherson, "Stratified Morse Theory", 1988, part I,
//    ch. 3): if M is compact, χ(M) = Σ (−1)^index over the counted points, the index being that of h along the stratum.
// 3. Each component of M has a minimum, which is a counted point of index 0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/contact.h"
#include "corank/core/system.h"

namespace corank::certify {

/// An end of a set: a function that is positive inside, and which end of the domain or which inequality it stands for.
struct End {
  Polynomial function;
  Contact::With with = Contact::With::inequality;
  int index = 0;  ///< as Contact::index
};

/// The systems of the strata. With an angle's chord in A its cosine and sine have [−1, 1] as their domain, and with an end
/// of a variable in A the domain goes on there: the equation e_j = 0 takes the place of what was dropped.
class Strata {
 public:
  /// `height`: the number of the height, 0, 1 …; `problem()` is not empty where the system is not one that is understood.
  Strata(const System& system, std::vector<End> ends, int height);

  const std::string& problem() const { return problem_; }
  const std::vector<End>& ends() const { return ends_; }
  /// d, where F has its full rank somewhere: coordinates less equations.
  int dimension() const { return static_cast<int>(coordinates_.size() - rows_.size()); }
  int variables() const { return system_.size(); }  ///< x
  const Polynomial& height() const { return height_; }
  /// The closed stratum {F = 0, e_j = 0 for each of these ends}, in x.
  System closed(const std::vector<int>& ends) const;
  System edge(int end) const { return closed({end}); }
  /// All A with |A| ≤ dimension(), but for both ends of one variable.
  std::vector<std::vector<int>> strata() const;

  struct Stratum {
    std::vector<int> ends;  ///< A
    System system;          ///< in x, then λ, ν, μ
    /// For each coordinate and each row, then for each coordinate and coordinate: D_q of F and e_A, D²_q of μh + λF + νe.
    std::vector<Polynomial> jacobian, hessian;
    int rows = 0, coordinates = 0;
  };
  /// Requires UpwardRounding::active().
  Stratum stratum(const std::vector<int>& ends) const;

 private:
  struct Coordinate {
    int length = -1;             // a variable, or
    int cosine = -1, sine = -1;  // an angle's
  };
  static Polynomial derivative(const Polynomial& f, const Coordinate& q);
  double size(const Coordinate& q) const;
  void relax(System& system, const std::vector<int>& ends) const;
  void find_coordinates();
  void make_height(int height);

  System system_;
  std::vector<End> ends_;
  std::vector<Coordinate> coordinates_;
  std::vector<int> rows_;  // equations, but for circles and values of angles
  Polynomial height_;
  std::string problem_;
};

/// What is proven of the solution in a box.
class StratumTest {
 public:
  StratumTest(const Strata& strata, const Strata::Stratum& stratum);

  struct Kind {
    int index = 0;            ///< of h along the stratum
    std::vector<int> inward;  ///< signs of a_j, ±1, for each j ∈ A
    bool counted() const;
  };
  /// Nothing where it is not shown that μ > 0, e_j > 0 for j ∉ A, a_j ≠ 0 for j ∈ A and the form is nondegenerate. Requires
  /// UpwardRounding::active().
  std::optional<Kind> kind(const Box& point) const;

 private:
  Interval value(std::size_t k, const Box& box) const {
    return compiled_.evaluate(compiled_.value_row(static_cast<int>(k)), box);
  }

  std::size_t ends_in_, others_;
  int rows_, coordinates_;
  CompiledSystem compiled_;
};

}  // namespace corank::certify
