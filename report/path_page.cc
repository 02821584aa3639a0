#include "corank/report/path_page.h"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "corank/report/page_assets.h"
#include "corank/report/page_data.h"
#include "corank/report/page_words.h"
#include "corank/report/path_words.h"
#include "corank/report/template_data.h"
#include "corank/result/verification.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::report {
namespace {

namespace mustache = kainjow::mustache;

/// The variables that the page's coordinates and constraints speak of.
std::vector<std::string> variables_of_page(const symbolic::Mechanism& mechanism) {
  const System cspace = algebrize(singularity_system(mechanism, symbolic::SingularitySet::cspace));
  std::vector<std::string> names;
  for (const Variable& v : cspace.variables) names.push_back(v.name);
  return names;
}

std::vector<std::string> own_coordinates(const symbolic::Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const symbolic::Coordinate& c : mechanism.coordinates())
    if (!c.auxiliary) names.push_back(c.name);
  return names;
}

void put_facts(mustache::data& page, const symbolic::Mechanism& mechanism, const PathView& view) {
  const std::vector<std::string> shown = own_coordinates(mechanism);
  page["from"] = values_html(view, view.ends[0], shown);
  page["to"] = values_html(view, view.ends[1], shown);
  const analyze::Path& path = view.path;
  page.set("isPath", truth(path.tube.has_value()));
  if (path.tube) {
    page["pieces"] = grouped(path.tube->pieces.size());
    page["nodes"] = grouped(path.tube->nodes.size());
    page["found"] = path.method == "direct"  ? "straight"
                    : path.method == "graph" ? "on a graph of boxes"
                                             : "by " + path.method;
    page["length"] = fmt::format("{:.4g}", path.length);
    page["radius"] = fmt::format("{:.3g}", path.tube->radius());
  }
  page["seconds"] = fmt::format("{:.2f}", path.seconds);
  page["resolution"] = fmt::format("{:g}", path.resolution);
  page.set("hasResolution", truth(path.resolution > 0));
}

void put_sets(mustache::data& page, const std::vector<SetView>& sets, const PathPageOptions& options) {
  mustache::data legend{mustache::data::type::list}, payloads{mustache::data::type::list};
  for (const SetView& set : sets) {
    mustache::data entry, payload;
    entry["name"] = set.set->name;
    entry["title"] = set.words.title;
    legend << entry;
    payload["name"] = set.result.set;
    payload["boxes"] = box_payload(set.result);
    payload["verdicts"] = verdict_payload(set.result);
    payloads << payload;
  }
  page.set("sets", legend);
  page.set("payloads", payloads);
  page["missing"] = fmt::format("{}", fmt::join(options.missing, ", "));
  page.set("hasMissing", truth(!options.missing.empty()));
}

}  // namespace

std::string path_page(const symbolic::Mechanism& mechanism, const PathView& view, const std::vector<SetView>& sets,
                      const PathPageOptions& options) {
  const PathWords words = path_words(mechanism, view);
  mustache::data page;
  page["model"] = mechanism.name();
  page["version"] = result::version();
  page["style"] = std::string(kPageStyle) + set_style() + std::string(kPathStyle);
  page["three"] = std::string(kThree);
  page["script"] = std::string(kPathScript);
  page["data"] = page_model(mechanism, derive(mechanism), sets);
  page["path"] = path_json(view, variables_of_page(mechanism));
  page["kicker"] = words.kicker;
  page["finding"] = words.finding;
  page["status"] = to_string(view.path.status);
  page.set("proven", sentences(words.proven));
  page.set("hasProven", truth(!words.proven.empty()));
  page.set("unproven", sentences(words.unproven));
  page.set("hasUnproven", truth(!words.unproven.empty()));
  put_facts(page, mechanism, view);
  put_sets(page, sets, options);
  const std::string signs = signs_html(view);
  page["signs"] = signs;
  page.set("hasSigns", truth(!signs.empty()));
  page["waypoints"] = waypoints_html(view, mechanism);
  page["command"] = options.command;
  page["file"] = options.file;
  page.set("hasFile", truth(!options.file.empty()));
  page["modelText"] = mechanism.source_text();
  page.set("inSpace", truth(mechanism.drawing().dimension() == 3));

  mustache::mustache pattern{std::string(kPathTemplate)};
  if (!pattern.is_valid()) throw std::logic_error("the path page's template: " + pattern.error_message());
  return pattern.render(page);
}

}  // namespace corank::report
