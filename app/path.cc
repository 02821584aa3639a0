// corank path: a way between two configurations without a singularity, as a tube that is proven.
#include "corank/analyze/path.h"

#include <fmt/format.h>

#include <memory>

#include "corank/app/box_files.h"
#include "corank/app/interrupt.h"
#include "corank/app/named_values.h"
#include "corank/app/progress.h"
#include "corank/app/question.h"
#include "corank/app/subcommands.h"
#include "corank/result/path_file.h"
#include "corank/result/printable.h"
#include "corank/result/result_file.h"

namespace corank::app {
namespace {

struct PathCommand {
  QuestionOptions question;
  std::vector<std::string> from, to;
  int from_mode = 0, to_mode = 0;
  std::string avoid = "forward", csv, output;
  analyze::PathOptions options;
  double time_limit = 0;
  bool json = false;
};

result::PathFile file_of(const analyze::PathFinder& finder, const analyze::Path& found) {
  const study::Question& question = finder.question();
  result::PathFile file;
  file.model = question.model.name();
  file.model_text = question.model.source_text();
  file.constants = question.constants;
  file.avoid = analyze::to_string(finder.options().avoid);
  for (const Variable& v : finder.system().variables) file.variables.push_back(v.name);
  file.tube = *found.tube;
  return file;
}

ExitStatus path(PathCommand command) {
  solve::Control control({.time = command.time_limit, .stop = &Interrupt::stop()});
  const study::Question question = load(command.question);
  if (question.model.is_plain_system())
    throw UsageError(
        fmt::format("{} names no inputs and outputs: a plain system has no singularities to avoid", command.question.file));
  const auto from = named_values(command.from, "--from"), to = named_values(command.to, "--to");
  command.options.avoid = command.avoid == "forward"   ? analyze::Avoid::forward
                          : command.avoid == "inverse" ? analyze::Avoid::inverse
                                                       : analyze::Avoid::both;
  check_output(command.csv);
  check_output(command.output);
  const Interrupt interrupt;
  ProgressLine line;
  line.follow(control);
  analyze::PathFinder finder(question, command.options);
  std::vector<Box> boxes;
  try {
    boxes = {finder.end(from, command.from_mode, "--from", control), finder.end(to, command.to_mode, "--to", control)};
  } catch (const analyze::EndError& error) {
    line.clear();
    fmt::print(stderr, "corank: {}\n", result::printable(error.what()));
    return control.ended() ? kIncomplete : kBadInput;
  }
  const analyze::Path found = finder.find(boxes[0], boxes[1], control);
  line.clear();
  if (!command.csv.empty()) result::write_text(command.csv, to_csv(finder, found));
  if (!command.output.empty() && found.tube) result::write_path(command.output, file_of(finder, found));
  fmt::print("{}", command.json ? to_json(finder, found) + "\n" : result::printable(to_text(finder, found)));
  return found.status == analyze::Path::Status::unknown ? kIncomplete : kDone;
}

}  // namespace

void add_path(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("path", "A proven way between two configurations that meets no singularity");
  const auto command = std::make_shared<PathCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  const auto add_end = [&](const std::string& name, std::vector<std::string>& values, int& mode) {
    sub->add_option(name, values,
                    "Values of coordinates, as many as the mobility; the rest is solved for, and further values choose "
                    "between\nthe solutions; 15deg is an angle in degrees")
        ->type_name("NAME=VALUE,...")
        ->allow_extra_args(false)
        ->required();
    sub->add_option(name + "-mode", mode, "Which of several solutions: its number in the list that is printed without it")
        ->check(CLI::PositiveNumber);
  };
  add_end("--from", command->from, command->from_mode);
  add_end("--to", command->to, command->to_mode);
  sub->add_option("--avoid", command->avoid, "The singularities that the path avoids")
      ->check(CLI::IsMember({"forward", "inverse", "both"}))
      ->capture_default_str();
  sub->add_option("--radius", command->options.radius, "The clearance that the path is to have, where possible")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--threads", command->options.threads, "Threads of a search; 0: one for each core")
      ->check(CLI::Range(0, solve::kMostThreads))
      ->capture_default_str();
  sub->add_option("--max-boxes", command->options.max_boxes, "No cover of C-space is to have more boxes")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub->add_option("--time-limit", command->time_limit, "End after so many seconds; 0: no limit")
      ->type_name("SECONDS")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("-o,--output", command->output,
                  "Write the path with its tube, which corank verify checks, where there is one")
      ->type_name("FILE.h5");
  sub->add_option("--csv", command->csv, "Write the waypoints")->type_name("FILE");
  sub->add_flag("--json", command->json, "Print the result as JSON");
  sub->footer(
      "The path keeps to the ranges, limits and inequalities of the model. Every configuration within the radius of it, in\n"
      "lengths and in sines and cosines of angles, is proven to be none of the singularities avoided. Where no path can\n"
      "exist, because the ends lie in different pieces, that is proven.\n\n"
      "Exit status: 0 a path or the proof that there is none, 1 bad input, 2 usage, 3 neither.\n\n"
      "Examples:\n  corank path models/dextar.cuik --from J3x=0.5,J3y=1 --from-mode 1 --to J3x=0.7,J3y=1 --to-mode 1\\\n"
      "      -o path.h5\n  corank verify path.h5");
  sub->callback([command, &action] { action = [command] { return path(*command); }; });
}

}  // namespace corank::app
