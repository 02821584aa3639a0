#include "corank/analyze/clearance/tolerance_factor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "corank/core/exact_number.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;

constexpr double kMost = 1024, kLeast = 1.0 / (1 << 20);  // factors
constexpr std::uint64_t kMostOfStep = 2'000'000;          // boxes

symbolic::Tolerance scaled(const symbolic::Constant& c, double factor) {
  const Expression s = symbolic::parse_expression(ExactNumber::dyadic(factor).text(), "factor");
  return {c.value + s * (c.tolerance->lower - c.value), c.value + s * (c.tolerance->upper - c.value)};
}

class FactorSearch {
 public:
  FactorSearch(const study::Question& question, const BallOptions& ball, const ToleranceFactorOptions& options,
               const solve::Options& search, solve::Control& control)
      : question_(question), ball_(ball), options_(options), search_(search), control_(control) {}

  void run(ToleranceFactor& result) {
    drawn(result);
    if (result.upper || !result.reason.empty()) return;
    for (double s = 1; !closed(result); s = next(result)) {
      if (result.lower >= kMost) {
        result.reason = fmt::format("every robot within {:g} times the tolerances keeps it", kMost);
        result.complete = true;
        return;
      }
      if (s < kLeast) result.reason = "the radius is that of the robot as drawn, or nearly";
      if (!result.reason.empty() || !decide(s, result)) return;
      if (options_.progress) options_.progress(result.lower, result.upper);
    }
    result.complete = true;
  }

 private:
  bool closed(const ToleranceFactor& r) const { return r.upper && *r.upper <= r.lower * (1 + options_.precision); }

  static double next(const ToleranceFactor& r) {
    if (!r.upper) return 2 * r.lower;
    return r.lower > 0 ? (r.lower + *r.upper) / 2 : *r.upper / 4;
  }

  void drawn(ToleranceFactor& result) {
    study::Question question = question_;
    question.model = question.model.nominal();
    const Clearance found = clearance_of(question, result);
    if (options_.radius > found.ball.room)
      throw question_error(question_, fmt::format("the ball of radius {:g} leaves {}", options_.radius, found.ball.end),
                           "a smaller radius, or wider ranges");
    if (keeps(found)) return;
    if (!falls_short(found)) return stop(found, "of the robot as drawn", result);
    result.upper = 0;
    result.nearest = found.values;
    result.complete = true;
  }

  // False: the end, for the result's reason.
  bool decide(double factor, ToleranceFactor& result) {
    Clearance found;
    try {
      found = clearance_of(with_scaled_tolerances(question_, factor), result);
    } catch (const symbolic::ModelError& error) {
      if (result.steps < 2) throw;  // of the tolerances that were given
      result.reason = fmt::format("{:g} times the tolerances: {}", factor, error.what());
      return false;
    }
    if (keeps(found)) {
      result.lower = factor;
    } else if (falls_short(found)) {
      result.upper = factor;
      result.robot = found.robot;
      result.nearest = found.values;
    } else {
      stop(found, fmt::format("{:g} times the tolerances", factor), result);
      return false;
    }
    return true;
  }

  Clearance clearance_of(const study::Question& question, ToleranceFactor& result) {
    std::uint64_t most = kMostOfStep;
    if (const std::uint64_t all = control_.limits().boxes; all > 0)
      most = std::clamp<std::uint64_t>(all > result.processed ? all - result.processed : 0, 1, most);
    solve::Control part(control_.rest(0, most));
    Clearance found = clearance(question, ball_, {.precision = options_.precision, .keep = options_.radius}, search_, part);
    if (result.steps == 0) result.ball = found.ball;
    ++result.steps;
    result.processed += found.nearest.statistics.processed;
    return found;
  }

  /// Every robot, each of which has a configuration at the centre.
  bool keeps(const Clearance& c) const {
    const bool is_there = !question_.set || c.center == Clearance::Center::assembled;
    return is_there && (c.nearest.empty || c.nearest.lower >= options_.radius);
  }
  bool falls_short(const Clearance& c) const { return c.nearest.upper && *c.nearest.upper < options_.radius; }
  void stop(const Clearance& c, const std::string& where, ToleranceFactor& result) const {
    result.reason = where + ": " +
                    (!c.stopped.empty() ? "stopped by " + c.stopped
                     : question_.set && c.center != Clearance::Center::assembled
                         ? "it is not proven that every robot has a configuration at the centre"
                         : "whether the radius is kept is neither proven nor excluded");
  }

  study::Question question_;
  const BallOptions& ball_;
  const ToleranceFactorOptions& options_;
  const solve::Options& search_;
  solve::Control& control_;
};

}  // namespace

study::Question with_scaled_tolerances(study::Question question, double factor) {
  std::vector<symbolic::Parameter> wider;
  const symbolic::Mechanism drawn = question.model;
  for (const symbolic::Constant& c : drawn.constants()) {
    if (!c.tolerance) continue;
    const symbolic::Tolerance tolerance = scaled(c, factor);
    wider.push_back({c.name, tolerance.lower, tolerance.upper});
    question.model.set_constant(c.name, c.value, tolerance);
  }
  if (question.assembly) symbolic::check_conditions(drawn.nominal(), question.assembly->conditions, wider);
  return question;
}

std::vector<CoordinateValue> scaled_tolerances(const study::Question& question, double factor) {
  std::vector<CoordinateValue> list;
  for (const symbolic::Constant& c : question.model.constants()) {
    if (!c.tolerance) continue;
    const symbolic::Tolerance t = scaled(c, factor);
    const auto at = [&](const Expression& e) { return symbolic::exact_value(question.model, e, c.name).enclose(); };
    list.push_back({c.name, Interval::hull(at(t.lower), at(t.upper))});
  }
  return list;
}

void require_a_tolerance(const study::Question& question) {
  const auto is_wide = [&](const symbolic::Constant& c) {
    const auto at = [&](const Expression& e) { return symbolic::exact_value(question.model, e, c.name); };
    return c.tolerance && (at(c.tolerance->upper) - at(c.tolerance->lower)).sign() != 0;
  };
  if (std::ranges::none_of(question.model.constants(), is_wide))
    throw question_error(question, "no constant has a tolerance", "one at least, such as l := 0.9 ± 0.001");
}

ToleranceFactor tolerance_factor(const study::Question& question, const BallOptions& ball,
                                 const ToleranceFactorOptions& options, const solve::Options& search,
                                 solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  require_a_tolerance(question);
  if (!(options.radius > 0) || !std::isfinite(options.radius))
    throw question_error(question, fmt::format("the radius to keep is {}", options.radius), "a positive number");
  ToleranceFactor result;
  result.radius = options.radius;
  result.precision = options.precision;
  FactorSearch(question, ball, options, search, control).run(result);
  result.ball.question = question;
  result.tolerances = scaled_tolerances(question, result.lower);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace corank::analyze
