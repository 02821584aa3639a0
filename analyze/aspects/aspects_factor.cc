#include "corank/analyze/aspects/aspects_factor.h"

#include <fmt/format.h>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/robots/robots_words.h"

namespace corank::analyze {
namespace {

FactorStep try_at(const study::Question& scaled, double factor, const AspectsFactorOptions& options, solve::Control& control,
                  AspectsFactor& result) {
  const Aspects found = aspects(scaled, {.threads = options.threads}, control);
  if (control.ended()) return {.obstacle = "stopped by " + solve::stopped_by(control), .ends = true};
  result.numbers = exact_numbers_of(found);
  if (result.numbers.size() < 3)
    return {.obstacle = "the numbers of the robot as drawn are not known exactly", .ends = true};
  const Robots& robots = found.robots.value();
  if (robots.same) return {FactorStep::Kept::yes, factor};
  if (robots.other.empty()) return {.obstacle = robots.obstacle};
  result.other_numbers = robots.other_numbers;
  return {FactorStep::Kept::no, factor, robots.other};
}

Json to_object(const ExactNumbers& numbers) {
  Json json = Json::object();
  for (const auto& [name, value] : numbers) json[name] = value;
  return json;
}

}  // namespace

AspectsFactor aspects_factor(const study::Question& question, const AspectsFactorOptions& options, solve::Control& control) {
  AspectsFactor result;
  result.precision = options.precision;
  const auto attempt = [&](const study::Question& scaled, double factor) {
    return try_at(scaled, factor, options, control, result);
  };
  search_factor(question, attempt, options.progress, result);
  result.stopped = solve::stopped_by(control);
  return result;
}

std::string to_table(const study::Question& question, const AspectsFactor& f) {
  return fmt::format("{}\nevery robot is to keep: {}\n", question.model.name(), in_words(f.numbers)) +
         factor_lines(f, "with " + in_words(f.other_numbers)) + last_lines(f);
}

std::string to_json(const study::Question& question, const AspectsFactor& f) {
  Json json{{"model", question.model.name()}};
  json["keep"] = to_object(f.numbers);
  add_bounds(f, json);
  json["other"] = f.robot.empty() ? Json() : to_object(f.other_numbers);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
