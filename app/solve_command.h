// What the command line of corank solve says.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "corank/app/json_option.h"
#include "corank/app/question.h"
#include "corank/app/search_limits.h"

namespace corank::app {

struct SolveCommand {
  QuestionOptions question;
  std::optional<double> sigma, sigma_length, sigma_angle, tolerance;
  SearchLimits limits{};
  std::optional<std::uint64_t> max_solutions;
  int digits = 0;
  bool proof = false, area = false;
  std::string param_path, result_path;
  JsonOption json;
  std::string checkpoint_path, resume_path, refine_path;
  double every = 60;  ///< seconds
  bool keep_sheets = false, estimate = false;
};

/// Adds the options, which write to `command`.
void add_solve_options(CLI::App& sub, SolveCommand& command);

}  // namespace corank::app
