#include "corank/app/solve_command.h"

#include <fmt/format.h>

#include "corank/core/system.h"

namespace corank::app {
namespace {

CLI::Validator tolerance() {
  const auto check = [](const std::string& text) -> std::string {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= 0 && value < kCoefficientToleranceLimit;
    return good ? "" : fmt::format("{} is not a number from 0 to below {}", text, kCoefficientToleranceLimit);
  };
  return {check, ""};
}

// "90", "90s", "1.5m", "1h".
CLI::Validator seconds() {
  const auto to_seconds = [](std::string& text) -> std::string {
    const std::string given = text;
    double unit = 1;
    if (text.ends_with('s') || text.ends_with('m') || text.ends_with('h')) {
      unit = text.back() == 's' ? 1 : text.back() == 'm' ? 60 : 3600;
      text.pop_back();
    }
    double value = 0;
    if (text.empty() || !CLI::detail::lexical_cast(text, value) || !(value >= 0 && value < 1e8))
      return given + " is no time such as 60s, 10m or 1h";
    text = fmt::format("{}", value * unit);
    return "";
  };
  return {to_seconds, ""};
}

}  // namespace

void add_solve_options(CLI::App& sub, SolveCommand& command) {
  command.question.add_options(sub);
  sub.add_option("--sigma", command.sigma,
                 "Largest edge that a box may have, in lengths and in the sines and cosines of angles;\n"
                 "default: 1/200 of the size of the set found for a curve, 1/60 for a surface, 1/20 for more");
  sub.add_option("--sigma-length", command.sigma_length, "The same for lengths alone, in the model's unit");
  sub.add_option("--sigma-angle", command.sigma_angle, "The same for the sines and cosines of angles alone");
  sub.add_option("--tolerance", command.tolerance,
                 "Take the coefficients that are no integers within so much of their size, each on its own; 0: exact;\n"
                 "default: 1e-6 for a plain system with more equations than variables, else 0")
      ->type_name("REL")
      ->check(tolerance());
  command.limits.add_options(sub, "the search");
  sub.add_option("--max-solutions", command.max_solutions,
                 "End the search after so many proven boxes, or distinct isolated solutions; 0: all")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  sub.add_option("--digits", command.digits,
                 "Isolated points with so many proven digits after the point; 0: only what boxes of doubles show")
      ->type_name("N")
      ->check(CLI::Range(0, 1000, "a number from 0 to 1000"));
  sub.add_flag("--proof", command.proof,
               "Keep the search tree in RESULT.h5, so that corank verify can replay why nothing was lost");
  sub.add_flag(
      "--area", command.area,
      "Of --set boundary with two lengths as outputs: bounds of the workspace's area also where its boundary does not\n"
      "give them, since a range that is no limit cuts it or the model has inequalities; takes long");
  sub.add_option("-o", command.result_path,
                 "Write boxes, verdicts and the model to this file: HDF5, or the CUIK suite's layout\n"
                 "where its name ends in .sol")
      ->type_name("RESULT.h5|.sol");
  sub.add_option("--param", command.param_path,
                 "A parameter file of the CUIK suite; its SIGMA and N_SOLUTIONS give way to --sigma and --max-solutions;\n"
                 "default: for NAME.world NAME.param, where that exists")
      ->type_name("FILE.param");
  sub.add_option("--checkpoint", command.checkpoint_path,
                 "Write to this file, now and then and at the end of a run that a limit or Ctrl-C ends, from where\n"
                 "corank solve --resume FILE goes on; removed once the run is complete")
      ->type_name("FILE");
  sub.add_option("--every", command.every, "Write checkpoints so far apart, such as 60s, 10m or 1h; default: 60s")
      ->type_name("TIME")
      ->transform(seconds());
  sub.add_option("--resume", command.resume_path,
                 "Go on with the run whose checkpoint, or whose result that a limit has ended, this is: the model and the\n"
                 "question are in it; limits, --threads, -o, --json and --digits may be given anew")
      ->type_name("FILE|RESULT.h5");
  sub.add_option("--refine", command.refine_path,
                 "Cut the sheets of this result, solved with --keep-sheets, to another --sigma, without a search")
      ->type_name("RESULT.h5");
  sub.add_flag("--keep-sheets", command.keep_sheets, "Keep the proven sheets in RESULT.h5, for --refine");
  sub.add_flag("--estimate", command.estimate,
               "Solve nothing: predict boxes, time, memory and the file's size from a trial of a few seconds");
  command.json.add(sub, "the summary");
}

}  // namespace corank::app
