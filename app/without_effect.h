// Options that another one, or the input, leaves without effect: errors of usage, which name them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace corank::app {

/// Throws UsageError where one of the options is given: "--grid: without effect; expected REASON".
void refuse_without_effect(const CLI::App& sub, const std::vector<std::string>& options, const std::string& expected);

}  // namespace corank::app
