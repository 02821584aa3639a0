#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/maps/parameter_map.h"
#include "corank/core/check.h"

namespace corank::analyze {
namespace {

constexpr std::array kKinds{"proven", "undecided", "centre", "pending"};

MapCellAnswer::Kind kind_from(const std::string& word) {
  for (std::size_t k = 0; k < kKinds.size(); ++k)
    if (word == kKinds[k]) return static_cast<MapCellAnswer::Kind>(k);
  throw std::invalid_argument("no kind of cell: " + word);
}

Json row(const Box& sides) { return {sides[0].lo(), sides[0].hi(), sides[1].lo(), sides[1].hi()}; }

Json row(const MapCellAnswer& c) {
  Json json = row(c.sides);
  json.push_back(to_string(c.kind));
  json.push_back(or_null(c.count));
  json.push_back(or_null(c.at_centre));
  if (c.standing) json.push_back(to_string(*c.standing));
  return json;
}

template <class Proven>
Json row(const Proven& b) {
  Json json = row(b.sides);
  json.push_back(b.proven);
  return json;
}

template <class Item>
Json rows(const std::vector<Item>& items) {
  Json json = Json::array();
  for (const Item& item : items) json.push_back(row(item));
  return json;
}

Box sides_of(const Json& row) {
  return {Interval(row.at(0).get<double>(), row.at(1).get<double>()),
          Interval(row.at(2).get<double>(), row.at(3).get<double>())};
}

std::optional<int> count_of(const Json& json) { return json.is_null() ? std::nullopt : std::optional(json.get<int>()); }

std::optional<Standing> standing_of(const Json& cell) {
  if (cell.size() <= 7) return std::nullopt;
  const auto standing = standing_from_string(cell.at(7).get<std::string>());
  if (!standing) throw std::invalid_argument("no standing of a cell: " + cell.at(7).get<std::string>());
  return standing;
}

// "4 cusps, proven to be all on the plane".
std::string points_line(const char* kind, const std::vector<CriticalPoint>& points, bool known) {
  const auto proven = std::ranges::count_if(points, &CriticalPoint::proven);
  return fmt::format("  {:<22}{}{}\n", kind, proven,
                     known ? ", proven to be all on the plane" : " proven; there may be more");
}

std::string percent(double share) {
  return share > 0 && share < 0.001 ? "below 0.1 %" : fmt::format("{:.1f} %", 100 * share);
}

std::string noun(const ParameterMap& map, int n) {
  std::string word = map.answer == MapAnswer::solutions ? "solutions" : to_string(map.answer);
  std::ranges::replace(word, '-', ' ');
  if (n == 1) word.pop_back();
  return word;
}

std::size_t cells_of(const ParameterMap& map, MapCellAnswer::Kind kind) {
  return std::ranges::count_if(map.cells, [&](const MapCellAnswer& c) { return c.kind == kind; });
}

}  // namespace

const char* to_string(MapCellAnswer::Kind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

result::MapFile to_file(const MapQuestion& question, const ParameterMap& map) {
  CORANK_CHECK(map.claims.has_value());
  const study::Question& q = question.question;
  auto file = file_about<result::MapFile>(q);
  file.family = {q.set, q.kernel, q.corank, question.over, question.fixed};
  file.claims = *map.claims;
  return file;
}

std::string to_table(const ParameterMap& map) {
  const auto of = [&](std::size_t k) {
    return fmt::format("{} in [{:.6g}, {:.6g}]", map.names[k], map.region[k].lo(), map.region[k].hi());
  };
  std::string text = fmt::format("{}, {}: {}, {}\n", map.model, map.set, of(0), of(1));
  for (const auto& [name, range] : map.tolerances)
    text += fmt::format("  {:<22}with {} in [{:.6g}, {:.6g}]\n", &name == &map.tolerances[0].first ? "every robot" : "",
                        name, range.lo(), range.hi());
  const bool sampled = map.answer != MapAnswer::solutions;
  for (const auto& [n, share] : map.shares())
    text += fmt::format("  {:<22}{}{}\n", fmt::format("{} {}", n, noun(map, n)), percent(share),
                        sampled ? " of the cells, at their centres" : " of the plane, proven for every value there");
  const double proven = map.proven_share();
  if (!sampled)
    text += fmt::format("  {:<22}{} of the plane, where the number may change\n", "undecided",
                        percent(std::max(0.0, 1 - proven)));
  for (const std::string& r : map.require) text += fmt::format("  {:<22}{}\n", "required", r);
  if (!map.require.empty()) {
    const auto line = [&](const char* what, Standing standing, const char* words) {
      text += fmt::format("  {:<22}{} of the plane{}\n", what, percent(map.share_where(standing)), words);
    };
    line("satisfied", Standing::satisfied, ", proven for every solution there");
    line("violated", Standing::violated, ", proven for a solution at every place there");
    line("open", Standing::open, ", where solutions may be");
  }
  text += fmt::format("  {:<22}{} ({} proven, {} undecided{}{}), {} boxes processed\n", "cells", map.cells.size(),
                      cells_of(map, MapCellAnswer::Kind::proven), cells_of(map, MapCellAnswer::Kind::undecided),
                      sampled ? fmt::format(", {} centres", cells_of(map, MapCellAnswer::Kind::centre)) : "",
                      map.complete ? "" : fmt::format(", {} pending", cells_of(map, MapCellAnswer::Kind::pending)),
                      map.processed);
  if (!sampled) {
    const auto pieces = std::ranges::count_if(map.boundary, [](const auto& b) { return b.proven; });
    text += fmt::format("  {:<22}{} boxes, {} of them hold a proven piece of the curve{}\n", "where solutions meet",
                        map.boundary.size(), pieces, map.boundary_known ? "" : "; there may be more");
  }
  if (const auto& points = map.critical) {
    const std::string locus = points->forward ? "forward " : "inverse ";
    text += points_line((locus + "cusps").c_str(), points->cusps, points->cusps_known);
    text += points_line((locus + "nodes").c_str(), points->nodes, points->nodes_known);
    if (!points->aspects.empty()) text += fmt::format("  {:<22}{}\n", "in all of C-space", points->aspects);
  }
  return text + stopped_line(map.stopped);
}

std::string to_csv(const ParameterMap& map) {
  const bool with_standing = !map.require.empty();
  std::string text = fmt::format("{0}_lo,{0}_hi,{1}_lo,{1}_hi,kind,count,at_centre{2}\n", map.names[0], map.names[1],
                                 with_standing ? ",standing" : "");
  const auto known = [](const std::optional<int>& n) { return n ? std::to_string(*n) : ""; };
  for (const MapCellAnswer& c : map.cells)
    text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{},{},{}{}\n", c.sides[0].lo(), c.sides[0].hi(), c.sides[1].lo(),
                        c.sides[1].hi(), to_string(c.kind), known(c.count), known(c.at_centre),
                        with_standing ? std::string(",") + (c.standing ? to_string(*c.standing) : "") : "");
  return text;
}

std::string to_json(const ParameterMap& map) {
  Json json = {{"model", map.model}, {"set", map.set}, {"count", to_string(map.answer)}};
  for (std::size_t k = 0; k < 2; ++k) json["over"][map.names[k]] = {map.region[k].lo(), map.region[k].hi()};
  json["fixed"] = Json::object();
  for (const auto& [name, value] : map.fixed) json["fixed"][name] = value;
  if (!map.require.empty()) {
    json["require"] = map.require;
    for (const Standing s : {Standing::satisfied, Standing::violated, Standing::open})
      json["standings"][to_string(s)] = map.share_where(s);
  }
  json["tolerances"] = Json::object();
  for (const auto& [name, range] : map.tolerances) json["tolerances"][name] = {range.lo(), range.hi()};
  json["resolution"] = map.resolution;
  json["complete"] = map.complete;
  json["stopped"] = or_null(map.stopped);
  json["shares"] = Json::object();
  for (const auto& [n, share] : map.shares()) json["shares"][std::to_string(n)] = share;
  json["proven_share"] = map.proven_share();
  json["cells"] = rows(map.cells);
  json["boundary"] = rows(map.boundary);
  json["boundary_known"] = map.boundary_known;
  json["cusps"] = map.critical ? rows(map.critical->cusps) : Json();
  json["nodes"] = map.critical ? rows(map.critical->nodes) : Json();
  json["cusps_known"] = map.critical && map.critical->cusps_known;
  json["nodes_known"] = map.critical && map.critical->nodes_known;
  json["aspects"] = map.critical && !map.critical->aspects.empty() ? Json(map.critical->aspects) : Json();
  json["processed"] = map.processed;
  json["seconds"] = map.seconds;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_json(const MapTile& tile) {
  return Json{{"number", tile.number},
              {"cells", rows(tile.cells)},
              {"boundary", rows(tile.boundary)},
              {"boundary_known", tile.boundary_known},
              {"processed", tile.processed}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

MapTile tile_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    MapTile tile;
    tile.number = json.at("number").get<int>();
    if (tile.number < 0 || tile.number >= ParameterMapper::tiles()) throw std::invalid_argument("no such tile");
    for (const Json& c : json.at("cells"))
      tile.cells.push_back(
          {sides_of(c), kind_from(c.at(4).get<std::string>()), count_of(c.at(5)), count_of(c.at(6)), standing_of(c)});
    for (const Json& b : json.at("boundary")) tile.boundary.push_back({sides_of(b), b.at(4).get<bool>()});
    tile.boundary_known = json.at("boundary_known").get<bool>();
    tile.processed = json.at("processed").get<std::uint64_t>();
    return tile;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(std::string("no tile of a map: ") + error.what());
  }
}

}  // namespace corank::analyze
