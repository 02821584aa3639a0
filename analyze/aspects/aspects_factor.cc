#include "corank/analyze/aspects/aspects_factor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "corank/analyze/clearance/ball.h"
#include "corank/analyze/clearance/json.h"
#include "corank/analyze/clearance/tolerance_factor.h"
#include "corank/analyze/robots/robots_words.h"

namespace corank::analyze {
namespace {

class AspectsFactorSearch {
 public:
  AspectsFactorSearch(const study::Question& question, const AspectsFactorOptions& options, solve::Control& control,
                      AspectsFactor& result)
      : question_(question), options_(options), control_(control), result_(result) {}

  // open_: the factors at which neither bound was proven, from the least to the largest.
  void run() {
    constexpr double kMost = 1024, kLeast = 1.0 / 1024;
    for (double s = 1; result_.lower == 0 && s >= kLeast; s /= 2)
      if (!decide(s)) return;
    for (double s = 2 * result_.lower; result_.lower > 0 && fails_from() == HUGE_VAL && s <= kMost; s *= 2)
      if (!decide(s)) return;
    while (result_.lower > 0 && is_wide(result_.lower, fails_from()))
      if (!decide((result_.lower + fails_from()) / 2)) return;
    for (double s = 2 * open_.second; !result_.upper && open_.second > 0 && s <= kMost; s *= 2)
      if (!decide(s)) return;
    while (result_.upper && differs_above() > 0 && is_wide(differs_above(), *result_.upper))
      if (!decide((differs_above() + *result_.upper) / 2)) return;
    if (result_.reason.empty() && !result_.complete())
      result_.reason = open_.second > 0 ? fmt::format("at {} times the tolerances: {}", open_.first, obstacle_)
                                        : fmt::format("every robot within {:g} times the tolerances keeps them", kMost);
  }

 private:
  double fails_from() const { return std::min(open_.second > 0 ? open_.first : HUGE_VAL, result_.upper.value_or(HUGE_VAL)); }
  double differs_above() const { return std::max(result_.lower, open_.second); }
  bool is_wide(double low, double high) const { return std::isfinite(high) && high > low * (1 + options_.precision); }

  // False: the end, for the result's reason.
  bool decide(double factor) {
    Aspects found;
    try {
      found = aspects(with_scaled_tolerances(question_, factor), {.threads = options_.threads}, control_);
    } catch (const symbolic::ModelError& error) {
      if (result_.steps == 0) throw;  // of the tolerances that were given
      result_.reason = fmt::format("{:g} times the tolerances: {}", factor, error.what());
      return false;
    }
    if (control_.ended()) {
      result_.reason = "the analysis was ended by a limit";
      return false;
    }
    ++result_.steps;
    result_.numbers = exact_numbers_of(found);
    if (result_.numbers.size() < 3) {
      result_.reason = "the numbers of the robot as drawn are not known exactly";
      return false;
    }
    const Robots& robots = found.robots.value();
    if (robots.same) {
      result_.lower = factor;
    } else if (!robots.other.empty()) {
      result_.upper = factor;
      result_.robot = robots.other;
      result_.other_numbers = robots.other_numbers;
    } else {
      open_ = {open_.second > 0 ? std::min(open_.first, factor) : factor, std::max(open_.second, factor)};
      if (open_.first == factor) obstacle_ = robots.obstacle;
    }
    if (options_.progress) options_.progress(result_.lower, result_.upper);
    return true;
  }

  const study::Question& question_;
  const AspectsFactorOptions& options_;
  solve::Control& control_;
  AspectsFactor& result_;
  std::pair<double, double> open_{0, 0};
  std::string obstacle_;
};

Json to_object(const ExactNumbers& numbers) {
  Json json = Json::object();
  for (const auto& [name, value] : numbers) json[name] = value;
  return json;
}

}  // namespace

AspectsFactor aspects_factor(const study::Question& question, const AspectsFactorOptions& options, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  require_a_tolerance(question);
  AspectsFactor result;
  result.precision = options.precision;
  AspectsFactorSearch(question, options, control, result).run();
  result.tolerances = scaled_tolerances(question, result.lower);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string to_table(const study::Question& question, const AspectsFactor& f) {
  std::string text = question.model.name() + "\n";
  text += fmt::format("every robot is to keep: {}\n", in_words(f.numbers));
  text += fmt::format("factor of the tolerances in [{}, {}]\n", f.lower, f.upper ? fmt::format("{}", *f.upper) : "unknown");
  const auto add = [&text](const CoordinateValue& v, bool range) {
    text += range ? fmt::format("    {} in [{:.9g}, {:.9g}]\n", v.name, v.value.lo(), v.value.hi())
                  : fmt::format("    {} = {:.9g}\n", v.name, v.value.mid());
  };
  if (f.lower > 0) text += "  it is proven that every robot keeps them within\n";
  if (f.lower > 0)
    for (const CoordinateValue& v : f.tolerances) add(v, true);
  if (!f.robot.empty())
    text += fmt::format("  within the upper bound there is a robot with {}, proven:\n", in_words(f.other_numbers));
  for (const CoordinateValue& v : f.robot) add(v, false);
  if (!f.reason.empty()) text += fmt::format("  no further: {}\n", f.reason);
  return text + fmt::format("{} steps, {:.3f} s\n", f.steps, f.seconds);
}

std::string to_json(const study::Question& question, const AspectsFactor& f) {
  Json json{{"model", question.model.name()}};
  json["keep"] = to_object(f.numbers);
  json["factor"] = {{"lo", f.lower}, {"hi", or_null(f.upper)}};
  json["tolerances"] = ends_of(f.tolerances);
  json["robot"] = ends_of(f.robot);
  json["other"] = f.robot.empty() ? Json() : to_object(f.other_numbers);
  json["complete"] = f.complete();
  json["reason"] = or_null(f.reason);
  json["precision"] = f.precision;
  json["steps"] = f.steps;
  json["seconds"] = f.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
