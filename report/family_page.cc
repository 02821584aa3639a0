#include "corank/report/family_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "corank/report/family_data.h"
#include "corank/report/family_words.h"
#include "corank/report/page_assets.h"
#include "corank/report/page_card.h"
#include "corank/report/page_data.h"
#include "corank/report/page_words.h"
#include "corank/symbolic/display_name.h"
#include "corank/symbolic/mathml.h"
#include "corank/symbolic/velocity_equation.h"

namespace corank::report {
namespace {

namespace mustache = kainjow::mustache;

mustache::data truth(bool value) {
  return mustache::data{value ? mustache::data::type::bool_true : mustache::data::type::bool_false};
}

mustache::data list() { return mustache::data{mustache::data::type::list}; }

mustache::data sentences(const std::vector<std::string>& lines) {
  mustache::data items = list();
  for (const std::string& line : lines) items << mustache::data{"sentence", line};
  return items;
}

/// The value of the constant, typeset.
std::string value_html(const FamilyMember& member, const std::string& constant, const std::string& before = "") {
  const auto& all = member.mechanism.constants();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == constant; });
  if (found == all.end()) throw std::invalid_argument(constant + " is not a constant of " + member.mechanism.name());
  return symbolic::math(before + symbolic::mathml(found->value));
}

/// The columns of one set in the table of counts: components, boxes, and the verdicts that occur in some member.
struct Columns {
  std::size_t set = 0;
  std::vector<Verdict> verdicts;
};

std::vector<Columns> columns_of(const std::vector<FamilyMember>& members) {
  std::vector<Columns> all;
  for (std::size_t s = 0; s < members.front().sets.size(); ++s) {
    all.push_back({s, {}});
    for (int v = 0; v < kVerdicts; ++v) {
      const auto verdict = static_cast<Verdict>(v);
      if (std::any_of(members.begin(), members.end(),
                      [&](const auto& m) { return m.sets[s].result.cover.count(verdict) > 0; }))
        all.back().verdicts.push_back(verdict);
    }
  }
  return all;
}

mustache::data cell(const char* key, const std::string& text, bool first) {
  mustache::data data{key, text};
  data.set("isFirst", truth(first));
  return data;
}

mustache::data heads(const std::vector<Columns>& all, const FamilyMember& member) {
  mustache::data groups = list();
  for (const Columns& columns : all) {
    mustache::data group, names = list();
    const SetView& view = member.sets[columns.set];
    group["name"] = view.set->name;
    group["title"] = view.words.title;
    group["width"] = std::to_string(columns.verdicts.size() + 2);
    names << cell("head", "components", true) << cell("head", "boxes", false);
    for (const Verdict verdict : columns.verdicts) names << cell("head", std::string(to_string(verdict)), false);
    group.set("heads", names);
    groups << group;
  }
  return groups;
}

mustache::data counts(const std::vector<Columns>& all, const FamilyMember& member) {
  mustache::data cells = list();
  for (const Columns& columns : all) {
    const SetView& view = member.sets[columns.set];
    const Cover& cover = view.result.cover;
    cells << cell("count", view.components.counted ? grouped(static_cast<std::uint64_t>(view.components.count)) : "–", true)
          << cell("count", grouped(cover.boxes.size()), false);
    for (const Verdict verdict : columns.verdicts) cells << cell("count", grouped(cover.count(verdict)), false);
  }
  return cells;
}

mustache::data run_row(const FamilyMember& member, std::size_t set, const std::string& constant) {
  const result::Result& result = member.sets[set].result;
  mustache::data row;
  row["valueHtml"] = value_html(member, constant);
  row["title"] = member.sets[set].words.title;
  row["sigma"] = fmt::format("{:g}", result.cover.sigma.largest());
  row["boxes"] = grouped(result.cover.boxes.size());
  row["processed"] = grouped(result.cover.statistics.processed);
  row["seconds"] = fmt::format("{:.2f}", result.cover.statistics.seconds_total);
  row["file"] = set < member.files.size() ? member.files[set] : "";
  return row;
}

mustache::data entry(const FamilyMember& member, std::size_t index, const std::vector<Columns>& columns,
                     const std::string& constant) {
  mustache::data data, cards = list();
  for (const SetView& view : member.sets) cards << mustache::data{"card", card_html(view)};
  data["index"] = std::to_string(index);
  data["value"] = member.value;
  data["valueHtml"] = value_html(member, constant);
  data["nameHtml"] = value_html(member, constant, symbolic::mathml_name(constant) + "<mo>=</mo>");
  data.set("isLater", truth(index > 0));
  data.set("cards", cards);
  data.set("counts", counts(columns, member));
  return data;
}

void check_sets(const std::vector<FamilyMember>& members) {
  const auto same = [](const SetView& a, const SetView& b) { return a.set == b.set; };
  for (const FamilyMember& member : members) {
    const auto& first = members.front().sets;
    if (!std::equal(first.begin(), first.end(), member.sets.begin(), member.sets.end(), same))
      throw std::invalid_argument("the members of a family have different sets");
  }
}

}  // namespace

std::string family_page(const std::vector<FamilyMember>& members, const FamilyOptions& options) {
  if (members.empty()) throw std::invalid_argument("a family has a member");
  check_sets(members);
  const FamilyMember& first = members.front();
  const symbolic::Mechanism& mechanism = first.mechanism;
  const std::vector<Columns> columns = columns_of(members);
  mustache::data entries = list(), runs = list(), payloads = list(), sets = list(), figures = list();
  bool complete = true;
  std::string values;
  for (std::size_t m = 0; m < members.size(); ++m) {
    entries << entry(members[m], m, columns, options.constant);
    values += (m > 0 ? ", " : "") + value_html(members[m], options.constant);
    for (std::size_t s = 0; s < members[m].sets.size(); ++s) {
      const result::Result& result = members[m].sets[s].result;
      mustache::data payload;
      payload["id"] = family_set_id(m, result.set);
      payload["boxes"] = box_payload(result, plane_variables(result, options.axes));
      payload["verdicts"] = verdict_payload(result);
      payloads << payload;
      runs << run_row(members[m], s, options.constant);
      complete = complete && result.cover.complete();
    }
  }
  for (const SetView& view : first.sets) {
    mustache::data set;
    set["name"] = view.set->name;
    set["title"] = view.words.title;
    sets << set;
  }
  for (const std::string& figure : options.figures) figures << mustache::data{"figure", figure};
  const FamilyWords words = family_words(members, options);

  mustache::data page;
  page["version"] = result::version();
  page["model"] = mechanism.name();
  page["constant"] = options.constant;
  page["constantName"] = symbolic::html_name(options.constant);
  page["from"] = value_html(first, options.constant);
  page["to"] = value_html(members.back(), options.constant);
  page["valuesHtml"] = values;
  page["constants"] = constants_html(mechanism, options.constant);
  page["inputs"] = chosen_html(mechanism, symbolic::Role::input);
  page["outputs"] = chosen_html(mechanism, symbolic::Role::output);
  page["unit"] = mechanism.drawing().unit;
  page.set("hasUnit", truth(!mechanism.drawing().unit.empty()));
  page.set("missing", truth(members.size() < options.asked));
  page["done"] = std::to_string(members.size());
  page["asked"] = std::to_string(options.asked);
  page.set("incomplete", truth(!complete));
  page["last"] = std::to_string(members.size() - 1);
  page.set("sets", sets);
  page.set("members", entries);
  page.set("columns", heads(columns, first));
  page.set("runs", runs);
  page.set("proven", sentences(words.proven));
  page.set("unproven", sentences(words.unproven));
  page["command"] = options.command;
  page["reportCommand"] = options.report_command;
  page["firstFile"] = first.files.empty() ? "" : first.files.front();
  page.set("figures", figures);
  page.set("hasFigures", truth(!options.figures.empty()));
  page["modelText"] = mechanism.source_text();
  page["style"] = std::string(kPageStyle) + set_style();
  page["familyStyle"] = std::string(kFamilyStyle);
  page["data"] = family_model(members, options);
  page.set("payloads", payloads);
  page["script"] = std::string(kFamilyScript);
  mustache::mustache pattern{std::string(kFamilyTemplate)};
  if (!pattern.is_valid()) throw std::logic_error("the family page's template: " + pattern.error_message());
  return pattern.render(page);
}

}  // namespace corank::report
