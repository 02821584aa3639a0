#include "corank/app/set_search.h"

#include <fmt/format.h>

#include <filesystem>

#include "corank/app/exit_status.h"

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
      ->check(positive_number());
  command.add_option("--cspace-sigma", cspace_sigma, "The same in C-space")->check(positive_number());
}

void SetSearch::add_limits(CLI::App& command) { limits.add_options(command, "each search"); }

solve::Control::Limits SetSearch::limits_beside(const solve::Options& options, std::uint64_t taken) const {
  solve::Control::Limits result = limits_of(options);
  result.later_bytes = solve::kPageBytes;
  if (result.memory > 0) result.memory = result.memory > taken ? result.memory - taken : 1;
  return result;
}

solve::Options SetSearch::options(const System& system, SingularitySet set) const {
  solve::Options options;
  const std::optional<double>& asked = symbolic::definition(set).is_cspace() ? cspace_sigma : sigma;
  check_sigma("--sigma", asked, system);
  options.set_sigma(asked);
  options.coarser = coarser;
  limits.apply(options);
  options.proof = proof;
  return options;
}

void check_sigma(const std::string& option, const std::optional<double>& sigma, const System& system) {
  if (const double least = solve::smallest_sigma(system).largest(); sigma && *sigma < least)
    throw UsageError(fmt::format("{}: {} is below {}, what boxes of doubles resolve here", option, *sigma, least));
}

std::string SetSearch::command_line(const std::string& subcommand, const QuestionOptions& question) const {
  std::string text = "corank " + subcommand + " " + std::filesystem::path(question.file).filename().string();
  if (sigma) text += fmt::format(" --sigma {:g}", *sigma);
  if (cspace_sigma) text += fmt::format(" --cspace-sigma {:g}", *cspace_sigma);
  if (question.corank != 1) text += fmt::format(" --corank {}", question.corank);
  for (const std::string& definition : question.definitions) text += " -D '" + definition + "'";
  return text;
}

}  // namespace corank::app
