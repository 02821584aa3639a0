// corank clearance --map: the clearance over a grid of centres, as a table or a picture.
#include "corank/analyze/clearance_map.h"

#include <fmt/format.h>

#include "corank/app/box_files.h"
#include "corank/app/clearance_command.h"
#include "corank/app/limited_run.h"
#include "corank/app/output.h"
#include "corank/app/progress.h"
#include "corank/report/heat_map.h"
#include "corank/result/printable.h"
#include "corank/result/result_file.h"

namespace corank::app {
namespace {

// The lower bounds that hold all over the cells, where the robot has, or may have, configurations.
report::HeatMap picture(const analyze::ClearanceMap& map) {
  const analyze::MapCell* best = map.best();
  report::HeatMap result;
  result.title = map.ball.question.model.name() + ", " + symbolic::definition(map.ball.question.set).name;
  result.x_name = map.names[0], result.y_name = map.names[1], result.value_name = "clearance, proven for the whole cell";
  result.x_range = map.region[0], result.y_range = map.region[1];
  for (const analyze::MapCell& c : map.cells)
    if (!map.empty && c.robot != analyze::MapCell::Robot::nowhere)
      result.cells.push_back({c.sides[0], c.sides[1], c.cell_lower});
  if (best)
    result.mark = {best->middle[0], best->middle[1],
                   fmt::format("centre of the largest ball about a node: ({:.4g}, {:.4g}), radius at least {:.4g}",
                               best->middle[0], best->middle[1], best->lower)};
  return result;
}

}  // namespace

ExitStatus run_map(ClearanceCommand command) {
  command.json.give_back(command.question.file);
  const auto is = [&](const char* end) { return command.output.ends_with(end); };
  if (!is(".svg") && !is(".csv") && !is(".json"))
    throw UsageError(fmt::format("-o {}: expected a file name that ends in .svg, .csv or .json", command.output));
  const solve::Options search = options_of(command);
  search.validate();
  LimitedRun run(limits_of(search, nullptr));
  solve::Control& control = run.control();
  const analyze::BallOptions ball = ball_of(command);
  const study::Question question = question_of(command);
  const std::vector<analyze::NamedRange> region = region_of(command.map, "--map", question);
  check_output(command.output);
  command.json.check();
  ProgressLine line;
  analyze::MapOptions options{.grid = command.grid, .precision = command.precision};
  options.progress = [&line](std::size_t done, std::size_t all) { line.show(fmt::format("{} of {} cells", done, all)); };
  const analyze::ClearanceMap map = analyze::clearance_map(question, ball, region, options, search, control);
  line.clear();
  result::write_text(command.output, is(".svg") ? to_svg(picture(map)) : is(".csv") ? to_csv(map) : to_json(map) + "\n");
  if (command.json.say([&] { return to_json(map); })) {
    if (map.empty) fmt::print("it is proven that there is no singularity in the ranges\n");
    fmt::print("{} cells, {} boxes processed, {:.3f} s: {}\n", map.cells.size(), map.processed, map.seconds,
               result::printable(command.output));
  }
  if (map.complete) return kDone;
  fmt::print(stderr, "corank: some cells were not examined{}; the bounds of the others hold\n", ending_words(control));
  return kIncomplete;
}

}  // namespace corank::app
