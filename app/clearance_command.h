// What the command line of corank clearance says, for its three questions: about one centre, the best centre, a map.
#pragma once

#include <string>
#include <vector>

#include "corank/analyze/center_field.h"
#include "corank/app/exit_status.h"
#include "corank/app/json_option.h"
#include "corank/app/question.h"
#include "corank/app/search_limits.h"

namespace corank::app {

struct ClearanceCommand {
  QuestionOptions question;
  SearchLimits limits{};  // one thread for each core
  std::vector<std::string> at, in, ranges, best, map;
  std::string orientation, orientation_range, orientation_of;
  std::string proof_stem, output;
  double precision = 0.01;
  int grid = 24;
  JsonOption json;
};

analyze::BallOptions ball_of(const ClearanceCommand& command);
/// Of the set forward where none is said.
study::Question question_of(const ClearanceCommand& command);
solve::Options options_of(const ClearanceCommand& command);
/// "x=[a,b]", "y=[c,d]"; for --map "x", "y" as well, the declared ranges.
std::vector<analyze::NamedRange> region_of(const std::vector<std::string>& texts, const std::string& option,
                                           const study::Question& question);

ExitStatus run_best(ClearanceCommand command);
ExitStatus run_map(ClearanceCommand command);

}  // namespace corank::app
