// A clearance in words and as JSON.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "corank/analyze/clearance.h"
#include "corank/analyze/clearance_words.h"

namespace corank::analyze {
namespace {

using Json = nlohmann::ordered_json;

const char* word(Clearance::Center center) {
  switch (center) {
    case Clearance::Center::assembled: return "assembled";
    case Clearance::Center::not_assembled: return "not assembled";
    case Clearance::Center::unknown: break;
  }
  return "unknown";
}

Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

}  // namespace

std::string to_table(const Clearance& c) {
  std::string ball, at;
  for (const NamedValue& v : c.ball.center) {
    ball += (ball.empty() ? "" : ", ") + v.name;
    at += (at.empty() ? "" : ", ") + fmt::format("{} = {}", v.name, v.value.text());
  }
  std::string text = fmt::format("{}, {}: ball in {} about {}\n", c.ball.question.model.name(), set_of(c.ball), ball, at);
  const Nearest& n = c.nearest;
  const bool plain = !c.ball.question.set;
  const std::string what = plain ? "solution" : "singularity";
  if (n.empty) {
    text += fmt::format("it is proven that there is no {} in the ranges", what);
    text += std::isfinite(c.ball.room)
                ? fmt::format("; at the radius {} the ball meets {}\n", rounded(c.ball.room, false), c.ball.end)
                : "\n";
  } else {
    const std::string hi = n.upper ? rounded(*n.upper, true) : "unknown";
    const bool ends_first = c.ball.room < n.lower;  // so no larger ball was searched as a whole
    if (ends_first) {
      text += fmt::format("radius {}: there the ball meets {}; it is proven that the ball holds no {}\n",
                          rounded(c.ball.room, false), c.ball.end, what);
      text += fmt::format("  it is proven that within the ranges no {} is nearer than {}\n", what, rounded(n.lower, false));
    } else {
      text += fmt::format("radius in [{}, {}]", rounded(n.lower, false), hi);
      if (n.upper && n.lower > 0) text += fmt::format("   ({:.2g} %)", 100 * (*n.upper - n.lower) / *n.upper);
      text += fmt::format("\n  it is proven that no {} is nearer than the lower bound\n", what);
      if (std::isfinite(c.ball.room))
        text += fmt::format("  at the radius {} the ball meets {}\n", rounded(c.ball.room, false), c.ball.end);
    }
    if (n.upper) {
      text += fmt::format("  nearest {} found, proven to exist{}:\n", what,
                          ends_first ? fmt::format(", at a distance of at most {}", hi) : "");
      for (const CoordinateValue& v : c.values) text += fmt::format("    {} = {:.9g}\n", v.name, v.value.mid());
    } else {
      text += fmt::format("  no {} is proven to exist\n", what);
    }
  }
  if (!c.seemingly.empty()) {
    text += fmt::format("  there seems to be one at the distance {:.6g}, which is not proven:\n", n.unproven_distance);
    for (const auto& [name, value] : c.seemingly) text += fmt::format("    {} = {:.9g}\n", name, value);
  }
  if (c.ball.question.set && c.center == Clearance::Center::unknown)
    text += "  it is neither proven nor excluded that the robot has a configuration at the centre\n";
  return text + fmt::format("{} boxes processed, {:.3f} s\n", n.statistics.processed, c.seconds);
}

std::string to_json(const Clearance& c) {
  const Nearest& n = c.nearest;
  Json json = {
      {"model", c.ball.question.model.name()}, {"set", set_of(c.ball)}, {"at", Json::object()}, {"in", Json::array()}};
  for (const NamedValue& v : c.ball.center) {
    json["at"][v.name] = v.value.text();
    json["in"].push_back(v.name);
  }
  json["radius"] = {{"lo", finite(c.lower())}, {"hi", n.upper ? Json(*n.upper) : Json(nullptr)}};
  json["nearest"] = nullptr;
  if (n.upper) {
    json["nearest"] = Json::object();
    for (const CoordinateValue& v : c.values) json["nearest"][v.name] = {{"lo", v.value.lo()}, {"hi", v.value.hi()}};
  }
  json["empty"] = n.empty;
  json["room"] = finite(c.ball.room);
  json["end"] = c.ball.end.empty() ? Json(nullptr) : Json(c.ball.end);
  json["ball"] = finite(c.free_radius());
  json["seemingly"] = nullptr;
  if (!c.seemingly.empty()) {
    json["seemingly"] = {{"distance", n.unproven_distance}, {"values", Json::object()}};
    for (const auto& [name, value] : c.seemingly) json["seemingly"]["values"][name] = value;
  }
  json["center"] = word(c.center);
  json["complete"] = n.complete;
  json["stopped"] = c.stopped.empty() ? Json(nullptr) : Json(c.stopped);
  json["precision"] = c.precision;
  json["processed"] = n.statistics.processed;
  json["seconds"] = c.seconds;
  return json.dump(2);
}

}  // namespace corank::analyze
