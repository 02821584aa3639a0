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
      return given + " is not a time such as 60s, 10m or 1h";
    text = fmt::format("{}", value * unit);
    return "";
  };
  return {to_seconds, ""};
}

}  // namespace

void add_solve_options(CLI::App& sub, SolveCommand& command) {
  command.question.add_options(
      sub, "A model with inputs and outputs needs --set, other models must not have it. Which configurations");
  add_option(sub, "--sigma S|inf", command.sigma,
             "Largest edge of a box, in lengths and in the sines and cosines of angles; inf: do not cut the sheets, the\n"
             "proven pieces of the set; default: 1/200 of the size of a curve; none for a surface and for more\n"
             "dimensions. Boxes of these may hold parts of sheets, except with inf. Pictures cut boxes themselves");
  add_option(sub, "--sigma-length S|inf", command.sigma_length, "The same for lengths only, in the model's unit");
  add_option(sub, "--sigma-angle S|inf", command.sigma_angle, "The same for the sines and cosines of angles only");
  add_option(sub, "--tolerance REL", command.tolerance,
             "Let each coefficient that is not an integer vary by REL of its size, independently of the others;\n"
             "0: coefficients are exact; default: 1e-6 for a model without inputs and outputs that has more\n"
             "equations than variables, else 0")
      ->check(tolerance());
  command.limits.add_options(sub, "the search");
  add_option(sub, "--max-solutions N", command.max_solutions,
             "End the search when N boxes are proven; boxes about the same isolated solution count once; 0: no limit")
      ->check(not_negative());
  add_option(sub, "--digits N", command.digits,
             "Give isolated solutions with N proven decimals; 0: no more digits than their boxes show")
      ->check(CLI::Range(0, 1000, "a number from 0 to 1000"));
  sub.add_flag("--proof", command.proof,
               "Record the search in RESULT.h5, so that corank verify can check that no solution is missing");
  sub.add_flag(
      "--area", command.area,
      "For --set boundary with two lengths as outputs: always compute proven lower and upper bounds of the workspace's\n"
      "area, which may take long. Without --area, corank computes them only if the area follows from the boundary. It\n"
      "does not follow, for example, if the workspace may reach the end of a range that the model does not declare as\n"
      "a limit (section [LIMITS])");
  add_option(sub, "-o RESULT.h5|.sol", command.result_path,
             "Write boxes, verdicts and the model to this file: HDF5, or the CUIK suite's format if its name\n"
             "ends in .sol");
  add_option(sub, "--param FILE.param", command.param_path,
             "A parameter file of the CUIK suite; --sigma and --max-solutions override its SIGMA and N_SOLUTIONS;\n"
             "default: NAME.param beside NAME.world, if it exists");
  add_option(sub, "--checkpoint FILE", command.checkpoint_path,
             "Store the state of the run in this file, from time to time and when a limit or Ctrl-C ends the run;\n"
             "corank solve --resume FILE goes on from there; a run that is complete removes the file");
  add_option(sub, "--every TIME", command.every, "Time between two checkpoints, such as 60s, 10m or 1h; default: 60s")
      ->transform(seconds());
  add_option(sub, "--resume FILE|RESULT.h5", command.resume_path,
             "Go on with a run from its checkpoint, or from the result that it wrote when a limit ended it. The file\n"
             "holds the model and the question; you may give limits, --threads, -o, --json and --digits anew");
  add_option(sub, "--refine RESULT.h5", command.refine_path,
             "Cut the sheets of this result to --sigma, by default 1/60 of the size of a surface, 1/20 for three\n"
             "dimensions, coarser for more or with over 20 variables. Wider boxes with parts of sheets are searched\n"
             "again. A proof of completeness (--proof) stays in RESULT.h5");
  sub.add_flag("--estimate", command.estimate,
               "Only predict boxes, time, memory and the size of the file, from a trial of a few seconds");
  command.json.add(sub, "the summary");
}

}  // namespace corank::app
