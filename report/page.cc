#include "corank/report/page.h"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "corank/report/drawn_boxes.h"
#include "corank/report/page_assets.h"
#include "corank/report/page_card.h"
#include "corank/report/page_data.h"
#include "corank/report/page_derivation.h"
#include "corank/report/page_points.h"
#include "corank/report/page_words.h"
#include "corank/report/template_data.h"
#include "corank/symbolic/display_name.h"
#include "corank/symbolic/model_file.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::report {
namespace {

namespace mustache = kainjow::mustache;

mustache::data set_entry(const SetView& view) {
  mustache::data entry;
  entry["name"] = view.set->name;
  entry["title"] = view.words.title;
  entry["card"] = card_html(view);
  return entry;
}

mustache::data run_row(const SetView& view, const std::string& file) {
  const result::Result& result = view.result;
  const Statistics& s = result.cover.statistics;
  mustache::data row;
  row["title"] = view.words.title;
  row["sigma"] = fmt::format("{:g}", result.cover.sigma.largest());
  row["kernel"] = result.options.kernel.empty() ? "–" : result.options.kernel;
  row["variables"] = std::to_string(result.variables.size());
  row["equations"] = std::to_string(result.equations);
  row["boxes"] = grouped(result.cover.boxes.size());
  row["processed"] = grouped(s.processed);
  row["seconds"] = fmt::format("{:.2f}", s.seconds_total);
  row["threads"] = result.options.threads == 0 ? "all" : std::to_string(result.options.threads);
  row["version"] = result.version;
  row["file"] = file;
  return row;
}

mustache::data payload(const result::Result& result) {
  mustache::data data;
  data["name"] = result.set;
  data["boxes"] = box_payload(result);
  data["verdicts"] = verdict_payload(result);
  return data;
}

/// With hulls in place of the boxes where these are too many to be drawn; nothing where they are not.
std::vector<SetView> drawn_views(const std::vector<SetView>& views) {
  std::vector<SetView> list;
  if (std::none_of(views.begin(), views.end(), [](const SetView& v) { return boxes_in_one(v.result) > 1; })) return list;
  for (const SetView& view : views) {
    const std::size_t in_one = boxes_in_one(view.result);
    list.push_back({in_one > 1 ? drawn(view.result, in_one) : view.result, view.set, view.system, {}, view.words});
  }
  return list;
}

/// Coordinates with a range of one value: "φ = π/10".
std::string fixed_html(const symbolic::Mechanism& mechanism) {
  std::string html;
  for (const symbolic::Coordinate& c : mechanism.coordinates()) {
    if (!is_fixed(c)) continue;
    html += (html.empty() ? "" : ", ") + constant_html(c.name, c.lower);
  }
  return html;
}

/// And "tied by 1 equation" where equations speak of them alone.
std::string chosen_and_tied_html(const symbolic::Mechanism& mechanism, const symbolic::VelocityEquation& velocity,
                                 symbolic::Role role) {
  const std::size_t ties = velocity.ties(std::span(&role, 1)).size();
  const std::string names = chosen_html(mechanism, role);
  return ties == 0 ? names : fmt::format("{} <small>tied by {} equation{}</small>", names, ties, ties == 1 ? "" : "s");
}

/// Ranges that the model leaves out: "<i>x</i> in [−0.41, 1.76]".
std::string found_html(const std::vector<SetView>& views) {
  std::string html;
  if (views.empty()) return html;
  const result::Result& first = views.front().result;
  for (const int j : first.domain.found) {
    const result::ResultVariable& v = first.variables[static_cast<std::size_t>(j)];
    html += fmt::format("{}{} in {}", html.empty() ? "" : ", ", symbolic::html_name(v.name),
                        with_minus(fmt::format("[{:.6g}, {:.6g}]", v.domain.lo(), v.domain.hi())));
  }
  return html;
}

/// The constants that were given with -D.
std::string overridden_html(const std::vector<SetView>& views) {
  std::string html;
  if (views.empty()) return html;
  for (const result::ConstantOverride& c : views.front().result.options.constants)
    html += (html.empty() ? "" : ", ") + constant_html(c.name, symbolic::parse_expression(c.expression, "-D " + c.name));
  return html;
}

}  // namespace

std::string report_page(const symbolic::Mechanism& mechanism, const std::vector<SetView>& views,
                        const PageOptions& options) {
  if (mechanism.is_plain_system()) {
    throw symbolic::ModelError({mechanism.name(), 0, 0}, "the model names no inputs and outputs",
                               "a mechanism, with [INPUTS] and [OUTPUTS]");
  }
  const symbolic::Derivation derivation = derive(mechanism);
  mustache::data cards{mustache::data::type::list}, runs{mustache::data::type::list}, payloads{mustache::data::type::list};
  bool complete = true;
  const std::vector<SetView> fewer = drawn_views(views);
  const std::vector<SetView>& pictured = fewer.empty() ? views : fewer;
  for (std::size_t i = 0; i < views.size(); ++i) {
    cards << set_entry(views[i]);
    runs << run_row(views[i], i < options.files.size() ? options.files[i] : "");
    payloads << payload(pictured[i].result);
    complete = complete && views[i].result.cover.complete();
  }
  mustache::data page;
  page["model"] = mechanism.name();
  page["style"] = std::string(kPageStyle) + set_style();
  page["script"] = std::string(kPageScript);
  page["three"] = std::string(kThree);
  page["data"] = page_model(mechanism, derivation, pictured);
  page["inputs"] = chosen_and_tied_html(mechanism, derivation.velocity, symbolic::Role::input);
  page["outputs"] = chosen_and_tied_html(mechanism, derivation.velocity, symbolic::Role::output);
  const std::string found = found_html(views);
  page["found"] = found;
  page.set("hasFound", truth(!found.empty()));
  page["coordinates"] = std::to_string(mechanism.coordinates().size());
  page["constraints"] = std::to_string(derivation.phi.size());
  page["mobility"] = std::to_string(mechanism.coordinates().size() - derivation.phi.size());
  page["constants"] = constants_html(mechanism);
  const std::string changed = overridden_html(views);
  page["overridden"] = changed;
  page.set("hasOverrides", truth(!changed.empty()));
  const std::string cut = fixed_html(mechanism);
  page["cut"] = cut;
  page.set("hasCut", truth(!cut.empty()));
  page["unit"] = mechanism.drawing().unit;
  page.set("hasUnit", truth(!mechanism.drawing().unit.empty()));
  page.set("inSpace", truth(mechanism.drawing().dimension() == 3));
  page.set("sets", cards);
  page["points"] = points_html(views);
  page["derivation"] = derivation_html(mechanism, derivation, views);
  page.set("runs", runs);
  page.set("payloads", payloads);
  page["command"] = options.command;
  page["version"] = result::version();
  page["modelText"] = mechanism.source_text();
  page.set("incomplete", truth(!complete));
  page.set("hasAspects", truth(options.aspects.has_value()));
  page["aspects"] = options.aspects ? options.aspects->summary : "";
  page["aspectsPicture"] = options.aspects ? options.aspects->picture : "";
  const std::string aspects_data = options.aspects ? aspects_json(*options.aspects) : "null";
  page["aspectsData"] = aspects_data;
  page.set("hasAspectColours", truth(aspects_data != "null"));
  page.set("passages",
           truth(std::any_of(views.begin(), views.end(), [](const SetView& view) { return !view.result.outputs.empty(); })));
  mustache::data figures{mustache::data::type::list};
  for (const std::string& figure : options.figures) figures << mustache::data{"figure", figure};
  page.set("figures", figures);
  page.set("hasFigures", truth(!options.figures.empty()));
  page.set("hasFiles", truth(!options.files.empty()));

  mustache::mustache pattern{std::string(kPageTemplate)};
  if (!pattern.is_valid()) throw std::logic_error("the page's template: " + pattern.error_message());
  return pattern.render(page);
}

}  // namespace corank::report
