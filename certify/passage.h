// Can the output of a mechanism pass a configuration of its workspace boundary? (PassageForm)
//
// Theorem. Let (q, λ) solve a part of the boundary, let no limited coordinate but those of the part be at a limit and no
// inequality be 0 at q, and
//   (1) n = Φ_uᵀ λ ≠ 0;
//   (2) λ_r ≠ 0 for a row r, and n_e − 1 columns D of Φ_z without that row form a regular matrix N.
// Then the left kernel of Φ_z is the line of λ, and ker Φ_z has the basis w_a = (1 at column a, −N⁻¹ Φ_{r,a} at D), a ∉
// D. With the matrix S_ab = w_aᵀ (λᵀ D²Φ) w_b and the slacks s_i:
//   S and all s_i positive (negative) definite: there is a neighbourhood of q in the configurations within the limits whose
//     outputs lie on the side of −n (n) of the boundary's image there, or on it: a barrier;
//   some sign + and some sign − among the values of S and the s_i: there are motions through q on which the output goes
//     straight through u from one side to the other: traversable.
// Proof: doc/theory.md, "Barriers". Where the system has no λ (PassageForm::multipliers), λ is the vector with λ_r = 1 and
// λᵀN = −Φ_{r,D} on the other rows: a left kernel vector of Φ_z, which it has at every solution, is a multiple of it. Over a
// box each hypothesis is shown for all of its points: N by preconditioning, (S, definite) by Gershgorin's discs after a
// congruence, signs by intervals.
#pragma once

#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/inertia.h"
#include "corank/core/cover.h"

namespace corank::certify {

class PassageTest {
 public:
  explicit PassageTest(const System& system);

  /// The system has a form, and exact coefficients.
  bool applies() const { return form_.has_value(); }
  struct Finding {
    Passage passage = Passage::unproven;
    std::vector<double> side{};  ///< CoverBox::side
  };
  /// Of every solution in the box that no further limit cuts. Its sides are halved, the widest first, at most `halvings`
  /// times one after the other; parts without a solution say nothing. Requires applies() and UpwardRounding::active().
  Finding of(const Box& box, int halvings = 0) const;

 private:
  struct Claim {
    Passage passage;
    int sign;  // of the form: a barrier's
    std::vector<double> side;
  };
  struct Basis {
    std::vector<int> rows, dependent;
  };
  Interval value(int index, const Box& box) const;
  IntervalMatrix jacobian(const std::vector<int>& rows, const Box& box) const;
  bool enclose_multipliers(Box& box) const;
  bool choose(const Box& box, Basis& basis) const;
  std::optional<IntervalMatrix> reduce(const Box& box, const Basis& basis) const;
  bool holds(const Claim& claim, const Box& box) const;
  bool holds(const Claim& claim, Box box, int halvings) const;
  bool contract(Box& box) const;
  Interval along_normal(const std::vector<double>& side, const Box& box) const;  ///< n·side
  Claim guess(const Box& box) const;
  int hessian(int j, int k) const;
  int slack(int i) const;
  int normal(int i) const;

  std::optional<PassageForm> form_;
  bool finds_multipliers_ = false;  // they stand behind the system's variables
  CompiledSystem compiled_;         // value rows: Jacobian, Hessian, slacks, normal
  std::vector<int> arguments_;
};

}  // namespace corank::certify
