#include "corank/result/domain_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "corank/certify/contact.h"

namespace corank::result {
namespace {

using certify::Contact;

/// What a contact is with, in the model's own words.
struct Thing {
  std::string reason;  ///< "upper end of x", "range of theta", "m.cuik:9"
  std::string range;   ///< the coordinate whose declared range this is; empty where it is none
};

Thing thing(const System& system, const Contact& contact) {
  const auto index = static_cast<std::size_t>(contact.index);
  if (contact.with == Contact::With::inequality) {
    const std::string& source = system.inequalities[index].source;
    for (const Angle& angle : system.angles)
      if (source == "range of " + angle.name) return {source, angle.name};
    return {source.empty() ? fmt::format("inequality {}", contact.index + 1) : source, ""};
  }
  for (const Angle& angle : system.angles)
    if (contact.index == angle.cosine || contact.index == angle.sine) return {"range of " + angle.name, angle.name};
  const Variable& v = system.variables[index];
  const bool declared = contact.index < system.configuration_size && v.kind == VariableKind::length;
  return {(contact.with == Contact::With::lower_end ? "lower end of " : "upper end of ") + v.name, declared ? v.name : ""};
}

bool is_of(const System& system, const Result& result) {
  return result.variables.size() == system.variables.size() &&
         std::all_of(result.cover.boxes.begin(), result.cover.boxes.end(),
                     [&](const CoverBox& b) { return b.box.size() == system.variables.size(); });
}

std::string sentence(const char* verb, const std::vector<std::string>& names) {
  const char* const s = names.size() == 1 ? "" : "s";
  return fmt::format("the set {} the end{} of the declared range{} of {}; nothing beyond was searched", verb, s, s,
                     fmt::join(names, ", "));
}

}  // namespace

void describe_domain(const symbolic::Mechanism& mechanism, const System& system, Result& result) {
  result.domain = {};
  if (!is_of(system, result)) return;
  for (const symbolic::Coordinate& c : mechanism.coordinates())
    if (!c.has_range)
      if (const int j = system.find(c.name); j >= 0) result.domain.found.push_back(j);

  std::map<std::string, bool> ends;  // reached
  std::map<std::string, std::size_t> reasons;
  std::size_t others = 0;
  std::vector<std::string> of_box;
  certify::visit_contacts(system, result.cover, [&](const CoverBox& b, const std::vector<Contact>& contacts) {
    of_box.clear();
    for (const Contact& contact : contacts) {
      const Thing with = thing(system, contact);
      if (!with.range.empty()) ends[with.range] = ends[with.range] || contact.reached;
      if (std::find(of_box.begin(), of_box.end(), with.reason) == of_box.end()) of_box.push_back(with.reason);
    }
    if (b.verdict != Verdict::boundary) return;
    for (const std::string& reason : of_box) ++reasons[reason];
    if (of_box.empty()) ++others;
  });
  const auto is_limited = [&](const std::string& name) {
    return std::any_of(mechanism.limits().begin(), mechanism.limits().end(),
                       [&](const symbolic::Limit& limit) { return limit.coordinate == name; });
  };
  for (const symbolic::Coordinate& c : mechanism.coordinates())
    if (const auto end = ends.find(c.name); end != ends.end() && c.has_range && !is_limited(c.name))
      result.domain.ends.push_back({c.name, end->second});
  for (const auto& [reason, boxes] : reasons) result.domain.boundary.push_back({reason, boxes});
  if (others > 0) result.domain.boundary.push_back({"rounding", others});
  std::stable_sort(result.domain.boundary.begin(), result.domain.boundary.end(),
                   [](const auto& a, const auto& b) { return a.boxes > b.boxes; });
}

std::vector<std::string> range_end_sentences(const DomainNotes& notes) {
  std::vector<std::string> sentences;
  for (const bool reached : {true, false}) {
    std::vector<std::string> names;
    for (const DomainNotes::End& end : notes.ends)
      if (end.reached == reached) names.push_back(end.coordinate);
    if (!names.empty()) sentences.push_back(sentence(reached ? "reaches" : "may reach", names));
  }
  return sentences;
}

}  // namespace corank::result
