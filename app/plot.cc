// corank plot: the boxes of a result in two or three coordinates, for Geomview.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "corank/app/box_files.h"
#include "corank/app/subcommands.h"
#include "corank/report/gcl.h"
#include "corank/report/result_file.h"

namespace corank::app {
namespace {

struct PlotCommand {
  std::string input, output;
  std::vector<std::string> axes;
  double size = 0;
  std::string color = "plain";
};

ExitStatus plot(const PlotCommand& command) {
  if (std::filesystem::path(command.output).extension() != ".gcl") {
    throw UsageError(
        fmt::format("-o {}: the picture has an unknown format; expected a name that ends in .gcl", command.output));
  }
  if (command.axes.size() < 2 || command.axes.size() > 3) throw UsageError("--axes: expected two or three variables");
  const report::SolFile boxes = read_boxes(command.input);
  if (boxes.boxes.empty()) throw report::ResultFileError(command.input + ": holds no boxes to draw");
  check_output(command.output);
  report::GclOptions options;
  for (const std::string& axis : command.axes) options.axes.push_back(variable_index(boxes, command.input, axis));
  options.size = command.size;
  options.color_by_verdict = command.color == "verdict";
  options.name = std::filesystem::path(command.input).stem().string();
  options.comment =
      fmt::format("corank plot {} --axes {} --size {}", command.input, fmt::join(command.axes, ","), command.size);
  report::write_text(command.output, report::to_gcl(boxes, options));
  return completeness(boxes, command.input);
}

}  // namespace

void add_plot(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("plot", "Draw the boxes of a result in two or three coordinates, for Geomview");
  const auto command = std::make_shared<PlotCommand>();
  sub->add_option("RESULT", command->input, "The boxes (.sol or .h5)")->required();
  sub->add_option("--axes", command->axes, "Two or three variables, by name or number from 1, with commas")
      ->type_name("X,Y[,Z]")
      ->delimiter(',')
      ->required();
  sub->add_option("--size", command->size, "0: boxes as they are; else cubes with this edge about their centres")
      ->check(CLI::Range(0.0, 1e300, "a non-negative number"))
      ->capture_default_str();
  sub->add_option("--color", command->color, "plain: all blue; verdict: a colour for each verdict")
      ->check(CLI::IsMember({"plain", "verdict"}))
      ->capture_default_str();
  sub->add_option("-o", command->output, "The picture")->type_name("PICTURE.gcl")->required();
  sub->footer("Example:\n  corank plot forward.h5 --axes J3x,J3y,c_theta2 -o forward.gcl");
  sub->callback([command, &action] { action = [command] { return plot(*command); }; });
}

}  // namespace corank::app
