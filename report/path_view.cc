#include "corank/report/path_view.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "corank/report/page_data.h"

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;

// For each variable of the page its place in the view's system.
std::vector<std::size_t> places_of(const System& system, const std::vector<std::string>& order) {
  std::vector<std::size_t> places;
  for (const std::string& name : order) {
    const int j = system.find(name);
    if (j < 0) throw std::invalid_argument("the path has no variable " + name);
    places.push_back(static_cast<std::size_t>(j));
  }
  return places;
}

Json middle(const Box& box, const std::vector<std::size_t>& places) {
  Json json = Json::array();
  for (const std::size_t j : places) json.push_back(box[j].mid());
  return json;
}

Json node(const TubeNode& node, const std::vector<std::size_t>& places) {
  Json rows = Json::array();
  const std::size_t n = node.box.size();
  for (std::size_t i = 0; i < node.values.size(); ++i) {
    Json row = Json::array();
    for (const std::size_t j : places) row.push_back(node.rows[i * n + j]);
    rows.push_back(std::move(row));
  }
  return {{"x", middle(node.box, places)}, {"rows", rows}, {"values", node.values}};
}

Json piece(const Box& box, double radius, const std::vector<std::size_t>& places) {
  Json lower = Json::array(), upper = Json::array();
  for (const std::size_t j : places) {
    lower.push_back(box[j].lo());
    upper.push_back(box[j].hi());
  }
  return {{"lower", lower}, {"upper", upper}, {"radius", radius}};
}

}  // namespace

PathView path_view(const analyze::PathFinder& finder, const analyze::Path& path) {
  PathView view{.avoid = finder.options().avoid,
                .path = path,
                .radius_asked = finder.options().radius,
                .system = finder.system(),
                .signs = {finder.signs(path.from), finder.signs(path.to)},
                .names = {},
                .ends = {},
                .nodes = {}};
  for (const std::size_t end : {0u, 1u}) {
    view.names.clear();
    for (const analyze::CoordinateValue& v : analyze::coordinate_values(view.system, end == 0 ? path.from : path.to)) {
      view.names.push_back(v.name);
      view.ends[end].push_back(v.value.mid());
    }
  }
  std::vector<std::string> names;
  if (path.tube) view.nodes = analyze::node_values(view.system, *path.tube, names);
  return view;
}

std::string path_json(const PathView& view, const std::vector<std::string>& order) {
  const std::vector<std::size_t> places = places_of(view.system, order);
  Json json = {{"status", to_string(view.path.status)},
               {"avoided", view.avoid == analyze::Avoid::both ? "forward or inverse" : to_string(view.avoid)},
               {"ends", {middle(view.path.from, places), middle(view.path.to, places)}},
               {"nodes", Json::array()},
               {"pieces", Json::array()}};
  if (view.path.tube) {
    const Tube& tube = *view.path.tube;
    for (const TubeNode& n : tube.nodes) json["nodes"].push_back(node(n, places));
    for (std::size_t k = 0; k < tube.pieces.size(); ++k)
      json["pieces"].push_back(piece(tube.pieces[k], tube.radii[k], places));
  }
  return script_safe(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace corank::report
