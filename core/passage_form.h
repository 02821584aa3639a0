// What decides whether a mechanism's output can pass a configuration of a workspace boundary, as polynomials over the boxes
// of its cover.
//
//   λᵀ Φ_z = 0, ‖λ‖ ≠ 0: the boundary's equations. Their outputs u have the normal n = Φ_uᵀ λ there; z are the coordinates
//   that are neither outputs nor at a limit; a coordinate i at its limit moves by ∓τ_i², which contributes s_i λᵀ Φ_{q_i}.
//   To second order, along velocities that keep u:   n·ü = −Q(v, τ),   Q = λᵀ D²Φ(v, v) + Σ s_i (λᵀ Φ_{q_i}) τ_i²,
//   v ∈ ker Φ_z.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corank/core/polynomial.h"

namespace corank {

/// Of the configurations of a box where no further limit is reached (doc/theory.md, "Barriers").
enum class Passage : std::uint8_t {
  unproven,
  barrier,  ///< nearby configurations have their outputs on one side of the boundary: that of CoverBox::side, if it has one
  traversable  ///< there are paths that bring the output from one side to the other
};
inline constexpr int kPassages = 3;
const char* to_string(Passage passage);

struct PassageForm {
  int equations = 0, columns = 0;    ///< of Φ_z
  std::vector<Polynomial> jacobian;  ///< Φ_z, row by row; rows and columns times positive numbers, in no unit
  std::vector<Polynomial> hessian;   ///< λᵀ Φ_{z_j z_k} for k ≥ j, row by row, times those of columns j and k
  std::vector<Polynomial> slack;     ///< s_i λᵀ Φ_{q_i}: s_i = −1 at an upper limit, 1 at a lower one
  bool has_slacks = true;            ///< else they need further coordinates, and nothing is a barrier
  std::vector<Polynomial> normal;    ///< n; none where ‖n‖ = ‖λ‖, but a side needs further coordinates
  /// Of each equation the variable that λ's component is a positive multiple of. None: the system has no λ. Its polynomials
  /// then count λ's components behind the system's variables, and λ spans the left kernel of Φ_z.
  std::vector<int> multipliers;

  /// How many variables its polynomials name that the system does not have.
  int further_variables() const { return multipliers.empty() ? equations : 0; }
};

}  // namespace corank
