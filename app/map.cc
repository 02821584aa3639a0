// corank map: a number over a plane of two constants or coordinates.
#include "corank/analyze/maps/parameter_map.h"
#include "corank/analyze/postures/posture_map.h"
#include "corank/app/subcommands.h"
#include "corank/report/pictures/parameter_picture.h"
#include "corank/report/pictures/portrait.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::app {
namespace {

struct MapCommand {
  QuestionOptions question;
  std::vector<std::string> over, fixed;
  OrientationOptions orientation;
  std::string count = "solutions";
  analyze::ParameterMapOptions options{.resolution = 64, .boundary = true, .threads = 0, .progress = {}};
  bool no_boundary = false;
  double time_limit = 0;
  std::vector<std::string> outputs;
  JsonOption json;
};

symbolic::Parameter parameter(const std::string& text) {
  const std::string expected = "NAME=FROM:TO";
  const auto [name, ends] = split_at_equals(text, "--over", expected);
  const std::size_t colon = ends.find(':');
  if (colon == 0 || colon == std::string::npos || colon + 1 == ends.size())
    throw UsageError(fmt::format("--over {}: expected {}", text, expected));
  const auto end = [&name = name](const std::string& part) { return symbolic::parse_expression(part, "--over " + name); };
  return {name, end(ends.substr(0, colon)), end(ends.substr(colon + 1))};
}

symbolic::FixedCoordinate fixed(const std::string& text) {
  const auto [name, value] = split_at_equals(text, "--fix", "NAME=EXPR");
  return {name, symbolic::parse_expression(value, "--fix " + name)};
}

analyze::MapQuestion question_of(const MapCommand& command) {
  analyze::MapQuestion question;
  question.question = load(command.question);
  question.answer = *analyze::map_answer_from_string(command.count);
  QuestionOptions set = command.question;
  set.require.clear();  // asked of each solution, whatever the set is
  const bool plain = question.question.model.is_plain_system();
  if (question.answer != analyze::MapAnswer::solutions && !set.set.empty())
    throw UsageError(fmt::format("--count {}: counts among all configurations; expected no --set beside it", command.count));
  if (set.set.empty() && !plain) set.set = "cspace";
  question.question.set = chosen_set(set, question.question.model);
  for (const std::string& text : command.over) question.over.push_back(parameter(text));
  for (const std::string& text : command.fixed) question.fixed.push_back(fixed(text));
  const std::optional<analyze::Rotation> orientation = command.orientation.rotation();
  if (!orientation) return question;
  return analyze::posture_map(question.question, std::move(question.over), question.fixed, *orientation,
                              command.orientation.of);
}

report::ParameterPicture picture(const analyze::ParameterMap& map) {
  report::ParameterPicture result;
  result.title = map.model;
  result.what = map.answer == analyze::MapAnswer::solutions ? map.set : analyze::to_string(map.answer);
  result.x_name = map.names[0], result.y_name = map.names[1];
  result.x_range = map.region[0], result.y_range = map.region[1];
  using Kind = analyze::MapCellAnswer::Kind;
  if (!map.require.empty()) {
    result.what = map.require.size() == 1 ? map.require[0] : result::counted(map.require.size(), "requirement");
    result.words = {"no solution", "violated by one solution at least", "satisfied by every solution"};
  }
  for (const analyze::MapCellAnswer& c : map.cells) {
    std::optional<int> number = c.kind == Kind::proven ? c.count : c.at_centre;
    if (!map.require.empty()) {
      number.reset();
      if (c.standing == Standing::satisfied) number = 2;
      if (c.standing == Standing::violated) number = 1;
      if (c.count == 0) number = 0;
    }
    result.cells.push_back({c.sides[0], c.sides[1], number, c.kind == Kind::proven && number.has_value()});
  }
  for (const analyze::MapBoundaryBox& b : map.boundary) result.boundary.push_back({b.sides[0], b.sides[1], b.proven});
  if (map.critical) {
    for (const auto& c : map.critical->cusps) result.cusps.push_back({c.sides[0], c.sides[1], c.proven});
    for (const auto& n : map.critical->nodes) result.nodes.push_back({n.sides[0], n.sides[1], n.proven});
  }
  return result;
}

ExitStatus write_map(const CLI::App& sub, MapCommand command) {
  if (!command.orientation.turns.empty())
    refuse_without_effect(sub, {"--set", "--kernel", "--corank", "--require", "--cusps"}, "no --orientation beside it");
  if (command.count != "solutions")
    refuse_without_effect(sub, {"--no-boundary", "--require", "--orientation", "--cusps"}, "--count solutions");
  command.json.begin(command.question.file);
  const int n = command.options.resolution;
  if (n < analyze::kTiles || n > 1024 || (n & (n - 1)) != 0)
    throw UsageError(fmt::format("--resolution {}: expected a power of two from {} to 1024", n, analyze::kTiles));
  for (const std::string& name : command.outputs) {
    const bool certificate = name.ends_with(".h5");
    const bool known = certificate || name.ends_with(".json") || name.ends_with(".csv") || report::is_portrait_format(name);
    if (!known)
      throw UsageError(fmt::format("-o {}: expected a file name that ends in .h5, .svg, .pdf, .png, .csv or .json", name));
    if (certificate && command.count != "solutions")
      throw UsageError(
          fmt::format("-o {}: --count {} is proven only at the centres of cells; there is no certificate for that", name,
                      command.count));
    command.options.certificate = command.options.certificate || certificate;
    result::check_writable(name);
  }
  command.options.boundary = !command.no_boundary;
  LimitedRun run({.time = command.time_limit});
  solve::Control& control = run.control();
  const analyze::MapQuestion question = question_of(command);
  if (question.over.size() != 2) throw UsageError("a map has two parameters; expected --over NAME=FROM:TO twice");
  ProgressLine line;
  command.options.progress = [&line](std::size_t done, std::size_t all) {
    line.show(fmt::format("{} of {} parts of the plane", done, all));
  };
  const analyze::ParameterMap map = analyze::parameter_map(question, command.options, control);
  line.clear();
  for (const std::string& name : command.outputs) {
    if (name.ends_with(".h5")) {
      result::write_map(name, to_file(question, map), [&control] { return control.ended(); });
    } else if (name.ends_with(".json")) {
      result::write_text(name, to_json(map) + "\n");
    } else if (name.ends_with(".csv")) {
      result::write_text(name, to_csv(map));
    } else {
      report::write_picture(name, picture(map));
    }
  }
  if (command.json.say([&] { return to_json(map); })) fmt::print("{}", result::printable(to_table(map)));
  return map.complete ? kDone : stopped_early(map.stopped);
}

}  // namespace

void add_map(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "map", "Count solutions over a plane of two constants or coordinates, and prove the number cell by cell");
  const auto command = std::make_shared<MapCommand>();
  command->question.add_options(*sub, "Which configurations of a mechanism",
                                "Each cell is proven to satisfy or to violate them, or left open");
  sub->add_option("--over", command->over,
                  "A constant or a coordinate (angles in radians) that runs from FROM to TO; required twice")
      ->type_name("NAME=FROM:TO")
      ->allow_extra_args(false);
  sub->add_option("--fix", command->fixed, "A coordinate that keeps one value; may be repeated")
      ->type_name("NAME=EXPR")
      ->allow_extra_args(false);
  command->orientation.add_options(
      *sub,
      "Count the postures of an arm of six revolute joints whose hand has this orientation, such as\n"
      "Rz(0.2)*Ry(10deg); two components of its position run, the third one is fixed");
  sub->add_option("--count", command->count,
                  "What to count. solutions: those of --set (default: cspace), proven over whole cells; the others:\n"
                  "pieces among all configurations of one mechanism, proven only at the centres of cells")
      ->check(CLI::IsMember({"solutions", "components", "aspects", "assembly-modes", "working-modes"}))
      ->capture_default_str();
  sub->add_option("--resolution", command->options.resolution,
                  "Number of the narrowest cells along each side: a power of two")
      ->capture_default_str();
  sub->add_flag("--no-boundary", command->no_boundary, "Do not look for the curve on which two solutions meet");
  sub->add_flag("--cusps", command->options.cusps,
                "Over both outputs or both inputs of a mechanism of two degrees of freedom, all lengths: find the cusps\n"
                "and nodes of the curve on which two solutions meet, and the number of aspects");
  add_analysis_limits(*sub, command->options.threads, command->time_limit);
  sub->add_option(
         "-o", command->outputs,
         "A picture (.svg, .pdf, .png), the cells (.csv, .json), or the proven cells with their proofs for corank verify\n"
         "(.h5); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->json.add(*sub);
  sub->footer(
      "In a proven cell, the number of solutions is the same for every value of the parameters, and every solution is\n"
      "regular.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 stopped by a limit or an interrupt.\n\n"
      "Examples: the assembly modes of a five-bar robot over its motors' angles, and over two lengths\n"
      "  corank map models/dextar.cuik --over theta2=-pi:pi --over theta5=-pi:pi -o modes.svg\n"
      "  corank map models/dextar.cuik --over l2=1/2:3/2 --over l3=1/2:3/2\\\n"
      "      --fix theta2=pi/3 --fix theta5=2 -o lengths.svg\n"
      "  corank map models/dextar.cuik --over theta2=-pi:pi --over theta5=-pi:pi -o modes.h5\n"
      "  corank verify modes.h5\n\n"
      "The postures of an arm of six joints over a plane of its hand's positions\n"
      "  corank map arm.cuik --over tool_x=-1:1 --over tool_z=-1:1 --fix tool_y=0.2 --orientation \"Rz(0.3)\"");
  sub->callback([command, sub, &action] { action = [command, sub] { return write_map(*sub, *command); }; });
}

}  // namespace corank::app
