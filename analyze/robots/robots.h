// Numbers that were counted for the robot as drawn: do they hold for every robot within its tolerances, or is there one with
// other numbers?
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "corank/analyze/clearance/clearance.h"
#include "corank/study/question.h"

namespace corank::analyze {

/// Names as in JSON, and values that are proven.
using ExactNumbers = std::vector<std::pair<std::string, int>>;

struct Robots {
  std::vector<std::string> toleranced;  ///< names of constants
  bool same = false;                    ///< proven: every robot has the numbers of the one that was drawn
  std::string obstacle;                 ///< which condition of that proof is not proven; empty where all are
  /// Of a robot within the tolerances that has other numbers than the one that was drawn, proven; empty: none is known.
  std::vector<CoordinateValue> other;
  ExactNumbers other_numbers;
};

/// The question with ranges of lengths that are the same for all robots. Where an end depends on a tolerance, the union of
/// all robots' ranges and a little more; where an end is no end of the robot as drawn, since its equations imply it, a
/// fiftieth more, since it may be one of others. `own_ends`: the names of those ends as Limit::name, which are no limits.
study::Question with_common_ranges(study::Question question, std::vector<std::string>& own_ends);

/// `obstacle`: the condition that is not proven where tolerances are divided into that many
/// parts at most, or nothing. `numbers`: of a question about one robot; those of robots at the corners of the tolerances, 16
/// at most, are compared with those of the one that was drawn. `question`: with common ranges.
Robots examine(const study::Question& question, const ExactNumbers& drawn,
               const std::function<std::string(int parts)>& obstacle,
               const std::function<ExactNumbers(const study::Question&)>& numbers, const solve::Control& control);

}  // namespace corank::analyze
