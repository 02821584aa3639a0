// What a page draws of a set of very many boxes.
#pragma once

#include <cstddef>

#include "corank/report/pictures/components.h"
#include "corank/result/values/result.h"

namespace corank::report {

/// A page with more boxes than this opens in no browser in any useful time.
inline constexpr std::size_t kMostDrawn = 1'000'000;
/// Of a page that is written after its run was ended, so that it is there within a second.
inline constexpr std::size_t kMostDrawnAtTheEnd = 50'000;

/// The page draws at most this many neighbouring boxes as one; 1: each box is drawn. Boundaries of a workspace,
/// whose boxes have sides, are drawn box by box. Components that were not counted: the run was ended.
std::size_t boxes_in_one(const result::Result& result, const Components& found);

/// Hulls of up to `in_one` neighbouring boxes of the same verdict and self-motion: whatever the boxes enclose the hulls
/// enclose, and they have only the types that all of their boxes have. Without regions, since nothing is proven of hulls.
std::vector<CoverBox> hulls_of(const result::Result& result, std::size_t in_one);

}  // namespace corank::report
