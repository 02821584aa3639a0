#include <algorithm>

#include "corank/analyze/pieces/pieces.h"

namespace corank::analyze {

void keep_required(Pieces& pieces, const std::vector<Standing>& standings) {
  Pieces kept;
  std::vector<int> places;  // of each piece, among those that are kept
  const auto known = std::min(pieces.representatives.size(), static_cast<std::size_t>(pieces.at_least));
  for (std::size_t i = 0; i < pieces.representatives.size(); ++i) {
    if (standings[i] == Standing::satisfied) {
      places.push_back(static_cast<int>(kept.representatives.size()));
      kept.representatives.push_back(std::move(pieces.representatives[i]));
      kept.signs.push_back(std::move(pieces.signs[i]));
      kept.free.push_back(std::move(pieces.free[i]));
      continue;
    }
    places.push_back(-1);
    if (i >= known) continue;  // it may be another one's piece
    --pieces.at_least;
    const bool violated = standings[i] == Standing::violated;
    if (violated && pieces.at_most) --*pieces.at_most;
    pieces.beside.push_back({.box = std::move(pieces.representatives[i]),
                             .free = std::move(pieces.free[i]),
                             .signs = std::move(pieces.signs[i]),
                             .requirements = violated ? -1 : 0});
  }
  pieces.representatives = std::move(kept.representatives);
  pieces.signs = std::move(kept.signs);
  pieces.free = std::move(kept.free);
  std::erase_if(pieces.parts, [&](Pieces::CellPart& part) { return (part.piece = places[part.piece]) < 0; });
  if (pieces.exact())
    pieces.reason = "";
  else if (pieces.reason.empty())
    pieces.reason = "pieces of which it is not shown whether they meet the requirements";
}

}  // namespace corank::analyze
