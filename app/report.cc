// corank report: solves all sets of a mechanism and writes one HTML page about them, with the result files beside it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "corank/app/box_files.h"
#include "corank/app/figures.h"
#include "corank/app/interrupt.h"
#include "corank/app/progress.h"
#include "corank/app/question.h"
#include "corank/app/set_search.h"
#include "corank/app/solve_set.h"
#include "corank/app/subcommands.h"
#include "corank/report/domain_notes.h"
#include "corank/report/motion_words.h"
#include "corank/report/page.h"
#include "corank/report/page_words.h"
#include "corank/report/printable.h"
#include "corank/report/result_file.h"
#include "corank/report/verification.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/model_file.h"
#include "corank/symbolic/printer.h"

namespace corank::app {
namespace {

constexpr int kDigits = 12;  ///< of isolated points

/// Finer than corank solve's, where that is cheap: pictures want it.

/// A page of all sets is to be there within a minute, and to open in a browser.
constexpr double kDefaultTimeLimit = 8;
constexpr std::uint64_t kDefaultMaxFound = 200'000;

struct ReportCommand {
  Question question;
  SetSearch search{1, kSets, {}, {}, {.max_found = kDefaultMaxFound, .time_limit = kDefaultTimeLimit}};
  std::vector<std::string> results;
  std::string folder;
};

report::Result solve_one(const ReportCommand& command, const symbolic::Mechanism& mechanism, std::size_t index,
                         std::uint64_t taken) {
  const std::vector<std::string>& sets = command.search.sets;
  const symbolic::SingularitySet set = *symbolic::singularity_set_from_string(sets[index]);
  solve::Options limits;
  command.search.limits.apply(limits);
  solve::Control control(command.search.limits_beside(limits, taken));
  std::optional<solve::InStage> stage(std::in_place, control, solve::Stage::model);
  Question question = command.question;
  if (set == symbolic::SingularitySet::cspace) question.corank = 1;  // it has no kernel
  const symbolic::TrigonometricSystem trigonometric = system_of(question, mechanism, set);
  const certify::System system = algebrize(trigonometric);
  control.ended();  // notes the stage
  stage.reset();
  solve::Options options = command.search.options(system, set);
  ProgressLine line(fmt::format("{} ({} of {})", sets[index], index + 1, sets.size()));
  line.follow(options, control);
  return solve_set(question, mechanism, set, system, trigonometric.kernel_scales, options, control, kDigits);
}

std::vector<report::Result> solve_all(const ReportCommand& command, const symbolic::Mechanism& mechanism) {
  std::vector<report::Result> results;
  std::uint64_t taken = 0;
  // After an interrupt the searches left end at once, with all of their domain pending.
  for (std::size_t i = 0; i < command.search.sets.size(); ++i) {
    results.push_back(solve_one(command, mechanism, i, taken));
    taken += solve::bytes_of(results.back().cover, solve::kPageBytes);
  }
  return results;
}

/// What a stranger's result says of its variables has to be so before a picture relies on it.
void check_against_model(const report::Result& result, const std::string& path) {
  const certify::System system = report::system_of(result);
  const auto contradictions = report::contradictions(result, system, symbolic::to_cuik(system));
  if (!contradictions.empty())
    throw report::ResultFileError(fmt::format("{}: contradicts the model in it: {}", path, fmt::join(contradictions, "; ")));
}

/// Reads results of one model, and brings them and their paths into the order of kSets.
std::vector<report::Result> read_all(std::vector<std::string>& paths) {
  std::map<std::ptrdiff_t, std::pair<std::string, report::Result>> by_set;
  for (const std::string& path : paths) {
    report::Result result = report::read_result(path);
    check_against_model(result, path);
    const auto place = std::find(kSets.begin(), kSets.end(), result.set) - kSets.begin();
    const auto [other, added] = by_set.try_emplace(place, path, result);
    const auto& [first_path, first] = by_set.begin()->second;
    if (!added) {
      throw report::ResultFileError(fmt::format("{}: holds the set {}, as {} does", path, result.set, other->second.first));
    }
    if (result.model_text != first.model_text || result.options.constants != first.options.constants) {
      throw report::ResultFileError(fmt::format("{} and {} are of two models, or with other constants", path, first_path));
    }
  }
  std::vector<report::Result> results;
  paths.clear();
  for (auto& [place, entry] : by_set) {
    paths.push_back(entry.first);
    results.push_back(std::move(entry.second));
  }
  return results;
}

/// The mechanism as the results had it: their own copy of its text, with the constants that were put in.
symbolic::Mechanism mechanism_of(const report::Result& result) {
  symbolic::Mechanism mechanism = symbolic::parse_model(result.model_text, result.model + ".cuik");
  for (const auto& [name, expression] : result.options.constants)
    mechanism.set_constant(name, symbolic::parse_expression(expression, "-D " + name));
  return mechanism;
}

ExitStatus write_report(ReportCommand command) {
  if (!command.results.empty() && !command.question.file.empty())
    throw UsageError("--results take the place of FILE: their model is in them");
  std::vector<report::Result> results;
  if (!command.results.empty()) results = read_all(command.results);
  const symbolic::Mechanism mechanism = results.empty() ? load(command.question) : mechanism_of(results.front());
  for (report::Result& result : results) {
    const certify::System system = report::system_of(result);
    report::describe_domain(mechanism, system, result);
    report::describe_motions(mechanism, system, result);
  }
  if (command.folder.empty()) command.folder = mechanism.name() + "-report";
  const std::filesystem::path folder = command.folder;
  make_folder(folder / "figures");
  report::check_writable(folder / "index.html");

  const Interrupt interrupt;
  report::PageOptions options;
  if (results.empty()) {
    results = solve_all(command, mechanism);
    options.command = command.search.command_line("report", command.question);
    ProgressLine line;
    for (const report::Result& result : results) {
      line.show("writing " + result.set + ".h5");
      options.files.push_back(result.set + ".h5");
      report::write_result(folder / options.files.back(), result);
    }
  } else {
    options.command = "corank report --results " + fmt::format("{}", fmt::join(command.results, " "));
    for (const std::string& path : command.results) options.files.push_back(std::filesystem::path(path).filename().string());
  }
  const Figures figures = write_figures(folder / "figures", mechanism, results, Interrupt::stop());
  for (const std::string& name : figures.files) options.figures.push_back("figures/" + name);
  {
    ProgressLine line;
    line.show("page");
    report::write_text(folder / "index.html", report_page(mechanism, results, options));
  }

  bool complete = !figures.stopped;
  for (const report::Result& result : results) {
    complete = complete && result.cover.complete() && result.stopped.empty();
    fmt::print("{}: {}\n", report::set_title(result), report::set_words(result, report::components(result)).finding);
  }
  fmt::print("{}\n", report::printable_line((folder / "index.html").string()));
  if (complete) return kDone;
  for (const report::Result& result : results)
    if (!result.cover.complete() || !result.stopped.empty())
      fmt::print(stderr, "corank: {}: {}\n", result.set, stopped_words(result));
  if (figures.stopped) fmt::print(stderr, "corank: stopped by an interrupt, in the stage figures\n");
  fmt::print(stderr, "corank: the report is incomplete, and says so\n");
  return kIncomplete;
}

}  // namespace

void add_report(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("report", "Solve all sets of a mechanism and write a page about them");
  const auto command = std::make_shared<ReportCommand>();
  sub->add_option("FILE", command->question.file, "The model file (.cuik) of a mechanism");
  command->search.add_sets(*sub);
  command->question.add_corank(*sub);
  command->question.add_definitions(*sub);
  command->search.add_limits(*sub);
  sub->add_flag("--proof", command->search.proof,
                "Keep in the result files why no solution is missing, so that corank verify can check that, too");
  sub->add_option("--results", command->results, "Take these results, of one model, instead of solving")
      ->type_name("RESULT.h5...");
  sub->add_option("-o", command->folder, "Where index.html, the results and the figures go; default: MODEL-report")
      ->type_name("FOLDER");
  sub->footer(
      "Each search ends after 8 seconds or 200000 boxes unless other limits are given, so that there is a page within a "
      "minute; it\n"
      "says which sets are incomplete.\n\n"
      "Exit status: 0 done and complete, 1 bad input, 2 usage, 3 incomplete (a limit or an interrupt).\n\n"
      "Example:\n  corank report models/dextar.cuik -o dextar");
  sub->callback([command, &action] { action = [command] { return write_report(*command); }; });
}

}  // namespace corank::app
