#include "corank/report/page_summary.h"

#include <nlohmann/json.hpp>

#include "corank/result/summary.h"

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;

Json sets_of(const std::vector<SetView>& views, const std::vector<std::string>& files) {
  Json sets = Json::array();
  for (std::size_t k = 0; k < views.size(); ++k) {
    Json set = Json::parse(result::to_json(views[k].result));
    set["file"] = files.at(k);
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace

std::string page_summary(const std::string& model, const std::string& page, const PageOptions& options,
                         const std::vector<SetView>& views, bool complete) {
  const Json sets = sets_of(views, options.files);
  return Json{{"model", model}, {"page", page}, {"figures", options.figures}, {"complete", complete}, {"sets", sets}}.dump(
      2);
}

std::string family_summary(const std::string& model, const std::string& constant, const std::string& page,
                           const std::vector<FamilyMember>& members, bool complete) {
  Json json{{"model", model}, {"constant", constant}, {"page", page}, {"complete", complete}, {"members", Json::array()}};
  for (const FamilyMember& member : members)
    json["members"].push_back({{"value", member.value}, {"sets", sets_of(member.sets, member.files)}});
  return json.dump(2);
}

}  // namespace corank::report
