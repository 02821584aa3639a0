// Into how many pieces do functions divide a solution set, at most? From cells and links that a file names (core/pieces.h),
// of which nothing is trusted but where to look.
//
// S is the set of the solutions in the domain at which no function is 0 and each end of the domain and each inequality that
// the equations do not imply holds strictly. Let a cover hold all solutions in the domain, each box a sheet.
//   1. The cells are parts of sheets: of the cover's boxes, which are confirmed, and of bridges, each proven anew. Every
//      solution over a part of a box that the cells of its sheet leave open is not in S, or lies in cells of other sheets.
//      So every point of S lies in a cell, in its part of some signs.
//   2. Each part is connected, or empty, or a passage (check/sign_parts.h).
//   3. Passages of like signs that touch hang together. A piece that lies in passages alone lies in those of one such
//      cluster, and in none where check/growing_parts.h says so. So every piece of S has a connected part.
//   4. Connected parts with a point in common are of one piece: a link's solution, proven to lie in both; or cells of one
//      sheet over boxes that meet, one of which is all of one part.
// So there are at most as many pieces as classes of connected parts.
#pragma once

#include <optional>
#include <string>

#include "corank/check/checker.h"
#include "corank/check/problem.h"
#include "corank/core/pieces.h"

namespace corank::check {

struct PieceBound {
  std::optional<int> at_most;  ///< nothing: `reason` says why
  std::size_t cells = 0, links = 0;
  std::string reason;
};

/// `whole`: the system without a reduction, as many equations fewer than variables as the cover has dimensions; `reduced`:
/// by the cover's reduction. `functions`: over all variables. The boxes are confirmed, `regular` or `boundary`.
PieceBound bound_pieces(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<Row>& functions,
                        const PieceProof& proof, int threads);

}  // namespace corank::check
