// A clearance, the best centre and a factor of tolerances, in words and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "corank/analyze/clearance/best_center.h"
#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/clearance/json.h"
#include "corank/analyze/clearance/tolerance_factor.h"
#include "corank/result/values/words.h"

namespace corank::analyze {
namespace {

Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(); }

}  // namespace

std::string rounded(double x, bool up) {
  if (!std::isfinite(x)) return "infinity";
  double shown = std::stod(fmt::format("{:.6g}", x));
  const double unit = x == 0 ? 0 : std::pow(10, std::floor(std::log10(std::fabs(x))) - 5);
  if (up ? shown < x : shown > x) shown += up ? unit : -unit;
  return fmt::format("{:.6g}", shown);
}

std::string progress_text(double lower, const std::optional<double>& upper, std::uint64_t count, const std::string& what) {
  const std::string radius =
      upper ? fmt::format("radius in [{:.5g}, {:.5g}]", lower, *upper) : fmt::format("radius at least {:.5g}", lower);
  return fmt::format("{}, {} {}", radius, count, what);
}

std::string stopped_line(const std::string& stopped) { return stopped.empty() ? "" : "stopped by " + stopped + "\n"; }

std::string value_lines(const std::vector<CoordinateValue>& values) {
  std::string text;
  for (const CoordinateValue& v : values) text += fmt::format("    {} = {:.9g}\n", v.name, v.value.mid());
  return text;
}

namespace {

std::string ball_line(const Ball& ball) {
  std::vector<std::string> at;
  for (const NamedValue& v : ball.center) at.push_back(fmt::format("{} = {}", v.name, v.value.text()));
  return fmt::format("{}, {}: ball in {} about {}\n", ball.question.model.name(), ball.set_name(),
                     fmt::join(ball.names(), ", "), fmt::join(at, ", "));
}

Json json_about(const Ball& ball) {
  Json json = {{"model", ball.question.model.name()}, {"set", ball.set_name()}, {"at", Json::object()}};
  for (const NamedValue& v : ball.center) json["at"][v.name] = v.value.text();
  json["in"] = ball.names();
  return json;
}

std::string what_of(const study::Question& q) {
  if (!q.set) return "solution";
  if (q.set == symbolic::SingularitySet::cspace) return "configuration";
  return symbolic::definition(q.set).of_requirements ? "limit of a requirement" : "singularity";
}

std::string required_lines(const study::Question& q) {
  std::string text;
  if (!symbolic::definition(q.set).of_requirements) return text;
  for (const std::string& r : q.model.requirement_texts()) text += fmt::format("required: {}\n", r);
  return text;
}

// Of several whose limit the nearest one is; else empty.
std::string nearest_requirement(const Clearance& c) {
  return c.requirement ? c.ball.question.model.requirement_texts().at(*c.requirement) : "";
}

}  // namespace

std::string to_table(const Clearance& c) {
  std::string text = ball_line(c.ball);
  const Nearest& n = c.nearest;
  const std::string what = what_of(c.ball.question);
  text += required_lines(c.ball.question);
  if (!c.postures.empty())
    text += fmt::format(
        "configurations at the centre: {}; proven to meet what is required: {}, not to meet it: {}; "
        "no motion within the ball changes that\n",
        c.postures.size(), std::ranges::count(c.postures, Standing::satisfied),
        std::ranges::count(c.postures, Standing::violated));
  if (const auto toleranced = c.ball.question.model.toleranced(); !toleranced.empty())
    text += fmt::format("for every robot within the {} of {}\n", result::noun(toleranced.size(), "tolerance"),
                        fmt::join(toleranced, ", "));
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
      if (c.requirement) text += fmt::format("  of {}\n", nearest_requirement(c));
      text += value_lines(c.values);
      if (!c.robot.empty()) text += "  of the robot with\n";
      text += value_lines(c.robot);
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
  return text + fmt::format("{} processed, {:.3f} s\n", result::counted(n.statistics.processed, "box"), c.seconds) +
         stopped_line(c.stopped);
}

std::string to_json(const Clearance& c) {
  const Nearest& n = c.nearest;
  Json json = json_about(c.ball);
  json["radius"] = {{"lo", finite(c.lower())}, {"hi", or_null(n.upper)}};
  json["nearest"] = n.upper ? ends_of(c.values) : Json();
  json["robot"] = ends_of(c.robot);
  if (c.requirement) json["requirement"] = nearest_requirement(c);
  json["empty"] = n.empty;
  json["room"] = finite(c.ball.room);
  json["end"] = or_null(c.ball.end);
  json["ball"] = finite(c.free_radius());
  json["seemingly"] = nullptr;
  if (!c.seemingly.empty()) {
    json["seemingly"] = {{"distance", n.unproven_distance}, {"values", Json::object()}};
    for (const auto& [name, value] : c.seemingly) json["seemingly"]["values"][name] = value;
  }
  constexpr std::array kCenters{"assembled", "not assembled", "unknown"};
  json["center"] = kCenters.at(static_cast<std::size_t>(c.center));
  if (!c.postures.empty())
    for (const Standing s : {Standing::satisfied, Standing::violated, Standing::open})
      json["postures"][to_string(s)] = std::ranges::count(c.postures, s);
  json["complete"] = n.complete;
  json["stopped"] = or_null(c.stopped);
  json["precision"] = c.precision;
  json["processed"] = n.statistics.processed;
  json["seconds"] = c.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string to_table(const Best& b) {
  std::vector<std::string> region;
  for (std::size_t k = 0; k < b.names.size(); ++k)
    region.push_back(fmt::format("{} in [{:.6g}, {:.6g}]", b.names[k], b.region[k].lo(), b.region[k].hi()));
  std::string text = fmt::format("{}, {}: the largest ball in {} with its centre in {}\n", b.ball.question.model.name(),
                                 b.ball.set_name(), fmt::join(b.ball.names(), ", "), fmt::join(region, ", "));
  const std::string what = what_of(b.ball.question);
  text += required_lines(b.ball.question);
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
    text += value_lines(b.nearest);
  }
  return text + fmt::format("{} cells, {} processed, {:.3f} s\n", b.cells, result::counted(b.processed, "box"), b.seconds) +
         stopped_line(b.stopped);
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
  json["radius"] = {{"lo", b.lower}, {"hi", or_null(b.upper)}};
  if (!b.center.empty()) json["centre"] = Json::object();
  for (std::size_t k = 0; k < b.center.size(); ++k) json["centre"][b.names[k]] = b.center[k];
  if (!b.nearest.empty()) json["nearest"] = ends_of(b.nearest);
  json["empty"] = b.empty;
  json["unassembled"] = b.unassembled;
  json["complete"] = b.complete || b.empty;
  json["stopped"] = or_null(b.stopped);
  json["precision"] = b.precision;
  json["cells"] = b.cells;
  json["processed"] = b.processed;
  json["seconds"] = b.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string to_table(const ToleranceFactor& f) {
  std::string text = ball_line(f.ball) + required_lines(f.ball.question);
  text += fmt::format("every robot is to keep: clearance >= {:g}\n", f.radius);
  if (f.upper == 0) {
    text += "the robot as drawn does not keep it; its nearest configuration of the set, proven to exist:\n";
  } else {
    text += factor_lines(f, "that does not keep it");
    if (!f.robot.empty()) text += "  its nearest configuration of the set:\n";
  }
  return text + value_lines(f.nearest) + last_lines(f, fmt::format("{} processed, ", result::counted(f.processed, "box")));
}

std::string to_json(const ToleranceFactor& f) {
  Json json = json_about(f.ball);
  json["keep"] = {{"clearance", f.radius}};
  add_bounds(f, json);
  json["nearest"] = f.nearest.empty() ? Json() : ends_of(f.nearest);
  json["processed"] = f.processed;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
