// corank cuspidal: does a robot change its posture without a singularity?
#include "corank/analyze/postures/cuspidal.h"

#include <filesystem>

#include "corank/app/box_files.h"
#include "corank/app/path_report.h"
#include "corank/app/subcommands.h"
#include "corank/result/values/claim_files.h"

namespace corank::app {
namespace {

struct CuspidalCommand {
  QuestionOptions question;
  std::string of, output, report;
  analyze::CuspidalOptions options{.threads = 0, .progress = {}};
  double time_limit = 0;
  JsonOption json;

  std::string line() const;
};

// What a user types for the same path.
std::string CuspidalCommand::line() const {
  std::string text = question.command_line("cuspidal");
  if (!of.empty()) text += " --of " + of;
  if (!output.empty()) text += " -o " + std::filesystem::path(output).filename().string();
  return text;
}

// Where nothing was found of the kind of singularities that was chosen for the user.
std::string hint(const CuspidalCommand& command, const analyze::Cuspidality& found) {
  const bool chosen = command.of.empty() && found.of == analyze::Avoid::forward;
  return chosen && !found.cuspidal
             ? "--of inverse asks whether two postures of one pose are joined without inverse singularities\n"
             : "";
}

ExitStatus find_out(CuspidalCommand command) {
  command.json.begin(command.question.file);
  check_output(command.output);
  check_output(command.report);
  if (!command.of.empty()) command.options.of = analyze::avoid_from_string(command.of);
  LimitedRun run({.time = command.time_limit});
  const study::Question question = load(command.question);
  ProgressLine line;
  command.options.progress = [&line](int poses, std::size_t pairs) {
    line.show(fmt::format("{} poses, {} pairs of postures that no sign tells apart", poses, pairs));
  };
  const analyze::Cuspidality found = analyze::cuspidality(question, command.options, run.control());
  line.clear();
  if (found.path && !command.output.empty())
    result::write_path(command.output, analyze::to_file(*found.finder, *found.path));
  if (found.path && !command.report.empty())
    write_path_page(command.report, question, report::cuspidal_view(found), command.line(), command.output,
                    command.options.threads, run.control());
  if (command.json.say([&] { return to_json(found, question.model.name(), command.output); }))
    fmt::print("{}{}", result::printable(to_text(found, question.model.name())), hint(command, found));
  return found.complete ? kDone : stopped_early(found.stopped);
}

}  // namespace

void add_cuspidal(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "cuspidal", "Find out whether a robot can change its posture, at the same pose, without meeting a singularity");
  const auto command = std::make_shared<CuspidalCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  sub->add_option("--of", command->of,
                  "Which singularities are not to be met. inverse: postures of one pose are joined (default for arms);\n"
                  "forward: poses for the same values of the motors (default for robots with loops, or given by equations)")
      ->check(CLI::IsMember({"forward", "inverse"}));
  sub->add_option("--poses", command->options.poses, "How many poses are tried")->check(positive())->capture_default_str();
  add_option(*sub, "-o,--output FILE", command->output, "Write the path, with its proof, for corank verify (.h5)");
  add_option(*sub, "--report FILE.html", command->report,
             "Write an HTML page on which the robot changes its posture, if it is cuspidal");
  add_analysis_limits(*sub, command->options.threads, command->time_limit);
  command->json.add(*sub);
  sub->footer(
      "The proof that a robot is cuspidal is two postures of one pose, and a path between them about which there is no\n"
      "singularity. That it is not is proven for arms with a spherical wrist, or three parallel axes, whose other axes are\n"
      "parallel or perpendicular as in most industrial robots. Else the answer is 'open'.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 stopped by a limit or an interrupt.\n\n"
      "Example:\n  corank cuspidal models/planar/3rpr.cuik -o path.h5 --report path.html\n  corank verify path.h5");
  sub->callback([command, &action] { action = [command] { return find_out(*command); }; });
}

}  // namespace corank::app
