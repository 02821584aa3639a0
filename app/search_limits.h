// Options that several subcommands have: what ends a search, where solve::Options::validate() says which numbers make sense;
// threads and the limit of time of an analysis.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corank/solve/options.h"

namespace corank::app {

struct SearchLimits {
  int threads = 0;
  std::uint64_t max_boxes = 0, max_found = 0;
  double time_limit = 0;
  std::optional<std::uint64_t> memory_limit{};  ///< bytes; nothing: three quarters of what the machine grants

  /// --threads, --max-boxes, --max-found, --time-limit, --memory-limit. `search`: "the search" or "each search".
  void add_options(CLI::App& command, const std::string& search);
  /// Puts them into the options, which are not validated.
  void apply(solve::Options& options) const;
};

/// --threads and --time-limit, of an analysis that says what is proven by then.
void add_analysis_limits(CLI::App& command, int& threads, double& seconds,
                         const std::string& end = "End after SECONDS with what is proven by then");
/// --threads alone.
void add_threads(CLI::App& command, int& threads);
/// --time-limit alone, of a command that gives the whole of its output or none.
void add_time_limit(CLI::App& command, double& seconds, const std::string& end = "End after SECONDS, without output");

/// Throws UsageError where one of the options is given, which another one or the input leaves without effect: "--grid:
/// without effect; expected REASON".
void refuse_without_effect(const CLI::App& sub, const std::vector<std::string>& options, const std::string& expected);

}  // namespace corank::app
