// Sets of degenerate solutions that are known before a search, and tubes about them.
//
// Next to such a set no box is proven that is wider than its distance from the set; so without help a search is endless in
// number of boxes there, or nearly so. With the relations of the set known, a box of the search is cut at the tube's faces
// before it is divided along the set: a few boxes are inside the tube and the others keep away from the set. For example,
// about the circle x = 0, y = 0, c² + s² = 1 the tube is |x| ≤ ε, |y| ≤ ε.
//
// Heuristic: a tube says where boxes are divided. Nothing is deleted by it, and what is proven inside is proven by
// certify::prove_self_motion.
#pragma once

#include "corank/certify/compiled_system.h"
#include "corank/certify/self_motion.h"
#include "corank/core/cover.h"

namespace corank::solve {

/// Linear relations that hold on a set of degenerate solutions, and its dimension as its samples show it.
struct Stratum {
  certify::SelfMotion motion;
  int dimension = 0;
};

/// Where a box is in respect of the tube |r| ≤ ε · (size of r) for each relation r = 0 of the stratum. The size of r is the
/// sum of |coefficient| · typical size over its variables.
struct TubePlace {
  enum class Where { outside, across, inside };
  Where where = Where::outside;
  /// Across: a variable, and the face of the tube in its side at which the box is to be cut; −1: no relation of one variable
  /// has such a face.
  int variable = -1;
  double at = 0;
};
TubePlace locate(const Stratum& stratum, const certify::CompiledSystem& system, const Box& x);

}  // namespace corank::solve
