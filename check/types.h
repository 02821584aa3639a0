// Labels of boxes and exact points: the types of singularity that every solution has, or none (core/singularity_types.h).
//
// Each type is an inequality between ranks. At a solution no block's rank is above VelocityBlocks::at_most; that a rank is
// not below r all over a box, KernelCheck shows. Besides, whatever the ranks are,
//   rk L_p ≤ rk L_y ≤ n_u + rk L_p,   rk L_y + rk g_v ≤ rk L,   and the same with z, n_v and g_u.
// A label is confirmed where these bounds leave no other case. Of an exact point the ranks themselves are found.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "corank/check/exact.h"
#include "corank/check/kernel.h"
#include "corank/core/singularity_types.h"

namespace corank::check {

class TypeCheck {
 public:
  /// The blocks have to outlive this.
  TypeCheck(const System& system, const VelocityBlocks& blocks, const StopFlag& stop = {});

  /// What could not be shown of the labels; nothing where all was.
  std::string of_box(const TypeLabels& labels, const Box& box) const;
  std::string of_point(const TypeLabels& labels, const ExactCheck& point) const;

 private:
  class InBox;
  const VelocityBlocks& blocks_;
  std::array<std::unique_ptr<const KernelCheck>, kBlocks> ranks_;
};

}  // namespace corank::check
