// How many connected pieces does a set have? Counted from both sides: gaps between boxes keep pieces apart, links join them.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/shape.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

/// A box with this verdict holds a solution in the search domain.
inline bool is_proven(Verdict v) { return v == Verdict::regular || v == Verdict::isolated || v == Verdict::exact; }

/// The connected components of a set S whose complete cover is given.
struct Components {
  int at_least = 0;
  std::optional<int> at_most;  ///< nothing: no bound is proven
  std::vector<int>
      piece_of_box;  ///< of each box: boxes of one piece are proven to be parts of one component; −1: nothing is proven
  int pieces = 0;
  std::vector<SheetLink> links;      ///< that make the pieces
  std::vector<SheetBridge> bridges;  ///< of which some of them speak
  /// Why the bounds are apart, in words; empty where they are not.
  std::string reason;

  bool exact() const { return at_most && *at_most == at_least; }
};

/// at_least: the groups of boxes that hold a proven solution. A component lies in the union of the boxes, pending ones
/// among them. Boxes of one piece are in one group, and so are boxes that touch, unless a search shows that they have no
/// solution in common. So solutions in different groups cannot be joined: the groups' parts of S are closed and disjoint.
/// at_most: the boxes' pieces after all links (certify/meeting.h) that could be proven. Every point of S lies in a box,
/// and a `regular` or `isolated` one holds parts of one connected piece only. With other boxes no upper bound is known. Of
/// sets of dimension 0: their distinct points.
Components components(const System& system, const Cover& cover, solve::Control& control);

}  // namespace corank::analyze
