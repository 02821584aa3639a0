// What ends a search, as options of the command line: the same for every subcommand that has them. Which numbers make sense
// is said by solve::Options::validate().
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

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

}  // namespace corank::app
