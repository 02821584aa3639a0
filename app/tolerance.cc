// corank tolerance: by which factor all tolerances may grow.
#include <cmath>
#include <optional>

#include "corank/analyze/aspects/aspects_factor.h"
#include "corank/analyze/clearance/tolerance_factor.h"
#include "corank/analyze/paths/path_factor.h"
#include "corank/app/ball_command.h"
#include "corank/app/subcommands.h"
#include "corank/result/values/claim_files.h"

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
  double radius = 0;
  if (!text.starts_with(start) || !CLI::detail::lexical_cast(text.substr(start.size()), radius) || !(radius > 0) ||
      !std::isfinite(radius))
    throw UsageError(
        fmt::format("--keep {}: expected \"clearance>=R\" with a positive number R, \"aspects\", or \"path FILE\"", keep));
  return radius;
}

// Of what asks for no ball: `find` makes the factor from a question, a precision and progress.
template <class Find>
ExitStatus find_without_ball(const ToleranceCommand& command, const std::string& what, bool with_requirements, Find find) {
  for (const auto& [given, name] :
       {std::pair(!command.at.empty(), "--at"), std::pair(!command.in.empty(), "--in"),
        std::pair(!command.ranges.empty(), "--range"), std::pair(!command.question.set.empty(), "--set"),
        std::pair(!with_requirements && !command.question.require.empty(), "--require")})
    if (given) throw UsageError(fmt::format("{}: without effect beside --keep {}", name, what));
  const solve::Options search = command.search();
  LimitedRun run(limits_of(search, nullptr));
  ProgressLine line;
  const study::Question question = app::load(command.question);
  if (question.model.is_plain_system())
    throw UsageError(fmt::format("{} names no inputs and outputs: a plain system has no {}", command.question.file, what));
  const analyze::FactorProgress progress = [&line](double lower, std::optional<double> upper) {
    line.show(analyze::factor_words(lower, upper));
  };
  const auto found = find(question, progress, search.threads, run.control());
  line.clear();
  if (command.json.say([&] { return to_json(question, found); }))
    fmt::print("{}", result::printable(to_table(question, found)));
  return found.complete() ? kDone : not_close(found.stopped);
}

ExitStatus find_aspects_factor(const ToleranceCommand& command) {
  return find_without_ball(
      command, "aspects", true, [&](const auto& question, const auto& progress, int threads, auto& control) {
        return analyze::aspects_factor(
            question, {.precision = command.options.precision, .threads = threads, .progress = progress}, control);
      });
}

ExitStatus find_path_factor(const ToleranceCommand& command, const std::string& file) {
  const result::PathFile path = result::read_path(file);
  return find_without_ball(
      command, "path", path.avoid == "requirements", [&](const auto& question, const auto& progress, int, auto& control) {
        return analyze::path_factor(question, path, {.precision = command.options.precision, .progress = progress}, control);
      });
}

ExitStatus find_factor(ToleranceCommand command) {
  command.json.begin(command.question.file);
  if (command.keep == "aspects") return find_aspects_factor(command);
  if (command.keep.starts_with("path ")) return find_path_factor(command, command.keep.substr(5));
  command.options.radius = radius_of(command.keep);
  command.require_center();
  const solve::Options search = command.search();
  LimitedRun run(limits_of(search, nullptr));
  ProgressLine line;
  command.options.progress = [&line](double lower, std::optional<double> upper) {
    line.show(analyze::factor_words(lower, upper));
  };
  const analyze::ToleranceFactor found =
      analyze::tolerance_factor(command.load(), command.ball(), command.options, search, run.control());
  line.clear();
  if (command.json.say([&] { return to_json(found); })) fmt::print("{}", result::printable(to_table(found)));
  return found.complete() ? kDone : not_close(found.stopped);
}

}  // namespace

void add_tolerance(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("tolerance",
                             "Find by which factor all tolerances may grow, while every robot within them keeps its "
                             "distance, its aspects or a path");
  const auto command = std::make_shared<ToleranceCommand>();
  command->add_options(*sub);
  sub->add_option(
         "--keep", command->keep,
         "What every robot keeps: the clearance, as corank clearance has it, is R at least; the numbers of "
         "aspects,\nassembly modes and working modes of the robot as drawn; or the path that corank path has written "
         "to FILE.h5:\neach robot has one of its own through the same sections, as free of singularities")
      ->type_name("clearance>=R|aspects|path FILE.h5")
      ->required();
  sub->add_option("--precision", command->options.precision,
                  "End when the bounds of the factor are this close, relative to it")
      ->check(CLI::Range(1e-6, 0.9))
      ->capture_default_str();
  command->json.add(*sub);
  sub->footer(
      "For a factor s, the tolerance [a, b] of a constant with the nominal value v becomes [v + s (a - v), v + s (b - v)].\n"
      "Both bounds are proven: each robot within the lower one keeps the clearance, and some robot within the upper one\n"
      "does not. Of aspects and paths there may be a gap between the bounds, in which neither can be proven.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 the bounds hold, but are not as close as asked for.\n\n"
      "Example: how far off may the lengths of a five-bar robot be, if no singularity is to come nearer than 0.15?\n"
      "  corank tolerance models/dextar.cuik -D \"l=0.9±0.001\" -D \"d=1.18±0.001\" --keep \"clearance>=0.15\"\\\n"
      "      --at J3x=0.5,J3y=1 --in J3x,J3y\n"
      "And how far, if it is to keep the number of its aspects?\n"
      "  corank tolerance models/dextar.cuik -D \"l2=0.9±0.001\" --keep aspects\n"
      "Or if it is to follow a path?\n"
      "  corank path models/dextar.cuik --from J3x=0.5,J3y=1 --from-mode 1\\\n"
      "      --to J3x=0.7,J3y=-1 --to-mode 2 -o path.h5\n"
      "  corank tolerance models/dextar.cuik -D \"l=0.9±0.001\" -D \"d=1.18±0.001\" --keep \"path path.h5\"");
  sub->callback([command, &action] { action = [command] { return find_factor(*command); }; });
}

}  // namespace corank::app
