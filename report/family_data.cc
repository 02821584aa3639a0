#include "corank/report/family_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "corank/report/drawing_tree.h"
#include "corank/report/page_data.h"
#include "corank/symbolic/display_name.h"

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;

Json label(const std::string& name) {
  const symbolic::DisplayName shown = symbolic::display_name(name);
  return {shown.base, shown.subscript};
}

Json coordinates(const symbolic::Mechanism& mechanism, const std::array<std::string, 2>& axes) {
  Json list = Json::array();
  int next = 0;
  for (const std::string& name : axes) {
    const int found = mechanism.find_coordinate(name);
    if (found < 0) throw std::invalid_argument(name + " is not a coordinate of " + mechanism.name());
    Json entry = {{"name", name}, {"label", label(name)}};
    if (mechanism.coordinates()[static_cast<std::size_t>(found)].kind == symbolic::CoordinateKind::angle) {
      entry["cosine"] = next++;
      entry["sine"] = next++;
    } else {
      entry["index"] = next++;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json set_of(const SetView& view, const std::array<std::string, 2>& axes) {
  const result::Result& result = view.result;
  const std::vector<int> variables = plane_variables(result, axes);
  Json names = Json::array();
  for (const int v : variables) names.push_back(result.variables[static_cast<std::size_t>(v)].name);
  Json set = Json::parse(set_description(view));
  set.update({{"variables", names}, {"configuration", names.size()}});
  return set;
}

}  // namespace

std::vector<int> plane_variables(const result::Result& result, const std::array<std::string, 2>& axes) {
  std::vector<int> list;
  for (const std::string& name : axes) {
    const auto angle =
        std::find_if(result.angles.begin(), result.angles.end(), [&](const auto& a) { return a.name == name; });
    if (angle != result.angles.end()) {
      list.insert(list.end(), {angle->cosine, angle->sine});
      continue;
    }
    const auto variable =
        std::find_if(result.variables.begin(), result.variables.end(), [&](const auto& v) { return v.name == name; });
    if (variable == result.variables.end())
      throw std::invalid_argument("the set '" + result.set + "' has no coordinate " + name);
    list.push_back(static_cast<int>(variable - result.variables.begin()));
  }
  return list;
}

std::string family_set_id(std::size_t member, const std::string& set) { return std::to_string(member) + "-" + set; }

std::string family_model(const std::vector<FamilyMember>& members, const FamilyOptions& options) {
  const symbolic::Mechanism& first = members.at(0).mechanism;
  Json verdicts = Json::array(), list = Json::array();
  for (int v = 0; v < kVerdicts; ++v) verdicts.push_back(to_string(static_cast<Verdict>(v)));
  for (const FamilyMember& member : members) {
    Json sets = Json::array();
    for (const SetView& view : member.sets) sets.push_back(set_of(view, options.axes));
    list.push_back(
        {{"text", member.value}, {"value", constant_values(member.mechanism).at(options.constant)}, {"sets", sets}});
  }
  const Json model = {{"model", first.name()},
                      {"verdicts", verdicts},
                      {"constant", {{"name", options.constant}, {"label", label(options.constant)}}},
                      {"coordinates", coordinates(first, options.axes)},
                      {"drawing", {{"unit", first.drawing().unit}}},
                      {"members", list}};
  return script_safe(model.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace corank::report
