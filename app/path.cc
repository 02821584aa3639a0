// corank path: a way between two configurations without a singularity, as a tube that is proven.
#include "corank/analyze/paths/path.h"

#include <filesystem>

#include "corank/app/box_files.h"
#include "corank/app/path_report.h"
#include "corank/app/subcommands.h"
#include "corank/result/values/claim_files.h"

namespace corank::app {
namespace {

struct PathCommand {
  QuestionOptions question;
  std::vector<std::string> from, to;
  int from_mode = 0, to_mode = 0;
  std::string avoid, csv, output, report;
  analyze::PathOptions options;
  double time_limit = 0;
  JsonOption json;

  /// What a user types for the same path.
  std::string line() const;
};

std::string PathCommand::line() const {
  std::string text = question.command_line("path");
  const auto add_end = [&](const std::string& name, const std::vector<std::string>& values, int mode) {
    text += fmt::format(" {} {}", name, fmt::join(values, ","));
    if (mode > 0) text += fmt::format(" {}-mode {}", name, mode);
  };
  add_end("--from", from, from_mode);
  add_end("--to", to, to_mode);
  if (avoid != (question.require.empty() ? "forward" : "requirements")) text += " --avoid " + avoid;
  if (options.radius > 0) text += fmt::format(" --radius {:g}", options.radius);
  if (!output.empty()) text += " -o " + std::filesystem::path(output).filename().string();
  return text;
}

ExitStatus path(PathCommand command) {
  if (command.avoid.empty()) command.avoid = command.question.require.empty() ? "forward" : "requirements";
  command.json.begin(command.question.file);
  if (!command.question.require.empty() && command.avoid != "requirements")
    throw UsageError("--require: without effect; expected --avoid requirements, or no --avoid");
  LimitedRun run({.time = command.time_limit});
  solve::Control& control = run.control();
  const study::Question question = load(command.question);
  if (question.model.is_plain_system())
    throw UsageError(
        fmt::format("{} names no inputs and outputs: a plain system has no singularities to avoid", command.question.file));
  const auto from = named_values(command.from, "--from"), to = named_values(command.to, "--to");
  command.options.avoid = *analyze::avoid_from_string(command.avoid);
  check_output(command.csv);
  check_output(command.output);
  check_output(command.report);
  ProgressLine line;
  line.follow(control);
  analyze::PathFinder finder(question, command.options);
  std::vector<Box> boxes;
  try {
    boxes = {finder.end(from, command.from_mode, "--from", control), finder.end(to, command.to_mode, "--to", control)};
  } catch (const analyze::EndError& error) {
    line.clear();
    const std::string what = error.what(), stopped = stopped_by(control);
    fmt::print(stderr, "corank: {}\n", result::printable(what));
    if (stopped.empty()) return kBadInput;
    if (what.find(stopped) == what.npos) fmt::print(stderr, "corank: stopped by {}\n", stopped);
    return kIncomplete;
  }
  const analyze::Path found = finder.find(boxes[0], boxes[1], control);
  line.clear();
  if (!command.csv.empty()) result::write_text(command.csv, to_csv(finder, found));
  if (!command.output.empty()) {
    if (found.tube)
      result::write_path(command.output, analyze::to_file(finder, found));
    else
      fmt::print(stderr, "corank: {}: not written, since it would hold a path\n", result::printable(command.output));
  }
  if (!command.report.empty())
    write_path_page(command.report, question, report::path_view(finder, found), command.line(),
                    found.tube ? command.output : "", command.options.threads, control);
  if (command.json.say([&] { return to_json(finder, found); })) fmt::print("{}", result::printable(to_text(finder, found)));
  if (found.status == analyze::Path::Status::unknown)
    return found.stopped.empty() ? kIncomplete : stopped_early(found.stopped);
  if (!found.stopped.empty())
    fmt::print(stderr, "corank: what is said is proven, stopped by {}; the path might keep farther away\n", found.stopped);
  return kDone;
}

}  // namespace

void add_path(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "path",
      "Find a path between two configurations that meets no singularity of the kind that --avoid names, and "
      "prove it");
  const auto command = std::make_shared<PathCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  const auto add_end = [&](const std::string& name, std::vector<std::string>& values, int& mode) {
    sub->add_option(name, values,
                    std::string(name == "--from" ? "The start" : "The goal") +
                        ": values of as many coordinates as the mobility says; corank solves for the others. If there are "
                        "several solutions, further values choose among them. 15deg is an angle in degrees")
        ->type_name("NAME=VALUE,...")
        ->allow_extra_args(false)
        ->required();
    sub->add_option(name + "-mode", mode,
                    "Which solution to take, by its number, if there are several; without it, corank lists them and ends")
        ->check(positive());
  };
  add_end("--from", command->from, command->from_mode);
  add_end("--to", command->to, command->to_mode);
  sub->add_option(
         "--avoid", command->avoid,
         "The singularities that the path avoids, or requirements: the configurations at which one of them reaches\n"
         "its limit; default: forward, with --require requirements")
      ->check(CLI::IsMember({"forward", "inverse", "both", "requirements"}));
  command->question.add_require(*sub, "Then the path keeps from their limits");
  sub->add_option("--radius", command->options.radius,
                  "Look for a path with this radius of sines and cosines (see below); if none is found, take one with a\n"
                  "smaller radius; default: 0")
      ->check(not_negative());
  add_threads(*sub, command->options.threads);
  add_option(*sub, "--max-boxes N", command->options.max_boxes,
             "Enclose C-space in at most N boxes when looking for the path")
      ->check(positive())
      ->capture_default_str();
  add_time_limit(*sub, command->time_limit, "End after SECONDS");
  add_option(*sub, "-o,--output FILE.h5", command->output,
             "Write the path, if there is one, with the tube (the boxes that prove it), for corank verify");
  add_option(*sub, "--csv FILE", command->csv, "Write the waypoints of the path");
  add_option(*sub, "--report FILE.html", command->report, "Write an HTML page on which the mechanism moves along the path");
  command->json.add(*sub);
  sub->footer(
      "The path keeps to the ranges, limits and inequalities of the model. With the path corank prints two radii: one for\n"
      "sines and cosines of angles, and one for lengths, which is the first one times the typical size of the robot's\n"
      "lengths. Take a configuration and a point of the path. If each sine and cosine differs by at most the first radius,\n"
      "and each length by at most the second, it is proven that the configuration is not one of the singularities that the\n"
      "path avoids. If no path exists, because singularities separate the two configurations, corank may prove that\n"
      "instead. If it finds neither a path nor such a proof, it says so.\n\n"
      "Exit status: 0 a path, or the proof that there is none; 1 bad input; 2 wrong usage; 3 neither.\n\n"
      "Examples:\n  corank path models/dextar.cuik --from J3x=0.5,J3y=1 --from-mode 1 --to J3x=0.7,J3y=1 --to-mode 1\\\n"
      "      -o path.h5 --report path.html\n  corank verify path.h5");
  sub->callback([command, &action] { action = [command] { return path(*command); }; });
}

}  // namespace corank::app
