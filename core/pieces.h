// What is claimed of the pieces of a solution set without the zeros of some functions.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/shape.h"

namespace corank {

/// A configuration of a piece.
struct PieceMember {
  Box box;                                 ///< about it
  std::vector<int> free;                   ///< variables that may be held at the box's middle to find it
  std::vector<int> signs;                  ///< ±1, of each function
  std::array<int, 2> determinant_signs{};  ///< of det L_y and det L_z; 0: nothing is claimed
  /// 1: what is required of the robot is met there, and so on the whole piece; −1: it is not; 0: nothing is claimed.
  int requirements = 1;
};

/// A part of a sheet: over a box of the sheet's free variables, in their order.
struct PieceCell {
  int sheet = 0;
  std::vector<Interval> sides;
};

/// A solution in two or more cells.
struct PieceLink {
  std::vector<double> point;  ///< near it
  std::vector<int> held;      ///< variables that have the point's values exactly; as many as the set has dimensions
};

/// Where to look for a proof that there are no more pieces. Sheets are the boxes of the cover, then the bridges.
struct PieceProof {
  std::vector<SheetBridge> bridges;
  std::vector<PieceCell> cells;
  std::vector<PieceLink> links;
};

/// Of all pieces. Those in which the requirements are met are as many less the members that do not claim it, and at most as
/// many less those that claim the contrary.
struct PieceClaims {
  int at_least = 0;
  std::optional<int> at_most;
  std::vector<PieceMember> members;  ///< one of each piece that is claimed to be there
  std::vector<std::string> factors;  ///< of the determinants: the functions, in the order of the signs
  std::optional<PieceProof> proof;   ///< of at_most

  int members_with(int requirements) const;  ///< that claim this of their requirements
};

}  // namespace corank
