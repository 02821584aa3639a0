// Pieces of a set of dimension 2 as polygons in some of its coordinates, to be looked at: nothing is proven by them.
#pragma once

#include "corank/analyze/pieces.h"
#include "corank/core/ended.h"

namespace corank::analyze {

struct PieceDrawing {
  /// Points of one value for each coordinate; an angle's may be beyond its range by less than a turn.
  using Polygon = std::vector<std::vector<double>>;
  std::vector<std::string> coordinates;
  std::vector<bool> is_angle;
  std::vector<std::vector<Polygon>> pieces;  ///< in the order of Pieces::representatives
};

/// `coordinates`: lengths and angles of the cells' system. Empty where the set has not two dimensions, or there is no such
/// coordinate; nothing where it was `ended`.
std::optional<PieceDrawing> draw(SignCells& cells, const Pieces& pieces, const std::vector<std::string>& coordinates,
                                 const Ended& ended);

}  // namespace corank::analyze
