// The best centre in words and as JSON.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corank/analyze/best_center.h"

namespace corank::analyze {

using Json = nlohmann::ordered_json;

std::string to_table(const Best& b) {
  std::vector<std::string> region;
  for (std::size_t k = 0; k < b.names.size(); ++k)
    region.push_back(fmt::format("{} in [{:.6g}, {:.6g}]", b.names[k], b.region[k].lo(), b.region[k].hi()));
  std::string text = fmt::format("{}, {}: the largest ball in {} with its centre in {}\n", b.ball.question.model.name(),
                                 b.ball.set_name(), fmt::join(b.ball.names(), ", "), fmt::join(region, ", "));
  const std::string what = b.ball.question.set ? "singularity" : "solution";
  if (b.empty) {
    text += fmt::format("it is proven that there is no {} in the ranges\n", what);
  } else if (b.unassembled) {
    text += "it is proven that the robot has no configuration with a centre in the region\n";
  } else {
    text += fmt::format("radius in [{}, {}]", rounded(b.lower, false), b.upper ? rounded(*b.upper, true) : "unknown");
    if (b.upper && *b.upper > 0) text += fmt::format("   ({:.2g} %)", 100 * (*b.upper - b.lower) / *b.upper);
    text += "\n";
    if (b.center.empty()) text += "  no centre was found\n";
    for (std::size_t k = 0; k < b.center.size(); ++k) text += fmt::format("  {} = {:.9g}\n", b.names[k], b.center[k]);
    if (!b.nearest.empty()) text += fmt::format("  {} nearest to this centre, proven to exist:\n", what);
    for (const CoordinateValue& v : b.nearest) text += fmt::format("    {} = {:.9g}\n", v.name, v.value.mid());
  }
  return text + fmt::format("{} cells, {} boxes processed, {:.3f} s\n", b.cells, b.processed, b.seconds);
}

std::string to_json(const Best& b) {
  Json json = {{"model", b.ball.question.model.name()},
               {"set", b.ball.set_name()},
               {"in", b.ball.names()},
               {"region", Json::object()},
               {"radius", nullptr},
               {"centre", nullptr},
               {"nearest", nullptr}};
  for (std::size_t k = 0; k < b.names.size(); ++k) json["region"][b.names[k]] = {b.region[k].lo(), b.region[k].hi()};
  json["radius"] = {{"lo", b.lower}, {"hi", b.upper ? Json(*b.upper) : Json(nullptr)}};
  if (!b.center.empty()) json["centre"] = Json::object();
  for (std::size_t k = 0; k < b.center.size(); ++k) json["centre"][b.names[k]] = b.center[k];
  if (!b.nearest.empty()) json["nearest"] = Json::object();
  for (const CoordinateValue& v : b.nearest) json["nearest"][v.name] = {{"lo", v.value.lo()}, {"hi", v.value.hi()}};
  json["empty"] = b.empty;
  json["unassembled"] = b.unassembled;
  json["complete"] = b.complete || b.empty;
  json["stopped"] = b.stopped.empty() ? Json(nullptr) : Json(b.stopped);
  json["precision"] = b.precision;
  json["cells"] = b.cells;
  json["processed"] = b.processed;
  json["seconds"] = b.seconds;
  return json.dump(2);
}

}  // namespace corank::analyze
