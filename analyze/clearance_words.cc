#include "corank/analyze/clearance_words.h"

#include <fmt/format.h>

#include <cmath>

namespace corank::analyze {

std::string set_of(const Ball& ball) { return symbolic::definition(ball.question.set).name; }

std::string rounded(double x, bool up) {
  if (!std::isfinite(x)) return "infinity";
  double shown = std::stod(fmt::format("{:.6g}", x));
  const double unit = x == 0 ? 0 : std::pow(10, std::floor(std::log10(std::fabs(x))) - 5);
  if (up ? shown < x : shown > x) shown += up ? unit : -unit;
  return fmt::format("{:.6g}", shown);
}

}  // namespace corank::analyze
