#include "corank/report/path_page.h"

#include <fmt/format.h>

#include "corank/report/page_assets.h"
#include "corank/report/page_data.h"
#include "corank/report/page_words.h"
#include "corank/report/template_data.h"
#include "corank/result/verification.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::report {
namespace {

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
  page["waypoints"] = waypoints_html(view, mechanism);
  page["command"] = options.command;
  page["file"] = if_any(options.file);
  page["inSpace"] = mechanism.drawing().dimension() == 3;
  return filled(kPathTemplate, page);
}

}  // namespace corank::report
