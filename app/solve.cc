// corank solve: encloses a set in boxes with verdicts, prints a summary, writes result files.
#include "corank/solve/search/solve.h"

#include <utility>

#include "corank/analyze/maps/area_by_boundary.h"
#include "corank/app/box_files.h"
#include "corank/app/solve_command.h"
#include "corank/app/subcommands.h"
#include "corank/core/threads.h"
#include "corank/result/cuik/cuik_files.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/study/answer.h"
#include "corank/study/cost.h"
#include "corank/study/cut.h"
#include "corank/study/run_journal.h"

namespace corank::app {
namespace {

solve::Options options_of(const SolveCommand& command) {
  solve::Options options;
  options.sigma = command.sigma;
  options.sigma_length = command.sigma_length;
  options.sigma_angle = command.sigma_angle;
  options.surfaces_whole = std::filesystem::path(command.result_path).extension() != ".sol";  // which others draw
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
      result::printable_line(fmt::format("takes the parameters of {} that the command line does not give", path.string())));
  return path.string();
}

void apply_parameters(SolveCommand& command, const System& system) {
  if (command.param_path.empty()) command.param_path = parameters_beside(command.question.file);
  if (command.param_path.empty()) return;
  const result::CuikParameters parameters = result::read_param(command.param_path);
  if (!command.sigma) command.sigma = result::sigma_for(parameters, system);
  if (!command.max_solutions) command.max_solutions = parameters.n_solutions;
  if (!parameters.ignored.empty())
    fmt::print(stderr, "{}",
               result::printable(fmt::format("corank: {}: these parameters have no effect here: {}\n", command.param_path,
                                             fmt::join(parameters.ignored, ", "))));
}

void write_file(const std::string& path, const result::Result& result, const solve::Control& control) {
  if (path.empty()) return;
  if (std::filesystem::path(path).extension() == ".sol") {
    result::write_text(path, result::to_sol(result));
  } else {
    result::write_result(path, result, [&control] { return control.overdue(); });
  }
}

bool bounds_an_area(const study::Question& question) {
  return symbolic::definition(question.set).of_parts &&
         analyze::is_plane_of_lengths(question.model, question.model.outputs());
}

// Of a boundary in the plane of two lengths.
std::optional<Interval> area_of(const SolveCommand& command, const study::Question& question, const result::Result& result,
                                solve::Control& control) {
  if (result.parts.empty() || result.outputs.size() != 2 || result.options.tolerance > 0 || control.ended())
    return std::nullopt;
  return analyze::area(question, command.limits.threads, command.area, control);
}

// What would take longer to write than the program has, once it has been ended.
void say_left_out(const SolveCommand& command, std::uint64_t bytes) {
  if (bytes == 0) return;
  const std::string size = fmt::format("{:.0f} MB", static_cast<double>(bytes) / 1e6);
  if (command.checkpoint_path.empty())
    fmt::print(stderr, "corank: the state of the search, {}, is not in the result; --checkpoint FILE would store it\n",
               size);
  if (command.proof)
    fmt::print(stderr, "corank: the proof of a search of {} that an interrupt or the time limit ends is not stored\n", size);
}

ExitStatus say(const SolveCommand& command, const result::Result& result, const std::optional<Interval>& area,
               std::uint64_t left_out) {
  if (command.json.say([&] { return result::to_json(result, area); })) {
    fmt::print("{}", result::printable(result::to_table(result)));
    constexpr double kRoom = 1e-6;  // more than what the digits round
    if (area)
      fmt::print("area of the workspace: from {:.7g} to {:.7g}\n", area->lo() * (1 - kRoom), area->hi() * (1 + kRoom));
  }
  warn_of_assembly(result);
  if (result.cover.complete() && result.stopped.empty())
    return result::assembled(result) == std::optional(false) ? kNotAssembled : kDone;
  fmt::print(stderr, "corank: {}; {}\n", study::stopped_words(result),
             result.cover.complete() ? "the cover is complete, but not all that could be proven about it was"
                                     : "the result is incomplete");
  say_left_out(command, left_out);
  if (!command.checkpoint_path.empty() && !result.cover.complete()) {
    std::error_code error;
    const bool kept = std::filesystem::exists(command.checkpoint_path, error);
    fmt::print(stderr, "corank: {}\n",
               result::printable_line(kept ? fmt::format("to go on: corank solve --resume {}", command.checkpoint_path)
                                           : "no search had begun, so there is no checkpoint"));
  }
  return kIncomplete;
}

study::RunJournal journal_of(const SolveCommand& command, result::Checkpoint from) {
  const bool to_result = std::filesystem::path(command.result_path).extension() == ".h5";
  return study::RunJournal(std::move(from),
                           {.path = command.checkpoint_path, .every = command.every, .keep_end = to_result});
}

// What nobody needs any more.
void remove_checkpoint(const SolveCommand& command, const result::Result& result) {
  std::error_code ignored;
  if (!command.checkpoint_path.empty() && result.cover.complete() && result.stopped.empty())
    std::filesystem::remove(command.checkpoint_path, ignored);
}

ExitStatus say_estimate(const SolveCommand& command, const std::vector<System>& systems, const solve::Options& options,
                        solve::Control& control) {
  const solve::CostEstimate cost = study::estimate(systems, options, control);
  const int threads = threads_for(command.limits.threads);
  if (control.ended()) {
    fmt::print(stderr, "corank: the trial was ended early\n");
    return kIncomplete;
  }
  if (command.json.say([&] { return study::to_json(cost, threads); })) fmt::print("{}", study::to_table(cost, threads));
  return kDone;
}

// Until the next run, or the end of the process, with which its memory goes at once: to free ten million boxes one by one
// takes seconds.
result::Result& kept(result::Result result) {
  static auto* const last = new std::optional<result::Result>;
  return last->emplace(std::move(result));
}

// `former`: of a run that goes on.
ExitStatus solve_model(const CLI::App& sub, SolveCommand command, const result::Checkpoint* former) {
  const solve::Options asked = options_of(command);
  asked.validate();
  LimitedRun run(limits_of(asked, nullptr));  // reading the model takes its time, too
  solve::Control& control = run.control();
  std::optional<solve::InStage> stage(std::in_place, control, solve::Stage::model);
  study::Question question = load(command.question);
  question.set = chosen_set(command.question, question.model);
  question.tolerance = command.tolerance;
  if (command.checkpoint_path.empty()) refuse_without_effect(sub, {"--every"}, "--checkpoint FILE beside it");
  if (!bounds_an_area(question)) refuse_without_effect(sub, {"--area"}, "--set boundary in the plane of two lengths");
  if (command.proof && std::filesystem::path(command.result_path).extension() != ".h5")
    throw UsageError("--proof: expected -o RESULT.h5, the file that keeps the proof");
  const study::Systems systems = study::systems_of(question, control);
  apply_parameters(command, systems.of_parts.front());
  check_output(command.result_path);
  command.json.check();
  const study::Options options{options_of(command), command.digits};
  if (command.estimate) return say_estimate(command, systems.of_parts, options.search, control);
  if (!command.checkpoint_path.empty()) result::check_writable(command.checkpoint_path);
  study::RunJournal journal = journal_of(command, former ? *former : checkpoint_of(sub, command));
  control.ended();  // notes the stage

  ProgressLine line;
  line.follow(control);
  stage.reset();
  result::Result& result = kept(study::answer(systems, options, control, &journal));
  result.search = journal.take_search();
  stage.emplace(control, solve::Stage::writing);
  write_file(command.result_path, result, control);
  stage.reset();
  const std::optional<Interval> area = area_of(command, question, result, control);
  line.clear();
  remove_checkpoint(command, result);
  // Boxes are limited for the set, not for its area.
  if (bounds_an_area(question) && result.stopped.empty() && control.ended()) result.stopped = stopped_by(control);
  return say(command, result, area, journal.left_out());
}

// Cuts the sheets of a former result.
ExitStatus refine(const CLI::App& sub, const SolveCommand& command) {
  check_refine(sub);
  solve::Options options = options_of(command);
  options.surfaces_whole = false;
  options.validate();
  check_output(command.result_path);
  if (std::error_code ignored; std::filesystem::equivalent(command.refine_path, command.result_path, ignored))
    throw UsageError(
        "-o: not overwritten, because it is the result to cut, with its sheets and its proof; expected another file");
  command.json.check();
  LimitedRun run(limits_of(options, nullptr));
  solve::Control& control = run.control();
  ProgressLine line;
  line.follow(control);
  const result::Result& result = kept(study::cut(result::read_result(command.refine_path), options, control));
  const solve::InStage stage(control, solve::Stage::writing);
  write_file(command.result_path, result, control);
  line.clear();
  return say(command, result, std::nullopt, 0);
}

ExitStatus run_solve(const CLI::App& sub, SolveCommand command) {
  if (!command.refine_path.empty()) return refine(sub, command);
  if (!command.resume_path.empty()) {
    const Resumed resumed(sub, command);
    return solve_model(sub, resumed.command, &resumed.checkpoint);
  }
  command.json.begin(command.question.file);
  return solve_model(sub, std::move(command), nullptr);
}

}  // namespace

void add_solve(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("solve",
                             "Enclose in boxes all solutions of a system of equations, or a set of a mechanism's "
                             "configurations, such as its forward singularities");
  const auto command = std::make_shared<SolveCommand>();
  add_solve_options(*sub, *command);
  sub->footer(
      "If the set of a robot is empty, corank solve also searches the robot's ranges for any configuration. It names one\n"
      "that is proven to exist. Or it proves that there is none, and the robot cannot be assembled. If the equations\n"
      "contradict each other only because their decimals are rounded, it proposes --tolerance.\n\n"
      "Exit status:\n"
      "  0  done and complete\n"
      "  1  bad input\n"
      "  2  wrong usage\n"
      "  3  incomplete: a limit or an interrupt ended the work early; what the output claims is proven\n"
      "  5  complete and empty: it is proven that the robot cannot be assembled within its ranges\n\n"
      "Examples:\n  corank solve models/dextar.cuik --set forward --sigma 0.01 -o forward.h5\n"
      "  corank solve models/three_slider.cuik --set inverse -D L2=1 --digits 50\n"
      "  corank solve models/dextar.cuik --set inverse --corank 2    # both arms stretched at once\n"
      "  corank solve models/3rrr.cuik --set forward --sigma 0.2 --estimate    # predicts time and memory\n"
      "  corank solve models/3rrr.cuik --set forward --sigma 0.2 -o r.h5 --checkpoint r.kept --every 10m\n"
      "  corank solve --resume r.kept --threads 8    # after a limit, Ctrl-C, a crash or a power cut\n"
      "  corank solve models/dextar.cuik --set cspace -o whole.h5\n"
      "  corank solve --refine whole.h5 --sigma 0.01 -o fine.h5");
  sub->callback([command, sub, &action] { action = [command, sub] { return run_solve(*sub, *command); }; });
}

}  // namespace corank::app
