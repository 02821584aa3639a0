// The pieces of a smooth set without the zeros of given functions, counted on cells (sign_cells.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/pieces/sign_cells.h"
#include "corank/core/pieces.h"
#include "corank/core/requirement.h"

namespace corank::analyze {

struct Pieces {
  int at_least = 0;
  std::optional<int> at_most;
  /// Of each piece known to be there a box with a solution of it; of pieces not known to differ one box each.
  std::vector<Box> representatives;
  std::vector<std::vector<int>> signs;  ///< of the factors in each representative
  std::vector<std::vector<int>> free;   ///< variables that may be held at its middle to find it
  struct CellPart {
    std::size_t cell;
    std::vector<int> signs;  ///< of all functions, the limits among them
    int piece;               ///< index of its representative
  };
  std::vector<CellPart> parts;  ///< of the cells, which make the pieces
  /// Pieces that keep_required() took out: those that do not meet the requirements (−1), or may not (0).
  std::vector<PieceMember> beside;
  std::size_t cells = 0;  ///< of how many cells they are
  std::string reason;     ///< why the bounds are apart; empty where they are not
  PieceProof proof;       ///< of at_most, for others to check

  bool exact() const { return at_most && *at_most == at_least; }
};

/// at_most: the classes of parts of cells that are not empty, joined where a solution in two parts is proven; nothing where
/// some part may hide another piece. at_least: those classes, joined where cells touch and have parts of the same signs.
Pieces pieces(SignCells& cells, solve::Control& control);

/// Leaves out those pieces whose representatives do not meet, or are not shown to meet, what is required of the robot;
/// `standings` says so of each. Theorem: of pieces that differ, those that do not meet it are no more than at_most
/// less those that do. Requires that requirements are met on a whole piece or nowhere in it (symbolic::required_space).
void keep_required(Pieces& pieces, const std::vector<Standing>& standings);

/// Of each box of some cover of the set, for pictures, the number of the piece in which its solutions are that are in any;
/// where there are several the one of a solution next to its middle. −1: none is known. Ends early, with −1 of the rest,
/// where `control` does.
std::vector<int> piece_places(SignCells& cells, const Pieces& pieces, const std::vector<CoverBox>& boxes,
                              const solve::Control& control);

/// Of pieces that are exact: the one in which all solutions in the box and next to it lie at which the functions have these
/// signs. Theorem: each lies in a cell that the box meets, in the part of these signs. Nothing where no piece is known.
std::optional<int> only_piece(const SignCells& cells, const Pieces& pieces, const Box& box, const std::vector<int>& signs);

}  // namespace corank::analyze
