#include "corank/analyze/paths/path_factor.h"

#include <fmt/format.h>

#include <cmath>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/paths/path_of_robots.h"

namespace corank::analyze {
namespace {

FactorStep try_at(const study::Question& scaled, double factor, const result::PathFile& path, solve::Control& control,
                  PathFactor& result) {
  PathOfRobots robots(scaled, result.avoid, path);
  const std::string obstacle = robots.drawn(control);
  const auto ended = [&] { return FactorStep{.obstacle = "stopped by " + solve::stopped_by(control), .ends = true}; };
  if (control.ended()) return ended();
  if (!obstacle.empty()) return {.obstacle = obstacle, .ends = true};
  if (const auto failure = robots.failure(control)) {
    result.place = failure->place;
    result.what = failure->what;
    // The factor of the robots of that share.
    return {FactorStep::Kept::no, std::min(factor, std::nextafter(factor * failure->share, HUGE_VAL)), failure->robot};
  }
  const bool follow = robots.all_follow(control);
  if (control.ended()) return ended();
  if (follow) return {FactorStep::Kept::yes, factor};
  return {.obstacle = "neither that every robot follows the path nor that one does not is proven"};
}

}  // namespace

PathFactor path_factor(const study::Question& question, const result::PathFile& path, const PathFactorOptions& options,
                       solve::Control& control) {
  PathFactor result;
  result.precision = options.precision;
  result.avoid = avoid_from_string(path.avoid).value();
  require_a_tolerance(question);
  const auto attempt = [&](const study::Question& scaled, double factor) {
    return try_at(scaled, factor, path, control, result);
  };
  search_factor(question, attempt, options.progress, result);
  result.stopped = solve::stopped_by(control);
  return result;
}

std::string to_table(const study::Question& question, const PathFactor& f) {
  std::string text =
      fmt::format("{}\nevery robot is to keep: the path without {}\n", question.model.name(), in_words(f.avoid));
  text += factor_lines(f, "that does not keep it");
  if (f.upper) text += fmt::format("  {}:\n", f.what) + value_lines(f.place);
  return text + last_lines(f);
}

std::string to_json(const study::Question& question, const PathFactor& f) {
  Json json{{"model", question.model.name()}, {"keep", {{"path", to_string(f.avoid)}}}};
  add_bounds(f, json);
  json["place"] = f.upper ? ends_of(f.place) : Json();
  json["what"] = or_null(f.what);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
