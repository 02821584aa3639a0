// corank solve: encloses a set in boxes with verdicts, prints a summary, writes result files.
#include "corank/solve/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "corank/analyze/area_by_boundary.h"
#include "corank/app/box_files.h"
#include "corank/app/interrupt.h"
#include "corank/app/progress.h"
#include "corank/app/question.h"
#include "corank/app/search_limits.h"
#include "corank/app/subcommands.h"
#include "corank/result/cuik_param.h"
#include "corank/result/printable.h"
#include "corank/result/result_file.h"
#include "corank/result/summary.h"
#include "corank/study/answer.h"
#include "corank/symbolic/boundary.h"

namespace corank::app {
namespace {

struct SolveCommand {
  QuestionOptions question;
  std::optional<double> sigma, sigma_length, sigma_angle, tolerance;
  SearchLimits limits{.threads = 1};
  std::optional<std::uint64_t> max_solutions;
  int digits = 0;
  bool proof = false, area = false;
  std::string param_path, result_path;
  std::optional<std::string> json_path;  ///< "": standard output
};

solve::Options options_of(const SolveCommand& command) {
  solve::Options options;
  options.sigma = command.sigma;
  options.sigma_length = command.sigma_length;
  options.sigma_angle = command.sigma_angle;
  command.limits.apply(options);
  options.max_solutions = command.max_solutions.value_or(0);
  options.proof = command.proof;
  return options;
}

// As cuik does: the parameters that stand beside a mechanism file of the suite.
std::string parameters_beside(const std::string& model) {
  std::filesystem::path path = model;
  if (path.extension() != ".world" || !std::filesystem::exists(path.replace_extension(".param"))) return "";
  fmt::print(
      stderr, "{}: note: {}\n", result::printable_line(model),
      result::printable_line(fmt::format("with the parameters of {}, where the command line has none", path.string())));
  return path.string();
}

void apply_parameters(SolveCommand& command, const System& system) {
  if (command.param_path.empty()) command.param_path = parameters_beside(command.question.file);
  if (command.param_path.empty()) return;
  const result::CuikParameters parameters = result::read_param(command.param_path);
  if (!command.sigma) command.sigma = result::sigma_for(parameters, system);
  if (!command.max_solutions) command.max_solutions = parameters.n_solutions;
  if (!parameters.ignored.empty()) {
    fmt::print(stderr, "{}",
               result::printable(fmt::format("corank: {}: without effect here: {}\n", command.param_path,
                                             fmt::join(parameters.ignored, ", "))));
  }
}

void write_file(const std::string& path, const result::Result& result) {
  if (path.empty()) return;
  if (std::filesystem::path(path).extension() == ".sol") {
    result::write_text(path, result::to_sol(result));
  } else {
    result::write_result(path, result);
  }
}

// The system of the set, and what else the options have to say about it.
System system_to_solve(SolveCommand& command, const study::Question& question) {
  System system = study::system(question);
  if (!question.part || question.part->active.empty()) apply_parameters(command, system);
  options_of(command).validate(system);
  if (command.proof && std::filesystem::path(command.result_path).extension() != ".h5")
    throw UsageError("--proof: expected -o RESULT.h5, the file that keeps the proof");
  if (command.proof && system.coefficient_tolerance > 0)
    throw UsageError("--proof: there is none for coefficients with a tolerance; --tolerance 0 takes them as exact");
  return system;
}

// Of a boundary in the plane of two lengths.
std::optional<Interval> area_of(const SolveCommand& command, const study::Question& question, const result::Result& result,
                                solve::Control& control) {
  if (result.parts.empty() || result.outputs.size() != 2 || result.options.tolerance > 0 || control.ended())
    return std::nullopt;
  if (const auto bounds = analyze::area_by_boundary(question, {.threads = command.limits.threads}, control))
    return Interval(bounds->lo, bounds->hi);
  const System system = symbolic::configurations(question.model);
  const int x = system.find(result.outputs[0]), y = system.find(result.outputs[1]);
  if (!command.area || x < 0 || y < 0) return std::nullopt;  // an angle
  const analyze::AreaBounds bounds = analyze::workspace_area(system, x, y, {.stop = [&control] { return control.ended(); }});
  return Interval(bounds.lo, bounds.hi);
}

ExitStatus say(const SolveCommand& command, const result::Result& result, const std::optional<Interval>& area) {
  if (command.json_path) {
    const std::string json = result::to_json(result, area) + "\n";
    if (command.json_path->empty()) {
      fmt::print("{}", json);
    } else {
      result::write_text(*command.json_path, json);
    }
  }
  if (!command.json_path || !command.json_path->empty()) {
    fmt::print("{}", result::printable(result::to_table(result)));
    constexpr double kRoom = 1e-6;  // more than what the digits round
    if (area)
      fmt::print("area of the workspace: from {:.7g} to {:.7g}\n", area->lo() * (1 - kRoom), area->hi() * (1 + kRoom));
  }
  if (result.cover.complete() && result.stopped.empty()) return kDone;
  fmt::print(stderr, "corank: {}; {}\n", study::stopped_words(result),
             result.cover.complete() ? "the cover is complete, but less is proven of it than could be"
                                     : "the result is incomplete");
  return kIncomplete;
}

ExitStatus solve_model(SolveCommand command) {
  // `--json FILE` without another file: CLI11 took the model for the path of the summary.
  if (command.question.file.empty() && command.json_path && !command.json_path->empty()) {
    command.question.file.swap(*command.json_path);
  }
  options_of(command).validate();
  solve::Control control(limits_of(options_of(command), &Interrupt::stop()));  // reading the model takes its time, too
  std::optional<solve::InStage> stage(std::in_place, control, solve::Stage::model);
  study::Question question = load(command.question);
  question.set = chosen_set(command.question, question.model);
  question.tolerance = command.tolerance;
  const std::vector<study::Question> parts = study::parts_of(question);
  std::vector<System> systems;
  for (const study::Question& part : parts) systems.push_back(system_to_solve(command, part));
  check_output(command.result_path);
  check_output(command.json_path.value_or(""));
  control.ended();  // notes the stage

  study::Options options{options_of(command), command.digits};
  const Interrupt interrupt;
  ProgressLine line;
  line.follow(control);
  stage.reset();
  const result::Result result = study::answer(parts, systems, options, control);
  stage.emplace(control, solve::Stage::writing);
  write_file(command.result_path, result);
  const std::optional<Interval> area = area_of(command, question, result, control);
  line.clear();
  return say(command, result, area);
}

CLI::Validator tolerance() {
  const auto check = [](const std::string& text) -> std::string {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= 0 && value < kCoefficientToleranceLimit;
    return good ? "" : fmt::format("{} is not a number from 0 to below {}", text, kCoefficientToleranceLimit);
  };
  return {check, ""};
}

}  // namespace

void add_solve(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("solve", "Enclose every solution of a system or of a mechanism's set in boxes");
  const auto command = std::make_shared<SolveCommand>();
  command->question.add_options(*sub);
  sub->add_option("--sigma", command->sigma,
                  "Largest edge that a box may have, in lengths and in the sines and cosines of angles;\n"
                  "default: 1/200 of the size of the set found for a curve, 1/60 for a surface, 1/20 for more");
  sub->add_option("--sigma-length", command->sigma_length, "The same for lengths alone, in the model's unit");
  sub->add_option("--sigma-angle", command->sigma_angle, "The same for the sines and cosines of angles alone");
  sub->add_option("--tolerance", command->tolerance,
                  "Take the coefficients that are no integers within so much of their size, each on its own; 0: exact;\n"
                  "default: 1e-6 for a plain system with more equations than variables, else 0")
      ->type_name("REL")
      ->check(tolerance());
  command->limits.add_options(*sub, "the search");
  sub->add_option("--max-solutions", command->max_solutions,
                  "End the search after so many proven boxes, or distinct isolated solutions; 0: all")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--digits", command->digits,
                  "Isolated points with so many proven digits after the point; 0: only what boxes of doubles show")
      ->type_name("N")
      ->check(CLI::Range(0, 1000, "a number from 0 to 1000"));
  sub->add_flag("--proof", command->proof,
                "Keep the search tree in RESULT.h5, so that corank verify can replay why nothing was lost");
  sub->add_flag(
      "--area", command->area,
      "Of --set boundary with two lengths as outputs: bounds of the workspace's area also where its boundary does not\n"
      "give them, since a range that is no limit cuts it or the model has inequalities; takes long");
  sub->add_option("-o", command->result_path,
                  "Write boxes, verdicts and the model to this file: HDF5, or the CUIK suite's layout\n"
                  "where its name ends in .sol")
      ->type_name("RESULT.h5|.sol");
  sub->add_option("--param", command->param_path,
                  "A parameter file of the CUIK suite; its SIGMA and N_SOLUTIONS give way to --sigma and --max-solutions;\n"
                  "default: for NAME.world NAME.param, where that exists")
      ->type_name("FILE.param");
  CLI::Option* json = sub->add_option_function<std::vector<std::string>>(
      "--json", [command](const std::vector<std::string>& path) { command->json_path = path.empty() ? "" : path.front(); },
      "Write the summary as JSON to PATH, or to standard output instead of the table");
  json->type_name("[PATH]")->expected(0, 1);
  sub->footer(
      "Exit status: 0 done and complete, 1 bad input, 2 usage, 3 incomplete (a limit or an interrupt).\n\n"
      "Examples:\n  corank solve models/dextar.cuik --set forward --sigma 0.01 -o forward.h5\n"
      "  corank solve models/three_slider.cuik --set inverse -D L2=1 --digits 50\n"
      "  corank solve models/dextar.cuik --set inverse --corank 2    # both arms stretched at once");
  sub->callback([command, json, &action] {
    if (json->count() > 0 && !command->json_path) command->json_path = "";
    action = [command] { return solve_model(*command); };
  });
}

}  // namespace corank::app
