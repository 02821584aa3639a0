#include "corank/analyze/clearance/tolerance_factor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corank::analyze {
namespace {

constexpr std::uint64_t kMostOfStep = 2'000'000;  // boxes

class KeptRadius {
 public:
  KeptRadius(const study::Question& question, const BallOptions& ball, const ToleranceFactorOptions& options,
             const solve::Options& search, solve::Control& control, ToleranceFactor& result)
      : question_(question), ball_(ball), options_(options), search_(search), control_(control), result_(result) {}

  void try_drawn() {
    study::Question question = question_;
    question.model = question.model.nominal();
    const Clearance found = clearance_of(question);
    result_.ball = found.ball;
    if (options_.radius > found.ball.room)
      throw question_error(question_, fmt::format("the ball of radius {:g} leaves {}", options_.radius, found.ball.end),
                           "a smaller radius, or wider ranges");
    if (keeps(found)) return;
    if (!falls_short(found)) {
      result_.reason = "of the robot as drawn: " + obstacle_of(found);
      result_.stopped = found.stopped;
      return;
    }
    result_.upper = 0;
    result_.nearest = found.values;
  }

  FactorStep try_at(const study::Question& scaled, double factor) {
    const Clearance found = clearance_of(scaled);
    if (keeps(found)) return {FactorStep::Kept::yes, factor};
    if (!falls_short(found)) {
      result_.stopped = found.stopped;
      return {.obstacle = obstacle_of(found), .ends = !found.stopped.empty()};
    }
    result_.nearest = found.values;
    return {FactorStep::Kept::no, factor, found.robot};
  }

 private:
  Clearance clearance_of(const study::Question& question) {
    std::uint64_t most = kMostOfStep;
    if (const std::uint64_t all = control_.limits().boxes; all > 0)
      most = std::clamp<std::uint64_t>(all > result_.processed ? all - result_.processed : 0, 1, most);
    solve::Control part(control_.rest(0, most));
    Clearance found = clearance(question, ball_, {.precision = options_.precision, .keep = options_.radius}, search_, part);
    result_.processed += found.nearest.statistics.processed;
    return found;
  }

  /// Every robot, each of which has a configuration at the centre.
  bool keeps(const Clearance& c) const {
    const bool is_there = !question_.set || c.center == Clearance::Center::assembled;
    return is_there && (c.nearest.empty || c.nearest.lower >= options_.radius);
  }
  bool falls_short(const Clearance& c) const { return c.nearest.upper && *c.nearest.upper < options_.radius; }
  std::string obstacle_of(const Clearance& c) const {
    return !c.stopped.empty() ? "stopped by " + c.stopped
           : question_.set && c.center != Clearance::Center::assembled
               ? "it is not proven that every robot has a configuration at the centre"
               : "whether the radius is kept is neither proven nor excluded";
  }

  const study::Question& question_;
  const BallOptions& ball_;
  const ToleranceFactorOptions& options_;
  const solve::Options& search_;
  solve::Control& control_;
  ToleranceFactor& result_;
};

}  // namespace

ToleranceFactor tolerance_factor(const study::Question& question, const BallOptions& ball,
                                 const ToleranceFactorOptions& options, const solve::Options& search,
                                 solve::Control& control) {
  if (!(options.radius > 0) || !std::isfinite(options.radius))
    throw question_error(question, fmt::format("the radius to keep is {}", options.radius), "a positive number");
  ToleranceFactor result;
  result.radius = options.radius;
  result.precision = options.precision;
  require_a_tolerance(question);
  KeptRadius kept(question, ball, options, search, control, result);
  kept.try_drawn();
  const auto attempt = [&kept](const study::Question& scaled, double factor) { return kept.try_at(scaled, factor); };
  search_factor(question, attempt, options.progress, result);
  result.ball.question = question;
  if (result.stopped.empty()) result.stopped = solve::stopped_by(control);
  return result;
}

}  // namespace corank::analyze
