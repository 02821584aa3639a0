#include "corank/app/set_search.h"

#include <fmt/format.h>

#include <filesystem>

#include "corank/app/exit_status.h"
#include "corank/app/interrupt.h"

namespace corank::app {
using symbolic::SingularitySet;

void SetSearch::add_sets(CLI::App& command) {
  command.add_option("--sets", sets, "The sets, with commas")
      ->type_name("SET[,SET...]")
      ->delimiter(',')
      ->check(CLI::IsMember(kSets))
      ->capture_default_str();
  command
      .add_option("--sigma", sigma,
                  "Largest edge of a box in the sets of singularities; default: a share of the size of the set found")
      ->check(CLI::PositiveNumber);
  command.add_option("--cspace-sigma", cspace_sigma, "The same in C-space")->check(CLI::PositiveNumber);
}

void SetSearch::add_limits(CLI::App& command) {
  command.add_option("--threads", threads, "Threads; 0: one for each core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--max-boxes", max_boxes, "End each search after so many processed boxes; 0: no limit")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--time-limit", time_limit, "End each search after so many seconds; 0: no limit")
      ->check(CLI::NonNegativeNumber);
}

solve::Options SetSearch::options(const certify::System& system, SingularitySet set) const {
  solve::Options options;
  const std::optional<double>& asked = set == SingularitySet::cspace ? cspace_sigma : sigma;
  check_sigma("--sigma", asked, system);
  options.set_sigma(asked);
  options.coarser = coarser;
  options.threads = threads;
  options.max_boxes = max_boxes;
  options.time_limit = time_limit;
  options.proof = proof;
  options.stop = &Interrupt::stop();
  return options;
}

void check_sigma(const std::string& option, const std::optional<double>& sigma, const certify::System& system) {
  if (const double least = solve::smallest_sigma(system).largest(); sigma && *sigma < least)
    throw UsageError(fmt::format("{}: {} is below {}, what boxes of doubles resolve here", option, *sigma, least));
}

std::string SetSearch::command_line(const std::string& subcommand, const Question& question) const {
  std::string text = "corank " + subcommand + " " + std::filesystem::path(question.file).filename().string();
  if (sigma) text += fmt::format(" --sigma {:g}", *sigma);
  if (cspace_sigma) text += fmt::format(" --cspace-sigma {:g}", *cspace_sigma);
  for (const std::string& definition : question.definitions) text += " -D '" + definition + "'";
  return text;
}

}  // namespace corank::app
