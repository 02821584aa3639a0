#include "corank/app/ball_command.h"

#include <fmt/format.h>

#include "corank/app/exit_status.h"

namespace corank::app {

// "±0.2", "+-0.2" about the value, or "[a,b]".
analyze::NamedRange range_of(const std::string& text, const std::vector<analyze::NamedValue>& at,
                             const std::string& option) {
  const std::string expected = option == "--range" ? "NAME=[A,B], or NAME=±D if --at gives NAME" : "NAME=[A,B],…";
  auto [name, range] = split_at_equals(text, option, expected);
  if (range.front() == '[' && range.back() == ']') {
    const std::vector<std::string> ends = parts_of({range.substr(1, range.size() - 2)});
    if (ends.size() != 2) throw UsageError(fmt::format("{} {}: expected {}", option, text, expected));
    return {name, expression(ends[0], option), expression(ends[1], option)};
  }
  for (const std::string sign : {"±", "+-"}) {
    if (!range.starts_with(sign)) continue;
    const symbolic::Expression half = expression(range.substr(sign.size()), option);
    for (const analyze::NamedValue& v : at)
      if (v.name == name) return {name, v.value - half, v.value + half};
  }
  throw UsageError(fmt::format("{} {}: expected {}", option, text, expected));
}

void BallCommand::add_options(CLI::App& sub, const std::string& required) {
  question.add_options(sub, "Which configurations the ball must not hold",
                       "Then the ball holds no configuration at which one reaches its limit", false);
  add_option(sub, "--at NAME=VALUE,...", at,
             "The centre of the ball, and other coordinates that keep a value; a VALUE may use the model's constants, and\n"
             "15deg is an angle in degrees");
  add_option(sub, "--in NAME,...", in,
             "The coordinates in which the ball lies" + required + "; one radian counts like one unit of length");
  add_option(
      sub, "--range,--mode NAME=[A,B],NAME=±D,...", ranges,
      "Search these ranges of coordinates instead of the model's, for example to look at one working mode only, to\n"
      "set a joint's limit, or to let an angle vary; ±D or +-D: by at most D from the value in --at; --mode is the same "
      "option");
  add_option(
      sub, "--orientation-range ANGLE", orientation_range,
      "Let angles of the outputs vary by at most ANGLE from their value in --at, and the orientation of a spatial robot\n"
      "by a turn of at most ANGLE from the one in --orientation");
  orientation.add_options(sub, "Orientation of a spatial robot, such as Rz(0.2)*Ry(10deg)*Rx(0.3)",
                          "The link or the rotation matrix");
  limits.add_options(sub, "the search");
}

void BallCommand::require_center(const std::string& except) const {
  const std::string rest = except.empty() ? "" : ", " + except;
  if (at.empty()) throw UsageError("--at is required" + rest);
  if (in.empty()) throw UsageError("--in is required" + rest);
}

analyze::BallOptions BallCommand::ball() const {
  analyze::BallOptions options;
  options.at = named_values(at, "--at");
  options.in = parts_of(in);
  for (const std::string& part : parts_of(ranges)) options.ranges.push_back(range_of(part, options.at));
  expect_each_once(options.ranges, "--range");
  options.orientation = orientation.rotation();
  if (!orientation_range.empty()) options.orientation_range = expression(orientation_range, "--orientation-range");
  options.orientation_of = orientation.of;
  return options;
}

study::Question BallCommand::load() const {
  QuestionOptions options = question;
  study::Question loaded = app::load(options);
  if (options.set.empty() && !loaded.model.is_plain_system())
    options.set = options.require.empty() ? "forward" : "requirements";
  loaded.set = chosen_set(options, loaded.model);
  return loaded;
}

solve::Options BallCommand::search() const {
  solve::Options options;
  limits.apply(options);
  options.validate();
  return options;
}

}  // namespace corank::app
