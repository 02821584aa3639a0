// By which factor all tolerances may grow, while every robot within them keeps something: what all such questions share.
//
// Example: if the factor is in [3.1, 3.2], tolerances of ±0.31 mm are safe where ±0.1 mm were given, and ±0.32 mm are not.
//
// A tolerance [a, b] of a constant whose nominal value is v becomes [v + s (a − v), v + s (b − v)] for the factor s. These
// are nested: robots within smaller tolerances are within larger ones. So what holds for every robot at one factor does at
// each smaller one, and a robot that falls short at one factor is there at each larger one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/clearance/clearance.h"

namespace corank::analyze {

struct FactorBounds {
  double lower = 0;             ///< proven: every robot within so many times the tolerances keeps what was asked for
  std::optional<double> upper;  ///< proven: some robot within so many times the tolerances does not; 0: that as drawn
  std::vector<CoordinateValue> tolerances;  ///< at the lower bound
  std::vector<CoordinateValue> robot;       ///< of the upper bound, its constants
  std::string reason;                       ///< why nothing more is known; empty where the bounds are as close as asked for
  std::string stopped;                      ///< what ended the work early; empty: nothing
  double precision = 0.01;                  ///< that was asked for, relative
  int steps = 0;                            ///< factors that were tried
  double seconds = 0;

  bool complete() const { return upper && *upper <= lower * (1 + precision); }
};

/// What is proven at a factor.
struct FactorStep {
  enum class Kept { yes, no, open };
  Kept kept = Kept::open;
  double factor = 0;                     ///< of which it is proven; not larger than the one that was tried where `no`
  std::vector<CoordinateValue> robot{};  ///< of `no`
  std::string obstacle{};                ///< of `open`: what is not proven
  bool ends = false;                     ///< `open`, and nothing else is to be tried: the obstacle is the result's reason
};

using FactorProgress = std::function<void(double lower, std::optional<double> upper)>;
/// "factor in [0.5, 0.75]".
std::string factor_words(double lower, std::optional<double> upper);

/// Tries factors by doubling and bisection, from 1 on. Where some are open there may be a gap: then both of its ends are
/// sought, each to the precision. `attempt` gets the question with its tolerances that many times as large; what it throws
/// of another than the first, as ModelError, is the reason for an end. `bounds`, with its precision, keeps what is known; if
/// it has an upper bound or a reason, nothing is tried. Throws as require_a_tolerance().
void search_factor(const study::Question& question,
                   const std::function<FactorStep(const study::Question& scaled, double factor)>& attempt,
                   const FactorProgress& progress, FactorBounds& bounds);

/// Throws ModelError where no constant has a tolerance.
void require_a_tolerance(const study::Question& question);

/// The question with tolerances that are so many times as large. Throws ModelError where the robots of some of them may have
/// other equations.
study::Question with_scaled_tolerances(study::Question question, double factor);

/// "factor of the tolerances in [2, 3]", the tolerances, and the robot that does not keep it: `what` that robot has, "that
/// does not keep it". For a terminal, as are the last lines.
std::string factor_lines(const FactorBounds& bounds, const std::string& what);
std::string last_lines(const FactorBounds& bounds, const std::string& effort = "");

}  // namespace corank::analyze
