// Where two solutions of one system that share some of their values lie: in the products of boxes of its cover.
//
// Theorem: let boxes B_1 … B_N hold all solutions of a system S(w, y) = 0. A solution (w, y, y′) of S(w, y) = 0,
// S(w, y′) = 0 lies in B_i × B_j for some i and j whose sides for w overlap: (w, y) is in some B_i, (w, y′) in
// some B_j, and both hold w. A product in which some inequality of the doubled system fails everywhere holds none.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank::certify {

/// Where the doubled system has the variables of the single one.
struct PairLayout {
  std::vector<int> first, second;  ///< of each variable its place; equal where it is one of w
};

/// The products, as boxes of the doubled system; sides of variables that stand for none are those of its domain.
/// Nothing where they are more than `most`. Requires bounded boxes.
std::optional<std::vector<Box>> pairs(const std::vector<CoverBox>& boxes, const System& doubled, const PairLayout& layout,
                                      std::size_t most);

}  // namespace corank::certify
