// What corank report and corank sweep share: several sets of a mechanism, each searched with the same options.
#pragma once

#include "corank/app/question.h"
#include "corank/solve/solve.h"

namespace corank::app {

struct SetSearch {
  double coarser = 1;  ///< the default of sigma, multiplied
  std::vector<std::string> sets;
  std::optional<double> sigma{}, cspace_sigma{};
  int threads = 0;
  std::uint64_t max_boxes = 0;
  double time_limit = 0;
  bool proof = false;

  /// --sets, --sigma, --cspace-sigma.
  void add_sets(CLI::App& command);
  /// --threads, --max-boxes, --time-limit.
  void add_limits(CLI::App& command);

  /// For the system of a set, without progress. Throws UsageError where sigma is smaller than boxes of doubles resolve.
  solve::Options options(const certify::System& system, symbolic::SingularitySet set) const;

  /// What a user types for sets of this size: "corank report dextar.cuik --sigma 0.1 -D 'l2=1'".
  std::string command_line(const std::string& subcommand, const Question& question) const;
};

/// Throws UsageError where sigma is smaller than boxes of doubles resolve.
void check_sigma(const std::string& option, const std::optional<double>& sigma, const certify::System& system);

}  // namespace corank::app
