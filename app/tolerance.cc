// corank tolerance: by which factor all tolerances may grow.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "corank/analyze/aspects/aspects_factor.h"
#include "corank/analyze/clearance/tolerance_factor.h"
#include "corank/app/ball_command.h"
#include "corank/app/exit_status.h"
#include "corank/app/limited_run.h"
#include "corank/app/progress.h"
#include "corank/app/subcommands.h"
#include "corank/result/values/words.h"

namespace corank::app {
namespace {

struct ToleranceCommand : BallCommand {
  std::string keep;
  analyze::ToleranceFactorOptions options;
  JsonOption json;
};

// "clearance>=0.15".
double radius_of(const std::string& keep) {
  std::string text;
  for (const char c : keep)
    if (c != ' ') text += c;
  const std::string start = "clearance>=";
  std::size_t end = 0;
  double radius = 0;
  try {
    if (text.starts_with(start)) radius = std::stod(text.substr(start.size()), &end);
  } catch (const std::logic_error&) {
    end = 0;
  }
  if (end == 0 || start.size() + end != text.size() || !(radius > 0) || !std::isfinite(radius))
    throw UsageError(fmt::format("--keep {}: expected \"clearance>=R\" with a positive number R, or \"aspects\"", keep));
  return radius;
}

std::string factor_line(double lower, std::optional<double> upper) {
  return upper ? fmt::format("factor in [{:.5g}, {:.5g}]", lower, *upper) : fmt::format("factor at least {:.5g}", lower);
}

ExitStatus find_aspects_factor(const ToleranceCommand& command) {
  for (const auto& [given, name] :
       {std::pair(!command.at.empty(), "--at"), std::pair(!command.in.empty(), "--in"),
        std::pair(!command.ranges.empty(), "--range"), std::pair(!command.question.set.empty(), "--set")})
    if (given) throw UsageError(fmt::format("{}: without effect beside --keep aspects", name));
  command.json.check();
  const solve::Options search = command.search();
  LimitedRun run(limits_of(search, nullptr));
  ProgressLine line;
  analyze::AspectsFactorOptions options{.precision = command.options.precision, .threads = search.threads, .progress = {}};
  options.progress = [&line](double lower, std::optional<double> upper) { line.show(factor_line(lower, upper)); };
  const study::Question question = app::load(command.question);
  if (question.model.is_plain_system())
    throw UsageError(fmt::format("{} names no inputs and outputs: a plain system has no aspects", command.question.file));
  const analyze::AspectsFactor found = analyze::aspects_factor(question, options, run.control());
  line.clear();
  if (command.json.say([&] { return to_json(question, found); }))
    fmt::print("{}", result::printable(to_table(question, found)));
  return found.complete() ? kDone : kIncomplete;
}

ExitStatus find_factor(ToleranceCommand command) {
  command.json.give_back(command.question.file);
  if (command.keep == "aspects") return find_aspects_factor(command);
  command.options.radius = radius_of(command.keep);
  command.require_center();
  command.json.check();
  const solve::Options search = command.search();
  LimitedRun run(limits_of(search, nullptr));
  ProgressLine line;
  command.options.progress = [&line](double lower, std::optional<double> upper) { line.show(factor_line(lower, upper)); };
  const analyze::ToleranceFactor found =
      analyze::tolerance_factor(command.load(), command.ball(), command.options, search, run.control());
  line.clear();
  if (command.json.say([&] { return to_json(found); })) fmt::print("{}", result::printable(to_table(found)));
  return found.complete ? kDone : kIncomplete;
}

}  // namespace

void add_tolerance(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "tolerance",
      "Find by which factor all tolerances may grow, while every robot within them keeps its distance "
      "or its aspects");
  const auto command = std::make_shared<ToleranceCommand>();
  command->add_options(*sub);
  sub->add_option("--keep", command->keep,
                  "What every robot keeps: the clearance, as corank clearance has it, is R at least; or the numbers of "
                  "aspects,\nassembly modes and working modes of the robot as drawn")
      ->type_name("clearance>=R|aspects")
      ->required();
  sub->add_option("--precision", command->options.precision,
                  "End when the bounds of the factor are this close, relative to it")
      ->check(CLI::Range(1e-6, 0.9))
      ->capture_default_str();
  command->json.add(*sub);
  sub->footer(
      "For a factor s, the tolerance [a, b] of a constant with the nominal value v becomes [v + s (a - v), v + s (b - v)].\n"
      "Both bounds are proven: each robot within the lower one keeps the clearance, and some robot within the upper one\n"
      "does not. Of aspects there may be a gap between the bounds, in which neither can be proven.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 the bounds hold, but are not as close as asked for.\n\n"
      "Example: how far off may the lengths of a five-bar robot be, if no singularity is to come nearer than 0.15?\n"
      "  corank tolerance models/dextar.cuik -D \"l=0.9±0.001\" -D \"d=1.18±0.001\" --keep \"clearance>=0.15\"\\\n"
      "      --at J3x=0.5,J3y=1 --in J3x,J3y\n"
      "And how far, if it is to keep the number of its aspects?\n"
      "  corank tolerance models/dextar.cuik -D \"l2=0.9±0.001\" --keep aspects");
  sub->callback([command, &action] { action = [command] { return find_factor(*command); }; });
}

}  // namespace corank::app
