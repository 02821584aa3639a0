#include "corank/report/html/path_page.h"

#include <fmt/format.h>

#include <stdexcept>

#include "corank/report/html/page_assets.h"
#include "corank/report/html/page_data.h"
#include "corank/report/html/page_words.h"
#include "corank/report/html/template_data.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::report {
namespace {

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

/// The variables that the page's coordinates and constraints speak of.
std::vector<std::string> variables_of_page(const symbolic::Mechanism& mechanism) {
  const System cspace = algebrize(singularity_system(mechanism, symbolic::SingularitySet::cspace));
  std::vector<std::string> names;
  for (const Variable& v : cspace.variables) names.push_back(v.name);
  return names;
}

void put_facts(TemplateData& page, const symbolic::Mechanism& mechanism, const PathView& view) {
  page["from"] = values_html(view, view.ends[0], mechanism);
  page["to"] = values_html(view, view.ends[1], mechanism);
  const analyze::Path& path = view.path;
  page["isPath"] = path.tube.has_value();
  if (path.tube) {
    page["nodes"] = grouped(path.tube->nodes.size());
    page["found"] = path.method == "direct"  ? "straight"
                    : path.method == "graph" ? "on a graph of boxes"
                                             : "by " + path.method;
    page["length"] = fmt::format("{:.4g}", path.length);
    page["radius"] = fmt::format("{:.3g}", path.tube->radius());
  }
  page["seconds"] = fmt::format("{:.2f}", path.seconds);
  page["resolution"] = if_any(path.resolution > 0 ? fmt::format("{:g}", path.resolution) : "");
}

}  // namespace

PathView path_view(const analyze::PathFinder& finder, const analyze::Path& path) {
  PathView view{.avoid = finder.options().avoid,
                .path = path,
                .radius_asked = finder.options().radius,
                .cuspidal = false,
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

PathView cuspidal_view(const analyze::Cuspidality& robot) {
  PathView view = path_view(*robot.finder, *robot.path);
  view.cuspidal = true;
  return view;
}

std::string path_json(const PathView& view, const std::vector<std::string>& order) {
  const std::vector<std::size_t> places = places_of(view.system, order);
  const Tube tube = view.path.tube.value_or(Tube{});
  Json pieces = Json::array();
  for (std::size_t k = 0; k < tube.pieces.size(); ++k) pieces.push_back(piece(tube.pieces[k], tube.radii[k], places));
  const Json json = {{"status", to_string(view.path.status)},
                     {"avoided", in_words(view.avoid)},
                     {"ends", {middle(view.path.from, places), middle(view.path.to, places)}},
                     {"nodes", each(tube.nodes, [&](const TubeNode& n) { return node(n, places); })},
                     {"pieces", pieces}};
  return script_safe(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string path_page(const symbolic::Mechanism& mechanism, const PathView& view, const std::vector<SetView>& sets,
                      const PathPageOptions& options) {
  TemplateData page = page_of(mechanism), legend = empty_list(), payloads = empty_list();
  for (const SetView& set : sets) {
    legend << entry_of(set);
    payloads << payload(set, set.result.set);
  }
  page["sets"] = std::move(legend);
  page["payloads"] = std::move(payloads);
  page["missing"] = if_any(fmt::format("{}", fmt::join(options.missing, ", ")));
  page["pathStyle"] = std::string(kPathStyle);
  page["three"] = std::string(kThree);
  page["script"] = std::string(kPathScript);
  page["data"] = page_model(mechanism, derive(mechanism), sets);
  page["path"] = path_json(view, variables_of_page(mechanism));
  const PathWords words = path_words(mechanism, view);
  page["kicker"] = words.kicker;
  page["finding"] = words.finding;
  add_findings(words, page);
  page["status"] = to_string(view.path.status);
  put_facts(page, mechanism, view);
  page["signs"] = if_any(signs_html(view));
  page["avoided"] = in_words(view.avoid);
  page["waypoints"] = waypoints_html(view, mechanism);
  page["command"] = options.command;
  page["file"] = if_any(options.file);
  page["inSpace"] = mechanism.drawing().dimension() == 3;
  return filled(kPathTemplate, page);
}

}  // namespace corank::report
