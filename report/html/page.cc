#include "corank/report/html/page.h"

#include <fmt/format.h>

#include "corank/report/html/page_assets.h"
#include "corank/report/html/page_data.h"
#include "corank/report/html/page_words.h"
#include "corank/report/html/template_data.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::report {
namespace {

TemplateData run_row(const SetView& view, const std::string& file) {
  const result::Result& result = view.result;
  TemplateData row = run_of(view, file);
  row["kernel"] = result.options.kernel.empty() ? "–" : result.options.kernel;
  row["variables"] = std::to_string(result.variables.size());
  row["equations"] = std::to_string(result.equations);
  row["threads"] = result.options.threads == 0 ? "all" : std::to_string(result.options.threads);
  row["version"] = result.version;
  return row;
}

/// Coordinates with a range of one value: "φ = π/10".
std::string fixed_html(const symbolic::Mechanism& mechanism) {
  std::vector<symbolic::Coordinate> fixed = mechanism.coordinates();
  std::erase_if(fixed, [](const symbolic::Coordinate& c) { return !is_fixed(c); });
  return result::joined(fixed, [](const symbolic::Coordinate& c) { return constant_html({c.name, c.lower, {}}); });
}

/// And "tied by 1 equation" where equations speak of them alone.
std::string chosen_and_tied_html(const symbolic::Mechanism& mechanism, const symbolic::VelocityEquation& velocity,
                                 symbolic::Role role) {
  const std::size_t dependencies = velocity.dependencies(std::span(&role, 1)).size();
  const std::string names = chosen_html(mechanism, role);
  return dependencies == 0 ? names
                           : fmt::format("{} <small>tied by {}</small>", names, result::counted(dependencies, "equation"));
}

/// Ranges that the model leaves out: "<i>x</i> in [−0.41, 1.76]".
std::string found_html(const result::Result& result) {
  return result::joined(result.domain.found, [&](int j) {
    const result::ResultVariable& v = result.variables[j];
    return fmt::format("{} in {}", symbolic::html_name(v.name),
                       with_minus(fmt::format("[{:.6g}, {:.6g}]", v.domain.lo(), v.domain.hi())));
  });
}

/// The constants that were given with -D.
std::string overridden_html(const result::Result& result) {
  return result::joined(result.options.constants, [](const result::ConstantOverride& c) {
    return constant_html(symbolic::parse_constant(c.name, c.expression, "-D " + c.name));
  });
}

}  // namespace

std::string report_page(const symbolic::Mechanism& mechanism, const std::vector<SetView>& views,
                        const PageOptions& options) {
  if (mechanism.is_plain_system())
    throw symbolic::ModelError({mechanism.name(), 0, 0}, "the model names no inputs and outputs",
                               "a mechanism, with [INPUTS] and [OUTPUTS]");
  const symbolic::Derivation derivation = derive(mechanism);
  TemplateData cards = empty_list(), runs = empty_list(), payloads = empty_list();
  bool complete = true;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SetView& view = views[i];
    TemplateData entry = entry_of(view);
    entry["card"] = card_html(view);
    cards << entry;
    runs << run_row(view, i < options.files.size() ? options.files[i] : "");
    payloads << payload(view, view.result.set);
    complete = complete && view.result.cover.complete();
  }
  TemplateData page = page_of(mechanism);
  page["script"] = std::string(kPageScript);
  page["three"] = std::string(kThree);
  page["data"] = page_model(mechanism, derivation, views);
  page["inputs"] = chosen_and_tied_html(mechanism, derivation.velocity, symbolic::Role::input);
  page["outputs"] = chosen_and_tied_html(mechanism, derivation.velocity, symbolic::Role::output);
  page["coordinates"] = std::to_string(mechanism.coordinates().size());
  page["constraints"] = std::to_string(derivation.phi.size());
  page["mobility"] = std::to_string(mechanism.coordinates().size() - derivation.phi.size());
  page["constants"] = constants_html(mechanism);
  page["required"] = if_any(result::joined(
      mechanism.requirement_texts(), [](const std::string& text) { return symbolic::html_text(text); }, "<br>"));
  page["found"] = if_any(views.empty() ? "" : found_html(views.front().result));
  page["overridden"] = if_any(views.empty() ? "" : overridden_html(views.front().result));
  page["cut"] = if_any(fixed_html(mechanism));
  page["inSpace"] = mechanism.drawing().dimension() == 3;
  page["sets"] = std::move(cards);
  page["points"] = points_html(views);
  page["derivation"] = derivation_html(mechanism, derivation, views);
  page["runs"] = std::move(runs);
  page["payloads"] = std::move(payloads);
  page["command"] = options.command;
  page["incomplete"] = !complete;
  page["hasAspects"] = options.aspects.has_value();
  const PageAspects aspects = options.aspects.value_or(PageAspects{});
  page["aspects"] = aspects.summary;
  page["aspectsPicture"] = aspects.picture;
  const std::string aspects_data = aspects_json(aspects);
  page["hasAspectColours"] = aspects_data != "null";
  page["aspectsData"] = aspects_data;
  page["passages"] = std::ranges::any_of(views, [](const SetView& v) { return !v.result.outputs.empty(); });
  page["figures"] = list_of("figure", options.figures);
  page["partsOfSheets"] = std::ranges::any_of(views, [](const SetView& v) { return result::parts_of_sheets(v.result) > 0; });
  page["hasFigures"] = !options.figures.empty();
  page["hasFiles"] = !options.files.empty();
  return filled(kPageTemplate, page);
}

std::string page_summary(const std::string& model, const std::string& page, const PageOptions& options,
                         const std::vector<SetView>& views, bool complete) {
  const Json sets = summaries(views, options.files);
  return Json{{"model", model}, {"page", page}, {"figures", options.figures}, {"complete", complete}, {"sets", sets}}.dump(
      2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::report
