// Which types of singularity do the solutions in a box have (core/singularity_types.h)? Each type is an inequality between
// ranks of blocks of L.
//
// Theorem: let every block M have rank in [lo_M, hi_M] at each solution in a box B. lo comes from a regular submatrix
// (KernelBound's theorem) and holds for all of B; hi from entries that are 0 always and from the kernel that the system asks
// for, and holds at its solutions. An inequality between ranks that holds for all numbers in these ranges (for none) proves
// (excludes) its type at every solution in B. The ranges may be narrowed by what holds of ranks anyway:
//   lo_p ≤ rk L_p ≤ rk L_y ≤ n_u + rk L_p,   rk L_y + rk g_v ≤ rk L,   and the same with z, n_v and g_u
// ([L_v′ L_y′; g_v 0] has rank rk L_y′ + rk g_v at least).
#pragma once

#include <array>
#include <optional>

#include "corank/certify/kernel_bound.h"
#include "corank/core/exact_point.h"
#include "corank/core/singularity_types.h"

namespace corank::certify {

/// Of each block.
using RankBounds = std::array<int, kBlocks>;

class TypeBounds {
 public:
  /// Both have to outlive this.
  TypeBounds(const System& system, const VelocityBlocks& blocks);

  /// Lower bounds of the blocks' ranks all over the box, as far as types rest on them; the sides may be halved so many
  /// times. `known`: bounds in a larger box, which hold in this one; `wanted`: the types of interest. Requires
  /// UpwardRounding::active().
  RankBounds ranks(const Box& box, int halvings = 0, const RankBounds& known = {}, TypeSet wanted = kAllTypes) const;
  /// Of every solution of the system in a box with these lower bounds.
  TypeLabels labels(const RankBounds& ranks) const;
  TypeLabels in(const Box& box, int halvings = 0) const { return labels(ranks(box, halvings)); }
  /// Of an exact solution, or a configuration whose kernel is continuous: the ranks themselves, by exact elimination
  /// (exact_rank). Nothing is proven where they cannot be decided, or once `ended` is true.
  TypeLabels at(const ExactPoint& point, const Ended& ended = {}) const;

 private:
  const System& system_;
  const VelocityBlocks& blocks_;
  std::array<std::optional<KernelBound>, kBlocks> bounds_;
};

}  // namespace corank::certify
