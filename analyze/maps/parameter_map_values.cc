// What a map says, from its cells.
#include <algorithm>
#include <iterator>

#include "corank/analyze/maps/parameter_map.h"

namespace corank::analyze {
namespace {

const char* const kAnswers[] = {"solutions", "components", "aspects", "assembly-modes", "working-modes"};

}  // namespace

const char* to_string(MapAnswer answer) { return kAnswers[static_cast<std::size_t>(answer)]; }

std::optional<MapAnswer> map_answer_from_string(const std::string& text) {
  for (std::size_t k = 0; k < std::size(kAnswers); ++k)
    if (text == kAnswers[k]) return static_cast<MapAnswer>(k);
  return std::nullopt;
}

double ParameterMap::share_of(const MapCellAnswer& cell) const {
  return cell.sides[0].width() * cell.sides[1].width() / (region[0].width() * region[1].width());
}

std::map<int, double> ParameterMap::shares() const {
  std::map<int, double> shares;
  for (const MapCellAnswer& c : cells)
    if (const auto& count = c.kind == MapCellAnswer::Kind::centre ? c.at_centre : c.count) shares[*count] += share_of(c);
  return shares;
}

double ParameterMap::proven_share() const {
  double share = 0;
  for (const MapCellAnswer& c : cells)
    if (c.kind == MapCellAnswer::Kind::proven) share += share_of(c);
  return share;
}

double ParameterMap::share_where(Standing standing) const {
  double known = 0;
  for (const MapCellAnswer& c : cells)
    if (standing == Standing::open ? c.count == 0 || (c.standing && c.standing != Standing::open) : c.standing == standing)
      known += share_of(c);
  return standing == Standing::open ? std::max(0.0, 1 - known) : known;
}

}  // namespace corank::analyze
