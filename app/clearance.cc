// corank clearance: the largest ball without a singularity about a configuration, about the best centre, over a map.

#include <algorithm>
#include <filesystem>

#include "corank/analyze/clearance/best_center.h"
#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/clearance/clearance_map.h"
#include "corank/analyze/paths/path.h"
#include "corank/app/ball_command.h"
#include "corank/app/box_files.h"
#include "corank/app/subcommands.h"
#include "corank/report/pictures/heat_map.h"

namespace corank::app {
namespace {

struct ClearanceCommand : BallCommand {
  std::vector<std::string> best, map;
  std::string proof_stem, output;
  double precision = 0.01;
  int grid = 24;
  JsonOption json;
};

// What the three questions have in common.
struct ClearanceRun {
  explicit ClearanceRun(const ClearanceCommand& command)
      : search(command.search()), run(limits_of(search, nullptr)), ball(command.ball()), question(command.load()) {}

  solve::Control& control() { return run.control(); }

  const solve::Options search;
  LimitedRun run;
  const analyze::BallOptions ball;
  const study::Question question;
  ProgressLine line;
};

auto shown_radius(ProgressLine& line, const char* what) {
  return [&line, what](double lower, std::optional<double> upper, std::uint64_t count) {
    line.show(analyze::progress_text(lower, upper, count, what));
  };
}

// "x=[a,b]", "y=[c,d]"; for --map "x", "y" as well, the declared ranges.
std::vector<analyze::NamedRange> region_of(const std::vector<std::string>& texts, const std::string& option,
                                           const study::Question& question) {
  const std::vector<std::string> parts = parts_of(texts);
  if (option == "--map" && std::ranges::none_of(parts, [](const auto& p) { return p.find('=') != p.npos; }))
    return analyze::declared_ranges(question, parts);
  std::vector<analyze::NamedRange> region;
  for (const std::string& part : parts) region.push_back(range_of(part, {}, option));
  return region;
}

ExitStatus say(const ClearanceCommand& command, const analyze::Clearance& clearance) {
  if (command.json.say([&] { return to_json(clearance); })) fmt::print("{}", result::printable(to_table(clearance)));
  return clearance.nearest.complete ? kDone : not_close(clearance.stopped);
}

std::string free_file(const ClearanceCommand& command) { return command.proof_stem + "-free.h5"; }
std::string nearest_file(const ClearanceCommand& command) { return command.proof_stem + "-nearest.h5"; }

// Writes what corank verify checks. False: not all of it could be proven again in that form.
bool write_claims(const ClearanceCommand& command, const analyze::Clearance& clearance, const solve::Options& search,
                  solve::Control& control) {
  if (command.proof_stem.empty()) return true;
  const result::Result free = claim_free(clearance, search, control);
  result::write_result(free_file(command), free);
  const bool is_free = free.cover.complete() && free.cover.boxes.empty();
  if (!is_free)
    fmt::print(stderr, "corank: {}: does not prove the lower bound, since boxes are left{}\n", free_file(command),
               ending_words(control));
  if (!clearance.nearest.upper) return is_free;
  std::filesystem::remove(nearest_file(command));  // of a former run
  const auto nearest = claim_nearest(clearance, control);
  if (nearest) result::write_result(nearest_file(command), *nearest);
  if (!nearest)
    fmt::print(stderr, "corank: {}: not written, since the nearest configuration could not be proven again{}\n",
               nearest_file(command), ending_words(control));
  return is_free && nearest;
}

// Of the configurations with the values of --at, where these leave no motion: do they meet the requirements?
std::vector<Standing> postures_of(ClearanceRun& run) {
  std::vector<Standing> result;
  if (!symbolic::definition(run.question.set).of_requirements || !run.question.model.toleranced().empty()) return result;
  try {
    const analyze::PathFinder finder(run.question, {.avoid = analyze::Avoid::requirements});
    for (const Box& box : finder.ends(run.ball.at, run.control())) result.push_back(finder.standing(box));
  } catch (const analyze::EndError&) {
  } catch (const symbolic::ModelError&) {  // a path finder takes no sines of lengths, a ball does
  }
  return result;
}

ExitStatus run_clearance(ClearanceCommand command) {
  command.require_center("except with --best or --map");
  command.json.begin(command.question.file);
  ClearanceRun run(command);
  if (!command.proof_stem.empty()) {
    check_output(free_file(command));
    check_output(nearest_file(command));
  }
  const analyze::ClearanceOptions options{.precision = command.precision, .progress = shown_radius(run.line, "boxes")};
  analyze::Clearance clearance = analyze::clearance(run.question, run.ball, options, run.search, run.control());
  clearance.postures = postures_of(run);
  run.line.show("writing what corank verify checks");
  const bool proven = write_claims(command, clearance, run.search, run.control());
  if (!proven) clearance.stopped = stopped_by(run.control());
  run.line.clear();
  const ExitStatus status = say(command, clearance);
  return proven ? status : kIncomplete;
}

// --best: the centre of the largest ball in a region.
ExitStatus run_best(ClearanceCommand command) {
  command.json.begin(command.question.file);
  ClearanceRun run(command);
  const std::vector<analyze::NamedRange> region = region_of(command.best, "--best", run.question);
  const analyze::BestOptions options{.precision = command.precision, .progress = shown_radius(run.line, "cells")};
  const analyze::Best best = analyze::best_center(run.question, run.ball, region, options, run.search, run.control());
  run.line.clear();
  if (command.json.say([&] { return to_json(best); })) fmt::print("{}", result::printable(to_table(best)));
  return best.complete ? kDone : not_close(best.stopped);
}

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

// --map: the clearance over a grid of centres, as a table or a picture.
ExitStatus run_map(ClearanceCommand command) {
  command.json.begin(command.question.file);
  const auto is = [&](const char* end) { return command.output.ends_with(end); };
  if (!is(".svg") && !is(".csv") && !is(".json"))
    throw UsageError(fmt::format("-o {}: expected a file name that ends in .svg, .csv or .json", command.output));
  ClearanceRun run(command);
  const std::vector<analyze::NamedRange> region = region_of(command.map, "--map", run.question);
  check_output(command.output);
  analyze::MapOptions options{.grid = command.grid, .precision = command.precision};
  options.progress = [&run](std::size_t done, std::size_t all) { run.line.show(fmt::format("{} of {} cells", done, all)); };
  const analyze::ClearanceMap map =
      analyze::clearance_map(run.question, run.ball, region, options, run.search, run.control());
  run.line.clear();
  result::write_text(command.output, is(".svg") ? to_svg(picture(map)) : is(".csv") ? to_csv(map) : to_json(map) + "\n");
  if (command.json.say([&] { return to_json(map); })) {
    if (map.empty)
      fmt::print("it is proven that the set {} has no configuration in the ranges\n",
                 symbolic::definition(run.question.set).name);
    fmt::print("{} cells, {} boxes processed, {:.3f} s: {}\n{}", map.cells.size(), map.processed, map.seconds,
               result::printable(command.output), analyze::stopped_line(map.stopped));
  }
  if (map.complete) return kDone;
  fmt::print(stderr, "corank: some cells were not examined, stopped by {}; the bounds of the others hold\n", map.stopped);
  return kIncomplete;
}

}  // namespace

void add_clearance(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "clearance",
      "Find how far a point, such as a position of the outputs, is from singularities: the largest ball about "
      "it that holds none");
  const auto command = std::make_shared<ClearanceCommand>();
  command->add_options(*sub, ", required unless --best or --map is given");
  CLI::Option* best =
      add_option(*sub, "--best NAME=[A,B],...", command->best,
                 "Find which centre within these ranges of lengths has the largest ball; without --in, the ball lies in\n"
                 "the coordinates of these ranges");
  CLI::Option* map =
      add_option(
          *sub, "--map NAME,NAME or NAME=[A,B],NAME=[A,B]", command->map,
          "Compute the radius of the ball for the centres in each cell of a grid over two lengths, within the ranges\n"
          "given here or else in the model; the bounds of a cell hold for every centre in it")
          ->excludes(best);
  CLI::Option* output = add_option(*sub, "-o,--output FILE", command->output, "The file for the map: .svg, .csv or .json");
  map->needs(output);
  output->needs(map);
  sub->add_option("--grid", command->grid, "Number of the map's cells along each side")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->needs(map);
  sub->add_option("--precision", command->precision, "End when the bounds of the radius are this close, relative to it")
      ->check(CLI::Range(1e-6, 0.9))
      ->capture_default_str();
  add_option(*sub, "--proof NAME", command->proof_stem,
             "Write two files that corank verify checks: NAME-free.h5 proves that the ball whose radius is the lower bound\n"
             "holds no singularity; NAME-nearest.h5 holds a singularity in the ball whose radius is the upper bound")
      ->excludes(best)
      ->excludes(map);
  command->json.add(*sub);
  sub->footer(
      "Without --set, the ball must not hold forward singularities; with --require, no configurations at which a\n"
      "requirement reaches its limit. A coordinate with a value in --at keeps this value, unless --in names the\n"
      "coordinate or an option gives it a range. All other coordinates may have any value in their ranges. So the ball\n"
      "holds none of these configurations in any assembly or working mode within these ranges.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 the bounds hold, but are not as close as asked for.\n\n"
      "Examples:\n  corank clearance models/dextar.cuik --at J3x=0.5,J3y=1 --in J3x,J3y\n"
      "  corank clearance models/planar/3rpr.cuik --at pose_x=0.8,pose_y=0.5,pose_phi=0.1\\\n"
      "      --in pose_x,pose_y --orientation-range 15deg\n"
      "  corank clearance models/dextar.cuik --best J3x=[0,1],J3y=[0,1.5]\n"
      "  corank clearance models/dextar.cuik --map J3x,J3y -o map.svg");
  sub->callback([command, &action] {
    action = [command] {
      if (!command->map.empty()) return run_map(*command);
      return command->best.empty() ? run_clearance(*command) : run_best(*command);
    };
  });
}

}  // namespace corank::app
