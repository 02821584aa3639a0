#include "corank/analyze/clearance/clearance_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "corank/analyze/clearance/json.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

const char* word(MapCell::Robot robot) {
  constexpr std::array kWords{"assembled", "not in the middle", "nowhere"};
  return kWords.at(static_cast<std::size_t>(robot));
}

void examine(CenterField& field, const MapOptions& options, ClearanceMap& map, MapCell& cell) {
  if (field.configurations(Box(cell.middle.begin(), cell.middle.end())).proven) {
    cell.robot = MapCell::Robot::assembled;
  } else if (field.configurations(cell.sides).excluded) {
    cell.robot = MapCell::Robot::nowhere;
    return;
  }
  const Nearest n = field.distance(cell.middle, {.precision = options.precision});
  map.processed += n.statistics.processed;
  map.empty = map.empty || n.empty;
  if (n.empty) return;
  const UpwardRounding rounding;
  const double h = reach(cell.sides, cell.middle);
  cell.lower = n.lower, cell.upper = n.upper;
  cell.cell_lower = std::max(0.0, -(h - n.lower));
  if (n.upper) cell.cell_upper = *n.upper + h;
}

}  // namespace

const MapCell* ClearanceMap::best() const {
  const MapCell* best = nullptr;
  for (const MapCell& cell : cells)
    if (cell.robot == MapCell::Robot::assembled && (!best || cell.lower > best->lower)) best = &cell;
  return empty ? nullptr : best;
}

ClearanceMap clearance_map(const study::Question& question, const BallOptions& ball, const std::vector<NamedRange>& region,
                           const MapOptions& options, const solve::Options& search, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  if (region.size() != 2) throw question_error(question, "a map has two coordinates", "as in --map x,y");
  const Box sides = bounded_region(question, region);
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (!(sides[k].lo() < sides[k].hi()))
      throw question_error(question, "the map's region has one value of '" + region[k].name + "' only",
                           "a lower end below the upper one, as in --map x=[0,1],y=[0,1]; --at for one centre");
  CenterField field(question, ball, region, search, control);
  ClearanceMap map;
  map.ball = field.ball(), map.names = field.names(), map.region = field.region();
  map.grid = options.grid, map.precision = options.precision;
  const std::size_t all = std::size_t{1} * options.grid * options.grid;
  for (int row = 0; row < options.grid && !map.empty; ++row)
    for (int column = 0; column < options.grid && !map.empty && !control.search_ended(); ++column) {
      MapCell cell;
      cell.sides = {part_of(map.region[0], column, options.grid), part_of(map.region[1], row, options.grid)};
      cell.middle = {cell.sides[0].mid(), cell.sides[1].mid()};
      examine(field, options, map, cell);
      map.cells.push_back(std::move(cell));
      if (options.progress) options.progress(map.cells.size(), all);
    }
  map.complete = map.empty || (map.cells.size() == all && !control.search_ended());
  if (!map.complete) map.stopped = solve::stopped_by(control);
  map.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return map;
}

std::string to_csv(const ClearanceMap& map) {
  const auto known = [](std::optional<double> x) { return x ? fmt::format("{:.17g}", *x) : ""; };
  std::string text = fmt::format("{},{},robot,lo,hi,cell_lo,cell_hi\n", map.names[0], map.names[1]);
  for (const MapCell& c : map.cells) {
    text += fmt::format("{:.17g},{:.17g},{},", c.middle[0], c.middle[1], word(c.robot));
    text += c.robot == MapCell::Robot::nowhere
                ? ",,,\n"
                : fmt::format("{:.17g},{},{:.17g},{}\n", c.lower, known(c.upper), c.cell_lower, known(c.cell_upper));
  }
  return text;
}

std::string to_json(const ClearanceMap& map) {
  const auto row = [&](const MapCell& c) {
    Json json = {{map.names[0], c.middle[0]}, {map.names[1], c.middle[1]}, {"robot", word(c.robot)}};
    const bool nowhere = c.robot == MapCell::Robot::nowhere;
    json["lo"] = nowhere ? Json() : Json(c.lower);
    json["hi"] = or_null(c.upper);
    json["cell_lo"] = nowhere ? Json() : Json(c.cell_lower);
    json["cell_hi"] = or_null(c.cell_upper);
    return json;
  };
  Json json = {{"model", map.ball.question.model.name()}, {"set", map.ball.set_name()}, {"in", map.ball.names()}};
  for (std::size_t k = 0; k < 2; ++k) json["region"][map.names[k]] = {map.region[k].lo(), map.region[k].hi()};
  json["grid"] = map.grid;
  json["empty"] = map.empty;
  json["complete"] = map.complete;
  json["stopped"] = or_null(map.stopped);
  json["precision"] = map.precision;
  json["best"] = map.best() ? row(*map.best()) : Json(nullptr);
  json["cells"] = Json::array();
  if (!map.empty)
    for (const MapCell& c : map.cells) json["cells"].push_back(row(c));
  json["processed"] = map.processed;
  json["seconds"] = map.seconds;
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
