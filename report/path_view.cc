#include "corank/report/path_view.h"

#include <stdexcept>

#include "corank/report/page_data.h"
#include "corank/report/template_data.h"

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;

// For each variable of the page its place in the view's system.
std::vector<std::size_t> places_of(const System& system, const std::vector<std::string>& order) {
  std::vector<std::size_t> places;
  for (const std::string& name : order) {
    const int j = system.find(name);
    if (j < 0) throw std::invalid_argument("the path has no variable " + name);
    places.push_back(j);
  }
  return places;
}

Json middle(const Box& box, const std::vector<std::size_t>& places) {
  return each(places, [&](std::size_t j) { return box[j].mid(); });
}

Json node(const TubeNode& node, const std::vector<std::size_t>& places) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < node.values.size(); ++i)
    rows.push_back(each(places, [&](std::size_t j) { return node.rows[i * node.box.size() + j]; }));
  return {{"x", middle(node.box, places)}, {"rows", rows}, {"values", node.values}};
}

Json piece(const Box& box, double radius, const std::vector<std::size_t>& places) {
  return {{"lower", each(places, [&](std::size_t j) { return box[j].lo(); })},
          {"upper", each(places, [&](std::size_t j) { return box[j].hi(); })},
          {"radius", radius}};
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
  const Tube tube = view.path.tube.value_or(Tube{});
  Json pieces = Json::array();
  for (std::size_t k = 0; k < tube.pieces.size(); ++k) pieces.push_back(piece(tube.pieces[k], tube.radii[k], places));
  const Json json = {{"status", to_string(view.path.status)},
                     {"avoided", view.avoid == analyze::Avoid::both ? "forward or inverse" : to_string(view.avoid)},
                     {"ends", {middle(view.path.from, places), middle(view.path.to, places)}},
                     {"nodes", each(tube.nodes, [&](const TubeNode& n) { return node(n, places); })},
                     {"pieces", pieces}};
  return script_safe(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace corank::report
