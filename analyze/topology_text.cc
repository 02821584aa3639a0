#include "corank/analyze/topology.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "corank/core/check.h"
#include "corank/result/shape_file.h"

namespace corank::analyze {
namespace {

std::string counted(int n, const std::string& noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string components_text(const Components& c) {
  if (c.exact()) return counted(c.at_least, "component");
  return c.at_most ? fmt::format("from {} to {} components ({})", c.at_least, *c.at_most, c.reason)
                   : fmt::format("at least {} ({})", counted(c.at_least, "component"), c.reason);
}

const char* surface_name(int genus) {
  constexpr std::array kNames{"sphere", "torus", "double torus"};
  return genus < 3 ? kNames[static_cast<std::size_t>(genus)] : "closed surface";
}

// "2 tori (genus 1)": of equal ones together.
std::string shapes(const std::vector<int>& genus) {
  std::string text;
  for (std::size_t i = 0, j = 0; i < genus.size(); i = j) {
    while (j < genus.size() && genus[j] == genus[i]) ++j;
    text += (i == 0 ? "" : ", ") + fmt::format("{} × {} (genus {})", j - i, surface_name(genus[i]), genus[i]);
  }
  return text;
}

}  // namespace

result::ShapeFile to_file(const study::Question& question, const Topology& topology) {
  CORANK_CHECK(topology.certificate != nullptr);
  result::ShapeFile file;
  file.model = question.model.name();
  file.model_text = question.model.source_text();
  file.constants = question.constants;
  file.shape = *topology.certificate;
  return file;
}

std::string to_text(const study::Question& question, const Topology& t) {
  std::string text = fmt::format("{}, {}\n", question.model.name(),
                                 question.model.is_plain_system() ? "solutions of the system" : "C-space");
  text += fmt::format("  dimension             {}\n", t.dimension);
  text += fmt::format("  components            {}\n", components_text(t.components));
  if (t.dimension > 0) text += fmt::format("  smooth, without ends  {}\n", t.smooth ? "proven" : "not shown");
  if (!t.ends.empty()) text += fmt::format("  strictly within       {}\n", fmt::join(t.ends, ", "));
  if (t.euler_characteristic) text += fmt::format("  Euler characteristic  {}\n", *t.euler_characteristic);
  if (t.dimension == 1 && t.smooth && t.components.exact())
    text += fmt::format("  shape                 {}\n", counted(t.components.at_least, "closed curve"));
  if (!t.genus.empty()) text += fmt::format("  shape                 {}\n", shapes(t.genus));
  for (std::size_t k = 0; k < t.heights.size(); ++k) {
    const HeightCount& h = t.heights[k];
    text += fmt::format("  {} height         {} critical points, by index: {}\n", k == 0 ? "one    " : "another", h.points(),
                        fmt::join(h.by_index, ", "));
  }
  if (!t.reason.empty()) text += fmt::format("  not known             {}\n", t.reason);
  return text;
}

std::string to_json(const study::Question& question, const Topology& t, bool complete) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::optional<int>& x) { return x ? Json(*x) : Json(); };
  Json json;
  json["model"] = question.model.name();
  json["dimension"] = t.dimension;
  json["components"] = {{"at_least", t.components.at_least}, {"at_most", or_null(t.components.at_most)}};
  json["smooth"] = t.smooth;
  json["ends"] = t.ends;
  json["euler_characteristic"] = or_null(t.euler_characteristic);
  json["genus"] = t.genus;
  json["critical_points"] = t.heights.empty() ? Json() : Json(t.heights.front().points());
  json["heights"] = Json::array();
  for (const HeightCount& h : t.heights)
    json["heights"].push_back({{"critical_points", h.points()}, {"by_index", h.by_index}});
  json["reason"] = t.reason.empty() ? t.components.reason : t.reason;
  json["processed"] = t.processed;
  json["complete"] = complete;
  return json.dump(2);
}

}  // namespace corank::analyze
