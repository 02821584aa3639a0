// What several pages' templates are filled with, and what their scripts read.
#pragma once

#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corank/report/html/set_view.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::report {

using TemplateData = kainjow::mustache::data;
using Json = nlohmann::ordered_json;

inline TemplateData empty_list() { return TemplateData{TemplateData::type::list}; }
/// A list of {key: …}.
TemplateData list_of(const std::string& key, const std::vector<std::string>& items);
/// The text, where it is not empty; a section about it is left out otherwise.
inline TemplateData if_any(const std::string& text) { return text.empty() ? TemplateData{false} : TemplateData{text}; }

/// "proven" and "unproven" as lists of {"sentence": …}, "hasProven", "hasUnproven".
void add_findings(const Findings& findings, TemplateData& data);

/// What every page says of a mechanism, and its style without its set's: "model", "modelText", "version", "unit", "style".
TemplateData page_of(const symbolic::Mechanism& mechanism);
/// {"name", "title"}
TemplateData entry_of(const SetView& view);
/// {"title", "sigma", "boxes", "processed", "seconds", "file"}
TemplateData run_of(const SetView& view, const std::string& file);
/// {"id", "boxes", "verdicts"}: what is drawn of these variables; of all, where none are named.
TemplateData payload(const SetView& view, const std::string& id, std::span<const int> variables = {});
/// The card of a set: what was found, what of it is proven, the shares of the verdicts. An HTML fragment.
std::string card_html(const SetView& view);

/// A JSON list of what `of` makes of each item.
template <class Items, class Of>
Json each(const Items& items, const Of& of) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(of(item));
  return list;
}
/// A name as the scripts write it: [base, subscript].
Json label(const std::string& name);
/// The words of all verdicts, in the order of Verdict.
Json verdict_names();
/// What the scripts read of a set: "name", "title" of one member, is it "singular", whose rates are "locked", "layer" and
/// "dot" (SetLook), "dimension", "sigma", "complete", "count" of boxes, "types" of each box, and of a workspace boundary
/// "passage" (null of other sets).
Json set_description(const SetView& view);

/// The same with its variables, equations, points and self-motions.
Json set_of(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation, const SetView& view);
/// page_model() with these sets, made by set_of().
std::string page_model_of(const symbolic::Mechanism& mechanism, Json sets);

/// Of each set what corank solve --json prints of it, with its file.
Json summaries(const std::vector<SetView>& views, const std::vector<std::string>& files);

std::string filled(std::string_view pattern, const TemplateData& data);

}  // namespace corank::report
