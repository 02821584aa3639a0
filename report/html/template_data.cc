#include "corank/report/html/template_data.h"

#include <fmt/format.h>

#include <stdexcept>

#include "corank/report/html/page_assets.h"
#include "corank/report/html/page_data.h"
#include "corank/report/html/page_words.h"
#include "corank/report/pictures/box_payload.h"
#include "corank/result/values/summary.h"

namespace corank::report {

TemplateData list_of(const std::string& key, const std::vector<std::string>& items) {
  TemplateData list = empty_list();
  for (const std::string& item : items) list << TemplateData{key, item};
  return list;
}

void add_findings(const Findings& findings, TemplateData& data) {
  data["proven"] = list_of("sentence", findings.proven);
  data["hasProven"] = !findings.proven.empty();
  data["unproven"] = list_of("sentence", findings.unproven);
  data["hasUnproven"] = !findings.unproven.empty();
}

TemplateData page_of(const symbolic::Mechanism& mechanism) {
  TemplateData page;
  page["model"] = mechanism.name();
  page["modelText"] = mechanism.source_text();
  page["version"] = result::version();
  page["unit"] = if_any(mechanism.drawing().unit);
  page["style"] = std::string(kPageStyle) + set_style();
  return page;
}

TemplateData entry_of(const SetView& view) {
  TemplateData entry{"name", std::string(view.set->name)};
  entry["title"] = view.words.title;
  return entry;
}

TemplateData run_of(const SetView& view, const std::string& file) {
  const Cover& cover = view.result.cover;
  TemplateData row{"title", view.words.title};
  row["sigma"] = fmt::format("{:g}", cover.sigma.largest());
  row["boxes"] = grouped(cover.boxes.size());
  row["processed"] = grouped(cover.statistics.processed);
  row["seconds"] = fmt::format("{:.2f}", cover.statistics.seconds_total);
  row["file"] = file;
  row["inFile"] = grouped(view.in_file());
  return row;
}

TemplateData payload(const SetView& view, const std::string& id, std::span<const int> variables) {
  TemplateData data{"id", id};
  data["boxes"] = variables.empty() ? box_payload(view.drawn()) : box_payload(view.drawn(), variables);
  data["verdicts"] = verdict_payload(view.drawn());
  return data;
}

std::string card_html(const SetView& view) {
  const SetWords& words = view.words;
  TemplateData card = entry_of(view), bar = empty_list();
  card["meaning"] = words.meaning;
  card["finding"] = words.finding;
  add_findings(words, card);
  const auto counts = view.result.cover.counts();
  for (int v = 0; v < kVerdicts; ++v) {
    const auto verdict = static_cast<Verdict>(v);
    const std::size_t count = counts[index(verdict)], all = view.result.cover.boxes.size();
    if (count == 0) continue;
    TemplateData part{"verdict", std::string(to_string(verdict))};
    part["count"] = grouped(count);
    part["percent"] = percentage(count, all);
    part["grow"] = fmt::format("{:.6f}", static_cast<double>(count) / static_cast<double>(all));
    bar << part;
  }
  card["bar"] = std::move(bar);
  return filled(kCardTemplate, card);
}

Json summaries(const std::vector<SetView>& views, const std::vector<std::string>& files) {
  Json sets = Json::array();
  for (std::size_t k = 0; k < views.size(); ++k) {
    sets.push_back(Json::parse(result::to_json(views[k].result)));
    sets.back()["file"] = files.at(k);
    sets.back()["boxes_in_file"] = views[k].in_file();
  }
  return sets;
}

std::string filled(std::string_view pattern, const TemplateData& data) {
  kainjow::mustache::mustache page{std::string(pattern)};
  if (!page.is_valid()) throw std::logic_error("a page's template: " + page.error_message());
  std::string text;
  page.render(data, [&text](const std::string& piece) { text += piece; });
  return text;
}

}  // namespace corank::report
