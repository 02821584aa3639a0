#include "corank/solve/step/options.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "corank/solve/reduction/implied_equations.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/step/sigma.h"

namespace corank::solve {
namespace {

std::string format(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

void check_positive(const char* name, double value) {
  if (!(value > 0)) throw OptionError(name, format(value) + " is not a positive number");
}

void check_at_least(const char* name, const std::optional<double>& sigma, double least) {
  if (sigma && *sigma < least)
    throw OptionError(
        name, format(*sigma) + " is below " + format(least) + ", the smallest size that boxes of doubles resolve here");
}

}  // namespace

OptionError::OptionError(std::string option, std::string reason)
    : std::invalid_argument(option + ": " + reason), option_(std::move(option)), reason_(std::move(reason)) {}

void Options::validate() const {
  if (sigma) check_positive("sigma", *sigma);
  if (sigma_length) check_positive("sigma_length", *sigma_length);
  if (sigma_angle) check_positive("sigma_angle", *sigma_angle);
  check_positive("coarser", coarser);
  if (!std::isfinite(coarser)) throw OptionError("coarser", format(coarser) + " is not a finite number");
  if (threads < 0 || threads > kMostThreads)
    throw OptionError("threads", std::to_string(threads) + " is not in the range 0 to " + std::to_string(kMostThreads));
  if (!(time_limit >= 0) || !std::isfinite(time_limit))
    throw OptionError("time_limit", format(time_limit) + " is not a non-negative number");
}

void Options::validate(const System& system) const {
  validate();
  const Sigma least = smallest_sigma(system);
  const bool both = !sigma_length && !sigma_angle;
  check_at_least("sigma", sigma, both ? least.largest() : sigma_length ? least.angle : least.length);
  check_at_least("sigma_length", sigma_length, least.length);
  check_at_least("sigma_angle", sigma_angle, least.angle);
}

Control::Limits limits_of(const Options& options, const std::atomic<bool>* stop) {
  return {.time = options.time_limit,
          .boxes = options.max_boxes,
          .memory = options.memory_limit,
          .stop = stop,
          .later_bytes = 0};  // files are written without a copy
}

Sigma smallest_sigma(const System& system) {
  Sigma largest;
  for (const auto& v : system.variables) {
    const SigmaClass kind = sigma_class(v);
    if (kind == SigmaClass::length) largest.length = std::max(largest.length, v.domain.mag());
    if (kind == SigmaClass::angle) largest.angle = std::max(largest.angle, v.domain.mag());
  }
  const double share = system.dimension() == 0 ? 1e-16 : 1e-10;
  return {share * largest.length, share * largest.angle};
}

Prepared prepare(System system, const Options& options, Control& control) {
  const InStage stage(control, Stage::reduction);
  system.validate();
  options.validate(system);
  const Ended ended = [&control] { return control.ended(); };
  certify::Reduction reduction = reduce(system, ended);
  add_implied_equations(system.claimed, reduction, ended);
  return {std::move(system), std::move(reduction), options};
}

}  // namespace corank::solve
