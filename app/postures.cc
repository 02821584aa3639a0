// corank postures: all configurations in which some coordinates have given values.
#include "corank/analyze/postures/postures.h"

#include "corank/analyze/postures/posture_table.h"
#include "corank/app/subcommands.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::app {
namespace {

struct PosturesCommand {
  QuestionOptions question;
  std::vector<std::string> at;
  OrientationOptions orientation;
  std::string table, output, against;
  double within = 1e-6;
  int threads = 0;
  double time_limit = 0;
  JsonOption json;
};

// --table: of each of its poses.
ExitStatus find_postures_of_table(const PosturesCommand& command) {
  if (!command.output.empty() && !command.output.ends_with(".csv"))
    throw UsageError(fmt::format("-o {}: expected a file name that ends in .csv", command.output));
  if (!command.output.empty()) result::check_writable(command.output);
  LimitedRun run({.time = command.time_limit});
  const analyze::Table poses = analyze::parse_table(symbolic::read_text(command.table), command.table);
  std::optional<analyze::Table> others;
  if (!command.against.empty()) others = analyze::parse_table(symbolic::read_text(command.against), command.against);
  const analyze::PostureFinder finder(analyze::question_of(poses, load(command.question), command.orientation.of));
  ProgressLine line;
  const std::vector<analyze::Postures> found =
      analyze::find_all(finder, analyze::rows_of(poses, command.table), command.threads, run.control(),
                        [&line](std::size_t done, std::size_t all) { line.show(fmt::format("{} of {} poses", done, all)); });
  line.clear();
  std::optional<analyze::Comparison> comparison;
  if (others) comparison = analyze::compare(finder, found, *others, command.against, command.within);
  const analyze::Comparison* const compared = comparison ? &*comparison : nullptr;
  if (!command.output.empty()) result::write_text(command.output, to_csv(finder, found));
  if (command.json.say([&] { return to_json(finder, found, compared); }))
    fmt::print("{}", result::printable(to_table(finder, found, compared)));
  const std::string stopped = analyze::stopped_by(found);
  return stopped.empty() ? kDone : stopped_early(stopped);
}

ExitStatus find_postures(const CLI::App& sub, PosturesCommand command) {
  command.json.begin(command.question.file);
  if (!command.table.empty()) {
    refuse_without_effect(sub, {"--at", "--orientation"}, "no --table beside it");
    return find_postures_of_table(command);
  }
  refuse_without_effect(sub, {"--output", "--against", "--within"}, "--table beside it");
  if (command.at.empty() && command.orientation.turns.empty())
    throw UsageError("--at is required; corank postures --help tells more");
  LimitedRun run({.time = command.time_limit});
  std::vector<symbolic::Expression> values;
  analyze::PostureQuestion question{.question = load(command.question), .given = {}};
  for (analyze::NamedValue& v : named_values(command.at, "--at")) {
    question.given.push_back(v.name);
    values.push_back(std::move(v.value));
  }
  const std::optional<analyze::Rotation> orientation = command.orientation.rotation();
  question.orientation = orientation.has_value();
  question.orientation_of = command.orientation.of;
  ProgressLine line;
  line.follow(run.control());
  const analyze::PostureFinder finder(std::move(question));
  const analyze::Postures found = finder.find(values, orientation, run.control(), command.threads);
  line.clear();
  if (command.json.say([&] { return to_json(finder, found); })) fmt::print("{}", result::printable(to_table(finder, found)));
  return found.complete ? kDone : stopped_early(found.stopped);
}

}  // namespace

void add_postures(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "postures", "Find all configurations in which some coordinates have given values, such as those of an arm at a pose");
  const auto command = std::make_shared<PosturesCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  add_option(*sub, "--at NAME=VALUE,...", command->at,
             "The values: of a pose's position, or of motors; a VALUE may use the model's constants, and 15deg is an\n"
             "angle in degrees");
  command->orientation.add_options(*sub, "The orientation of a link that is an output, such as Rz(0.2)*Ry(10deg)*Rx(0.3)");
  add_option(*sub, "--table FILE.csv", command->table,
             "Find the postures for each line of this file: numbers, separated by commas, under a line with the names\n"
             "of coordinates, and qw, qx, qy, qz for an orientation as a quaternion")
      ->check(CLI::ExistingFile);
  add_option(*sub, "-o,--output FILE", command->output, "Write the postures of the table's poses to this file (.csv)");
  add_option(*sub, "--against FILE.csv", command->against,
             "Compare somebody else's solutions with those that are proven: a table with the column pose, the number of\n"
             "the pose from 1, and one for each joint (in radians)")
      ->check(CLI::ExistingFile);
  sub->add_option("--within", command->within, "How far apart two solutions may be in each joint to count as the same")
      ->check(positive())
      ->capture_default_str();
  add_analysis_limits(*sub, command->threads, command->time_limit);
  command->json.add(*sub);
  sub->footer(
      "Each posture that is listed is proven to exist. Where it says so, it is proven that there are no others within the\n"
      "ranges of the model.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 stopped by a limit or an interrupt.\n\n"
      "Examples: the poses of a five-bar robot for two angles of its motors, an arm at a pose, and at many\n"
      "  corank postures models/dextar.cuik --at theta2=90deg,theta5=2\n"
      "  corank postures arm.cuik --at tool_x=0.4,tool_y=0.2,tool_z=0.5 --orientation \"Rz(0.3)*Ry(40deg)\"\n"
      "  corank postures arm.cuik --table poses.csv -o postures.csv --against mine.csv");
  sub->callback([command, sub, &action] { action = [command, sub] { return find_postures(*sub, *command); }; });
}

}  // namespace corank::app
