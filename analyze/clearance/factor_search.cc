#include "corank/analyze/clearance/factor_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "corank/core/exact_number.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;

symbolic::Tolerance scaled(const symbolic::Constant& c, double factor) {
  const Expression s = symbolic::parse_expression(ExactNumber::dyadic(factor).text(), "factor");
  return {c.value + s * (c.tolerance->lower - c.value), c.value + s * (c.tolerance->upper - c.value)};
}

// Those tolerances, enclosed.
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

class FactorSearch {
 public:
  FactorSearch(const study::Question& question,
               const std::function<FactorStep(const study::Question& scaled, double factor)>& attempt,
               const FactorProgress& progress, FactorBounds& bounds)
      : question_(question), attempt_(attempt), progress_(progress), bounds_(bounds) {}

  // open_: the factors at which neither bound was proven, from the least to the largest.
  void run() {
    constexpr double kMost = 1024, kLeast = 1.0 / (1 << 20);
    for (double s = 1; bounds_.lower == 0 && s >= kLeast; s /= 2)
      if (!decide(s)) return;
    for (double s = 2 * bounds_.lower; bounds_.lower > 0 && fails_from() == HUGE_VAL && s <= kMost; s *= 2)
      if (!decide(s)) return;
    while (bounds_.lower > 0 && is_wide(bounds_.lower, fails_from()))
      if (!decide((bounds_.lower + fails_from()) / 2)) return;
    for (double s = 2 * open_.second; !bounds_.upper && open_.second > 0 && s <= kMost; s *= 2)
      if (!decide(s)) return;
    while (bounds_.upper && differs_above() > 0 && is_wide(differs_above(), *bounds_.upper))
      if (!decide((differs_above() + *bounds_.upper) / 2)) return;
    if (bounds_.complete()) return;
    bounds_.reason = open_.second > 0 ? fmt::format("at {} times the tolerances: {}", open_.first, obstacle_)
                     : bounds_.upper  ? fmt::format("some robot within {:g} times the tolerances does not keep it", kLeast)
                                      : fmt::format("every robot within {:g} times the tolerances keeps it", kMost);
  }

 private:
  double fails_from() const { return std::min(open_.second > 0 ? open_.first : HUGE_VAL, bounds_.upper.value_or(HUGE_VAL)); }
  double differs_above() const { return std::max(bounds_.lower, open_.second); }
  bool is_wide(double low, double high) const { return std::isfinite(high) && high > low * (1 + bounds_.precision); }

  // False: the end, for the reason that the bounds have.
  bool decide(double factor) {
    FactorStep step;
    try {
      step = attempt_(with_scaled_tolerances(question_, factor), factor);
    } catch (const symbolic::ModelError& error) {
      if (bounds_.steps == 0) throw;  // of the tolerances that were given
      bounds_.reason = fmt::format("{:g} times the tolerances: {}", factor, error.what());
      return false;
    }
    if (step.ends) {
      bounds_.reason = fmt::format("{:g} times the tolerances: {}", factor, step.obstacle);
      return false;
    }
    ++bounds_.steps;
    if (step.kept == FactorStep::Kept::yes) {
      bounds_.lower = std::max(bounds_.lower, step.factor);
    } else if (step.kept == FactorStep::Kept::no) {
      bounds_.upper = step.factor;
      bounds_.robot = step.robot;
    } else {
      open_ = {open_.second > 0 ? std::min(open_.first, factor) : factor, std::max(open_.second, factor)};
      if (open_.first == factor) obstacle_ = step.obstacle;
    }
    if (progress_) progress_(bounds_.lower, bounds_.upper);
    return true;
  }

  const study::Question& question_;
  const std::function<FactorStep(const study::Question& scaled, double factor)>& attempt_;
  const FactorProgress& progress_;
  FactorBounds& bounds_;
  std::pair<double, double> open_{0, 0};
  std::string obstacle_;
};

}  // namespace

void require_a_tolerance(const study::Question& question) {
  const auto is_wide = [&](const symbolic::Constant& c) {
    const auto at = [&](const Expression& e) { return symbolic::exact_value(question.model, e, c.name); };
    return c.tolerance && (at(c.tolerance->upper) - at(c.tolerance->lower)).sign() != 0;
  };
  if (std::ranges::none_of(question.model.constants(), is_wide))
    throw question_error(question, "no constant has a tolerance", "one at least, such as l := 0.9 ± 0.001");
}

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

void search_factor(const study::Question& question,
                   const std::function<FactorStep(const study::Question& scaled, double factor)>& attempt,
                   const FactorProgress& progress, FactorBounds& bounds) {
  const auto start = std::chrono::steady_clock::now();
  require_a_tolerance(question);
  if (!bounds.upper && bounds.reason.empty()) FactorSearch(question, attempt, progress, bounds).run();
  bounds.tolerances = scaled_tolerances(question, bounds.lower);
  bounds.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string factor_words(double lower, std::optional<double> upper) {
  return upper ? fmt::format("factor in [{:.5g}, {:.5g}]", lower, *upper) : fmt::format("factor at least {:.5g}", lower);
}

std::string factor_lines(const FactorBounds& f, const std::string& what) {
  std::string text = fmt::format("factor of the tolerances in [{}, {}]\n", rounded(f.lower, false),
                                 f.upper ? rounded(*f.upper, true) : "unknown");
  if (f.lower > 0) text += "  it is proven that every robot keeps it within\n";
  if (f.lower > 0)
    for (const CoordinateValue& v : f.tolerances)
      text += fmt::format("    {} in [{:.9g}, {:.9g}]\n", v.name, v.value.lo(), v.value.hi());
  if (!f.robot.empty()) text += fmt::format("  within the upper bound there is a robot {}, proven:\n", what);
  return text + value_lines(f.robot);
}

std::string last_lines(const FactorBounds& f, const std::string& effort) {
  return (f.reason.empty() ? "" : fmt::format("  no further: {}\n", f.reason)) +
         fmt::format("{} steps, {}{:.3f} s\n", f.steps, effort, f.seconds) + stopped_line(f.stopped);
}

}  // namespace corank::analyze
