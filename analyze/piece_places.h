// In which piece of a set the boxes of some cover of it lie: for pictures, which give each piece a colour.
#pragma once

#include <optional>
#include <vector>

#include "corank/analyze/sign_cells.h"

namespace corank::analyze {

struct Pieces;

/// Of each box the number of the piece in which its solutions are that are in any, in the order of
/// Pieces::representatives; where there are several the one of a solution next to its middle. −1: none is known. Ends
/// early, with −1 of the rest, where `control` does.
std::vector<int> piece_places(SignCells& cells, const Pieces& pieces, const std::vector<CoverBox>& boxes,
                              const solve::Control& control);

/// Of pieces that are exact: the one in which all solutions in the box and next to it lie at which the functions have these
/// signs. Theorem: each lies in a cell that the box meets, in the part of these signs. Nothing: not known, or there is none.
std::optional<int> only_piece(const SignCells& cells, const Pieces& pieces, const Box& box, const std::vector<int>& signs);

}  // namespace corank::analyze
