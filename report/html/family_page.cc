#include "corank/report/html/family_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "corank/report/html/page_assets.h"
#include "corank/report/html/page_data.h"
#include "corank/report/html/page_words.h"
#include "corank/report/html/template_data.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/writing/mathml.h"

namespace corank::report {
namespace {

/// The variables of a result in the plane of two coordinates, by index: of a length itself, of an angle its cosine and its
/// sine. Throws std::invalid_argument where the result lacks a coordinate.
std::vector<int> plane_variables(const result::Result& result, const std::array<std::string, 2>& axes) {
  const std::vector<result::Value> all = own_coordinates(result, result.configuration_size);
  std::vector<int> list;
  for (const std::string& name : axes) {
    const auto found = std::ranges::find(all, name, &result::Value::name);
    if (found == all.end()) throw std::invalid_argument("the set '" + result.set + "' has no coordinate " + name);
    if (found->angle) {
      list.insert(list.end(), {found->angle->cosine, found->angle->sine});
    } else {
      list.push_back(found->variable);
    }
  }
  return list;
}

Json axes_of(const symbolic::Mechanism& mechanism, const std::array<std::string, 2>& axes) {
  int next = 0;
  return each(axes, [&](const std::string& name) {
    const int found = mechanism.find_coordinate(name);
    if (found < 0) throw std::invalid_argument(name + " is not a coordinate of " + mechanism.name());
    Json entry = {{"name", name}, {"label", label(name)}};
    const bool angle = mechanism.coordinates()[found].kind == symbolic::CoordinateKind::angle;
    for (const char* key : angle ? std::vector{"cosine", "sine"} : std::vector{"index"}) entry[key] = next++;
    return entry;
  });
}

Json set_of(const SetView& view, const std::array<std::string, 2>& axes) {
  const Json names = each(plane_variables(view.result, axes), [&](int v) { return view.result.variables[v].name; });
  Json set = set_description(view);
  set.update({{"variables", names}, {"configuration", names.size()}});
  return set;
}

/// What the page's script reads: the plane of the portraits and each member's sets. Numbers of variables count those of
/// plane_variables().
std::string family_model(const std::vector<FamilyMember>& members, const FamilyOptions& options) {
  const symbolic::Mechanism& first = members.at(0).mechanism;
  const auto member_of = [&](const FamilyMember& member) {
    return Json{{"text", member.value},
                {"value", symbolic::constant_values(member.mechanism).at(options.constant)},
                {"sets", each(member.sets, [&](const SetView& view) { return set_of(view, options.axes); })}};
  };
  const Json model = {{"model", first.name()},
                      {"verdicts", verdict_names()},
                      {"constant", {{"name", options.constant}, {"label", label(options.constant)}}},
                      {"coordinates", axes_of(first, options.axes)},
                      {"drawing", {{"unit", first.drawing().unit}}},
                      {"members", each(members, member_of)}};
  return script_safe(model.dump(-1, ' ', false, Json::error_handler_t::replace));
}

struct Totals {
  std::size_t covers = 0, complete = 0, boxes = 0, proven = 0, parts = 0, border = 0, partial = 0, undecided = 0,
              pending = 0;
  double finest = HUGE_VAL, coarsest = 0;
};

Totals totals_of(const std::vector<FamilyMember>& members) {
  Totals t;
  for (const FamilyMember& member : members) {
    for (const SetView& view : member.sets) {
      const Cover& cover = view.result.cover;
      ++t.covers;
      t.complete += cover.complete() ? 1 : 0;
      t.boxes += cover.boxes.size();
      t.proven += cover.count(Verdict::regular) + cover.count(Verdict::isolated) + cover.count(Verdict::exact);
      t.parts += result::parts_of_sheets(view.result);
      t.border += cover.count(Verdict::boundary);
      t.partial += cover.count(Verdict::partial);
      t.undecided += cover.count(Verdict::undecided);
      t.pending += cover.count(Verdict::pending);
      t.finest = std::min(t.finest, cover.sigma.largest());
      t.coarsest = std::max(t.coarsest, cover.sigma.largest());
    }
  }
  return t;
}

bool has_surface(const FamilyMember& member) {
  return std::ranges::any_of(member.sets,
                             [](const SetView& view) { return view.set->is_cspace() && view.result.cover.dimension > 1; });
}

Findings family_words(const std::vector<FamilyMember>& members, const FamilyOptions& options) {
  const Totals t = totals_of(members);
  Findings words;
  words.proven.push_back(
      fmt::format("Each picture shows one mechanism, whose {} has exactly the value under the picture.", options.constant));
  if (t.complete == t.covers) {
    words.proven.push_back(
        "For each mechanism, every solution in the search domain lies in a box: the rest of the domain is excluded with "
        "outward rounding.");
    if (has_surface(members.front()))
      words.proven.push_back("So the robot cannot reach a place over which there is no box of C-space.");
  } else {
    words.unproven.push_back(
        fmt::format("{} of {} searches ended early and left {} boxes unsearched, which may hold solutions.",
                    grouped(t.covers - t.complete), grouped(t.covers), grouped(t.pending)));
  }
  if (t.proven > 0)
    words.proven.push_back(
        fmt::format("{} of all {} boxes ({}) are proven to hold solutions: exactly one for every value of their free "
                    "coordinates{}.",
                    grouped(t.proven), grouped(t.boxes), percentage(t.proven, t.boxes),
                    t.parts > 0 ? ", or at most one in boxes that hold parts of sheets" : ""));
  if (t.border > 0)
    words.proven.push_back(
        fmt::format("In {} the set is smooth, but may reach beyond the search domain.", result::counted(t.border, "box")));
  if (t.partial > 0)
    words.unproven.push_back(fmt::format("In {} boxes only independent equations are proven to hold.", grouped(t.partial)));
  if (t.undecided > 0)
    words.unproven.push_back(
        fmt::format("{} boxes are undecided: they may or may not hold solutions.", grouped(t.undecided)));
  words.unproven.push_back(fmt::format("Nothing is claimed about values of {} between those shown.", options.constant));
  const std::string edges =
      t.finest == t.coarsest ? fmt::format("{:g}", t.finest) : fmt::format("{:g} to {:g}", t.finest, t.coarsest);
  words.unproven.push_back(fmt::format(
      "Boxes (σ: {}) may cover a gap that is narrower than they are, and a locus looks as wide as its boxes.", edges));
  return words;
}

/// The value of the constant, typeset.
std::string value_html(const FamilyMember& member, const std::string& constant, const std::string& before = "") {
  const auto& all = member.mechanism.constants();
  const auto found = std::ranges::find_if(all, [&](const auto& c) { return c.name == constant; });
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
      if (std::ranges::any_of(members, [&](const auto& m) { return m.sets[s].result.cover.count(verdict) > 0; }))
        all.back().verdicts.push_back(verdict);
    }
  }
  return all;
}

TemplateData cell(const char* key, const std::string& text, bool first) {
  TemplateData data{key, text};
  data["isFirst"] = first;
  return data;
}

TemplateData heads(const std::vector<Columns>& all, const FamilyMember& member) {
  TemplateData groups = empty_list();
  for (const Columns& columns : all) {
    TemplateData group = entry_of(member.sets[columns.set]), names = empty_list();
    group["width"] = std::to_string(columns.verdicts.size() + 2);
    names << cell("head", "components", true) << cell("head", "boxes", false);
    for (const Verdict verdict : columns.verdicts) names << cell("head", std::string(to_string(verdict)), false);
    group["heads"] = std::move(names);
    groups << group;
  }
  return groups;
}

TemplateData counts(const std::vector<Columns>& all, const FamilyMember& member) {
  TemplateData cells = empty_list();
  for (const Columns& columns : all) {
    const SetView& view = member.sets[columns.set];
    const Cover& cover = view.result.cover;
    cells << cell("count", view.components.counted ? grouped(view.components.count) : "–", true)
          << cell("count", grouped(cover.boxes.size()), false);
    for (const Verdict verdict : columns.verdicts) cells << cell("count", grouped(cover.count(verdict)), false);
  }
  return cells;
}

TemplateData entry(const FamilyMember& member, std::size_t index, const std::vector<Columns>& columns,
                   const std::string& constant) {
  TemplateData data, cards = empty_list();
  for (const SetView& view : member.sets) cards << TemplateData{"card", card_html(view)};
  data["index"] = std::to_string(index);
  data["value"] = member.value;
  data["valueHtml"] = value_html(member, constant);
  data["nameHtml"] = value_html(member, constant, symbolic::mathml_name(constant) + "<mo>=</mo>");
  data["isLater"] = index > 0;
  data["cards"] = std::move(cards);
  data["counts"] = counts(columns, member);
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
  TemplateData entries = empty_list(), runs = empty_list(), payloads = empty_list(), sets = empty_list();
  bool complete = true;
  for (std::size_t m = 0; m < members.size(); ++m) {
    entries << entry(members[m], m, columns, options.constant);
    for (std::size_t s = 0; s < members[m].sets.size(); ++s) {
      const SetView& view = members[m].sets[s];
      payloads << payload(view, std::to_string(m) + "-" + view.result.set, plane_variables(view.result, options.axes));
      TemplateData run = run_of(view, s < members[m].files.size() ? members[m].files[s] : "");
      run["valueHtml"] = value_html(members[m], options.constant);
      runs << run;
      complete = complete && view.result.cover.complete();
    }
  }
  for (const SetView& view : first.sets) sets << entry_of(view);

  TemplateData page = page_of(mechanism);
  page["constant"] = options.constant;
  page["constantName"] = symbolic::html_name(options.constant);
  page["from"] = value_html(first, options.constant);
  page["to"] = value_html(members.back(), options.constant);
  page["valuesHtml"] =
      result::joined(members, [&](const FamilyMember& member) { return value_html(member, options.constant); });
  page["constants"] = constants_html(mechanism, options.constant);
  page["inputs"] = chosen_html(mechanism, symbolic::Role::input);
  page["outputs"] = chosen_html(mechanism, symbolic::Role::output);
  page["missing"] = members.size() < options.asked;
  page["done"] = std::to_string(members.size());
  page["asked"] = std::to_string(options.asked);
  page["incomplete"] = !complete;
  page["last"] = std::to_string(members.size() - 1);
  page["sets"] = std::move(sets);
  page["members"] = std::move(entries);
  page["columns"] = heads(columns, first);
  page["runs"] = std::move(runs);
  add_findings(family_words(members, options), page);
  page["command"] = options.command;
  page["reportCommand"] = options.report_command;
  page["firstFile"] = first.files.empty() ? "" : first.files.front();
  page["figures"] = list_of("figure", options.figures);
  page["hasFigures"] = !options.figures.empty();
  page["familyStyle"] = std::string(kFamilyStyle);
  page["data"] = family_model(members, options);
  page["payloads"] = std::move(payloads);
  page["script"] = std::string(kFamilyScript);
  return filled(kFamilyTemplate, page);
}

std::string family_summary(const std::string& model, const std::string& constant, const std::string& page,
                           const std::vector<FamilyMember>& members, bool complete) {
  const Json list = each(members, [](const FamilyMember& member) {
    return Json{{"value", member.value}, {"sets", summaries(member.sets, member.files)}};
  });
  return Json{{"model", model}, {"constant", constant}, {"page", page}, {"complete", complete}, {"members", list}}.dump(
      2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::report
