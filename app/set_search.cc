#include "corank/app/set_search.h"

#include <fmt/format.h>

#include <filesystem>

#include "corank/app/exit_status.h"

namespace corank::app {
namespace {

using symbolic::SingularitySet;

std::optional<double> default_for(const DefaultSigma& sigma, const certify::System& system, SingularitySet set) {
  if (system.equations.size() > system.variables.size()) return sigma.curve;
  switch (system.dimension()) {
    case 0: return std::nullopt;
    case 1: return sigma.curve;
    case 2: return set == SingularitySet::cspace ? sigma.cspace_surface : sigma.surface;
    default: return sigma.larger;
  }
}

}  // namespace

void SetSearch::add_sets(CLI::App& command) {
  command.add_option("--sets", sets, "The sets, with commas")
      ->type_name("SET[,SET...]")
      ->delimiter(',')
      ->check(CLI::IsMember(kSets))
      ->capture_default_str();
  command
      .add_option(
          "--sigma", sigma,
          fmt::format("Largest edge of a box in the sets of singularities; default: {:g} for curves, {:g} for surfaces",
                      default_sigma.curve, default_sigma.surface))
      ->check(positive_number());
  command
      .add_option("--cspace-sigma", cspace_sigma,
                  fmt::format("The same in C-space; default: {:g} for curves, {:g} for surfaces", default_sigma.curve,
                              default_sigma.cspace_surface))
      ->check(positive_number());
}

void SetSearch::add_limits(CLI::App& command) { limits.add_options(command, "each search"); }

solve::Control::Limits SetSearch::limits_beside(const solve::Options& options, std::uint64_t taken) const {
  solve::Control::Limits result = limits_of(options);
  result.later_bytes = solve::kPageBytes;
  if (result.memory > 0) result.memory = result.memory > taken ? result.memory - taken : 1;
  return result;
}

solve::Options SetSearch::options(const certify::System& system, SingularitySet set) const {
  solve::Options options;
  const std::optional<double>& asked = set == SingularitySet::cspace ? cspace_sigma : sigma;
  options.sigma = asked ? asked : default_for(default_sigma, system, set);
  if (const double least = solve::smallest_sigma(system); options.sigma && *options.sigma < least)
    throw UsageError(fmt::format("{} is below {}, what boxes of doubles resolve here", *options.sigma, least));
  limits.apply(options);
  options.proof = proof;
  return options;
}

std::string SetSearch::command_line(const std::string& subcommand, const Question& question) const {
  std::string text = "corank " + subcommand + " " + std::filesystem::path(question.file).filename().string();
  if (sigma) text += fmt::format(" --sigma {:g}", *sigma);
  if (cspace_sigma) text += fmt::format(" --cspace-sigma {:g}", *cspace_sigma);
  for (const std::string& definition : question.definitions) text += " -D '" + definition + "'";
  return text;
}

}  // namespace corank::app
