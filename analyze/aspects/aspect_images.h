// What the pieces of a set cover in the plane of two lengths: areas in bounds, and which of them lie over one another.
#pragma once

#include "corank/analyze/pieces/pieces.h"

namespace corank::analyze {

struct PieceImages {
  std::vector<Interval> areas;  ///< of each piece's image, in the order of Pieces::representatives
  /// Of each two pieces: do their images have an open set in common (true), no point (false)? Nothing: neither is proven.
  std::vector<std::vector<std::optional<bool>>> share;
};

/// On a grid of `rows` by `rows` squares over the range of the variables x and y. Of the cells' set, of dimension 2, whose
/// pieces are exact. Theorem: every point of a piece lies in one of its parts, whose cells' hulls are the squares that the
/// image may touch. A square G is in the image where for every (x, y) in G exactly one solution lies in a region
/// (newton_prove with x and y free) on which all functions have the piece's signs, and a solution in it lies in a cell that
/// is one part of the piece: the graph over G is connected and without zeros of the functions, so it is in the piece.
PieceImages images(SignCells& cells, const Pieces& pieces, int x, int y, int rows, solve::Control& control);

/// Pieces of a set of dimension 2 as polygons in some of its coordinates, to be looked at: nothing is proven by them.
struct PieceDrawing {
  /// Points of one value for each coordinate; an angle's may be beyond its range by less than a turn.
  using Polygon = std::vector<std::vector<double>>;
  std::vector<std::string> coordinates;
  std::vector<bool> is_angle;
  std::vector<std::vector<Polygon>> pieces;  ///< in the order of Pieces::representatives
};

/// `coordinates`: lengths and angles of the cells' system. Empty where the set has not two dimensions, or there is no such
/// coordinate; nothing where `control` has ended it.
std::optional<PieceDrawing> draw(SignCells& cells, const Pieces& pieces, const std::vector<std::string>& coordinates,
                                 const solve::Control& control);

}  // namespace corank::analyze
