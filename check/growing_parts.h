// Parts of cells that have a direction in which they grow (passages, check/sign_parts.h) and hang together: may a piece
// lie in them alone? The checker's own.
//
// Theorem. Let P be a piece of S (check/pieces_bound.h), of the signs s, that lies in the union U of finitely many cells
// only, and K one function or more, with weights w_k > 0. For each cell let a direction d of its free variables be given
// along which s_j·∂g_j/∂d > 0 all over the cell for each function that has both signs there, and for each k in K that may
// be the least of K there: w_k·s_k·g_k has not a minimum over the cell above the maximum of another's. Then there is no
// such P.
//   Proof: h = min w_k·s_k·g_k over K has its maximum over the closure of P, which is compact, at some x in a cell. Let
// points y of P come to x, and go from them along d on the sheet, which goes on about x: the functions that vanish at x
// grow, the others keep their signs, so these points are in P. Where h is taken at x, the functions grow, too: along a
// short way, the same for all y, h grows by an amount that does not depend on y, and so comes above its maximum. A
// contradiction.
//   With K = {k}, k having both signs in each cell, any direction of each cell will do. And in cells of one sheet that
// share d, the linear function d·x takes the place of h.
#pragma once

#include <vector>

#include "corank/check/sign_parts.h"

namespace corank::check {

/// A cell's part of the signs in question, neither connected nor empty as far as is known.
struct GrowingPart {
  const SignCell* cell = nullptr;
  std::size_t sheet = 0;
  SignParts::Directions directions{};  ///< SignParts::passages
  bool grows = false;                  ///< SignParts::grow_together of its mixed functions
};

/// Those that do not satisfy the theorem's hypothesis; none: no piece of these signs lies in these cells alone.
std::vector<std::size_t> in_the_way(const SignParts& parts, const std::vector<GrowingPart>& passages,
                                    const std::vector<int>& signs);

}  // namespace corank::check
