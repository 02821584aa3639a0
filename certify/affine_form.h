// Affine forms over a box of offsets δ: what depends on q is c + Σ_j a_j δ_j there, with some numbers c and a_j, which may
// depend on q, in intervals. Offsets that stand in two forms are the same, so what cancels to first order does.
#pragma once

#include <span>
#include <vector>

#include "corank/core/interval.h"

namespace corank::certify {

/// All operations require UpwardRounding::active().
struct AffineForm {
  Interval constant;
  std::vector<Interval> slopes;

  /// Encloses its values for offsets in these sides.
  Interval range(std::span<const Interval> offsets) const;
  /// this += factor·f, factor a number in the interval.
  void add(const Interval& factor, const AffineForm& f);
};

/// f·g: (c + Lδ)(d + Mδ) = cd + (cM + dL)δ + (Lδ)(Mδ), the last term in its constant.
AffineForm product(const AffineForm& f, const AffineForm& g, std::span<const Interval> offsets);

}  // namespace corank::certify
