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
#include "corank/app/solve_set.h"
#include "corank/app/subcommands.h"
#include "corank/report/page.h"
#include "corank/report/page_words.h"
#include "corank/report/result_file.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/model_file.h"

namespace corank::app {
namespace {

using symbolic::SingularitySet;

const std::vector<std::string> kSets = {"cspace", "forward", "inverse", "cspace-singular"};

constexpr int kDigits = 12;  ///< of isolated points

struct ReportCommand {
  Question question;
  std::vector<std::string> sets = kSets, results;
  std::optional<double> sigma, cspace_sigma;
  int threads = 0;
  std::uint64_t max_boxes = 0;
  double time_limit = 0;
  bool proof = false;
  std::string folder;
};

/// Finer than corank solve's, where that is cheap: pictures want it. Isolated points keep the solver's own.
std::optional<double> default_sigma(const certify::System& system, SingularitySet set) {
  const bool over_determined = system.equations.size() > system.variables.size();
  const int dimension = system.dimension();
  if (over_determined) return 0.01;
  if (dimension == 0) return std::nullopt;
  if (dimension == 1) return 0.01;
  if (dimension == 2) return set == SingularitySet::cspace ? 0.05 : 0.1;
  return 0.4;
}

report::Result solve_one(const ReportCommand& command, const symbolic::Mechanism& mechanism, std::size_t index) {
  const SingularitySet set = *symbolic::singularity_set_from_string(command.sets[index]);
  const certify::System system = algebrize(singularity_system(mechanism, set));
  solve::Options options;
  const std::optional<double>& asked = set == SingularitySet::cspace ? command.cspace_sigma : command.sigma;
  options.sigma = asked ? asked : default_sigma(system, set);
  if (const double least = solve::smallest_sigma(system); options.sigma && *options.sigma < least)
    throw UsageError(fmt::format("{} is below {}, what boxes of doubles resolve here", *options.sigma, least));
  options.threads = command.threads;
  options.max_boxes = command.max_boxes;
  options.time_limit = command.time_limit;
  options.proof = command.proof;
  options.stop = &Interrupt::stop();
  ProgressLine line(fmt::format("{} ({} of {})", command.sets[index], index + 1, command.sets.size()));
  if (line.visible()) options.progress = [&line](const solve::Progress& progress) { line.show(progress); };
  return solve_set(command.question, mechanism, set, system, options, kDigits);
}

std::vector<report::Result> solve_all(const ReportCommand& command, const symbolic::Mechanism& mechanism) {
  const Interrupt interrupt;
  std::vector<report::Result> results;
  // After an interrupt the searches left end at once, with all of their domain pending.
  for (std::size_t i = 0; i < command.sets.size(); ++i) results.push_back(solve_one(command, mechanism, i));
  return results;
}

/// Reads results of one model, and brings them and their paths into the order of kSets.
std::vector<report::Result> read_all(std::vector<std::string>& paths) {
  std::map<std::ptrdiff_t, std::pair<std::string, report::Result>> by_set;
  for (const std::string& path : paths) {
    report::Result result = report::read_result(path);
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

std::string command_line(const ReportCommand& command, const std::string& file) {
  std::string text = "corank report " + file;
  if (command.sigma) text += fmt::format(" --sigma {:g}", *command.sigma);
  if (command.cspace_sigma) text += fmt::format(" --cspace-sigma {:g}", *command.cspace_sigma);
  for (const std::string& definition : command.question.definitions) text += " -D '" + definition + "'";
  return text;
}

ExitStatus write_report(ReportCommand command) {
  if (!command.results.empty() && !command.question.file.empty())
    throw UsageError("--results take the place of FILE: their model is in them");
  std::vector<report::Result> results;
  if (!command.results.empty()) results = read_all(command.results);
  const symbolic::Mechanism mechanism = results.empty() ? load(command.question) : mechanism_of(results.front());
  if (command.folder.empty()) command.folder = mechanism.name() + "-report";
  const std::filesystem::path folder = command.folder;
  make_folder(folder / "figures");
  report::check_writable(folder / "index.html");

  report::PageOptions options;
  if (results.empty()) {
    results = solve_all(command, mechanism);
    options.command = command_line(command, std::filesystem::path(command.question.file).filename().string());
    for (const report::Result& result : results) {
      options.files.push_back(result.set + ".h5");
      report::write_result(folder / options.files.back(), result);
    }
  } else {
    options.command = "corank report --results " + fmt::format("{}", fmt::join(command.results, " "));
    for (const std::string& path : command.results) options.files.push_back(std::filesystem::path(path).filename().string());
  }
  for (const std::string& name : write_figures(folder / "figures", mechanism, results))
    options.figures.push_back("figures/" + name);
  report::write_text(folder / "index.html", report_page(mechanism, results, options));

  bool complete = true;
  for (const report::Result& result : results) {
    complete = complete && result.cover.complete();
    fmt::print("{}: {}\n", report::set_title(result.set), report::set_words(result, report::components(result)).finding);
  }
  fmt::print("{}\n", (folder / "index.html").string());
  if (complete) return kDone;
  fmt::print(stderr, "corank: {}; the report is incomplete, and says so\n",
             Interrupt::stop() ? "interrupted" : "a limit was reached");
  return kIncomplete;
}

}  // namespace

void add_report(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("report", "Solve all sets of a mechanism and write a page about them");
  const auto command = std::make_shared<ReportCommand>();
  sub->add_option("FILE", command->question.file, "The model file (.cuik) of a mechanism");
  sub->add_option("--sets", command->sets, "The sets, with commas")
      ->type_name("SET[,SET...]")
      ->delimiter(',')
      ->check(CLI::IsMember(kSets))
      ->capture_default_str();
  sub->add_option("--sigma", command->sigma,
                  "Largest edge of a box in the sets of singularities; default: 0.01 for curves, 0.1 for surfaces")
      ->check(CLI::PositiveNumber);
  sub->add_option("--cspace-sigma", command->cspace_sigma,
                  "The same in C-space; default: 0.01 for curves, 0.05 for surfaces")
      ->check(CLI::PositiveNumber);
  command->question.add_definitions(*sub);
  sub->add_option("--threads", command->threads, "Threads; 0: one for each core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--max-boxes", command->max_boxes, "End each search after so many processed boxes; 0: no limit")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--time-limit", command->time_limit, "End each search after so many seconds; 0: no limit")
      ->check(CLI::NonNegativeNumber);
  sub->add_flag("--proof", command->proof,
                "Keep in the result files why no solution is missing, so that corank verify can check that, too");
  sub->add_option("--results", command->results, "Take these results, of one model, instead of solving")
      ->type_name("RESULT.h5...");
  sub->add_option("-o", command->folder, "Where index.html, the results and the figures go; default: MODEL-report")
      ->type_name("FOLDER");
  sub->footer(
      "Exit status: 0 done and complete, 1 bad input, 2 usage, 3 incomplete (a limit or an interrupt).\n\n"
      "Example:\n  corank report models/dextar.cuik -o dextar");
  sub->callback([command, &action] { action = [command] { return write_report(*command); }; });
}

}  // namespace corank::app
