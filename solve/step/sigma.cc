#include "corank/solve/step/sigma.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace corank::solve {
namespace {

double share_of_size(int dimension, double tolerance, std::size_t variables) {
  constexpr double kCoarse = 1.0 / 20, kFew = 20;
  // Of a surface or a larger set with more sides to a box fewer boxes: what is stored and drawn does not grow with both.
  const double fewer = dimension > 1 ? std::pow(std::max(1.0, static_cast<double>(variables) / kFew), 1.0 / dimension) : 1;
  if (dimension > 0 && tolerance > 0) return kCoarse;
  switch (dimension) {
    case 0: return std::clamp(std::sqrt(tolerance), 1e-6, kCoarse);
    case 1: return 1.0 / 200;
    case 2: return fewer / 60;
    default: return fewer * std::pow(kCoarse, 3.0 / dimension);  // boxes are as many as those of three dimensions
  }
}

// The nearest of 20 numbers a decade (ISO 3, R20, to two digits): what the user reads is what was used, and hulls that
// differ by rounding, as in another unit, nearly always give the same.
double preferred_number(double x) {
  constexpr std::array<double, 21> kSeries{10, 11, 12.5, 14, 16, 18, 20, 22, 25, 28, 32,
                                           36, 40, 45,   50, 56, 63, 71, 80, 90, 100};
  const double decade = std::floor(std::log10(x));
  const double number = kSeries[std::lround(20 * (std::log10(x) - decade))];
  // A power of ten in its exact size, so that the decimal number comes out.
  return decade < 1 ? number / std::pow(10.0, 1 - decade) : number * std::pow(10.0, decade - 1);
}

}  // namespace

SigmaClass sigma_class(const Variable& variable) {
  if (variable.auxiliary) return SigmaClass::none;
  switch (variable.kind) {
    case VariableKind::length: return variable.direction ? SigmaClass::angle : SigmaClass::length;
    case VariableKind::sine:
    case VariableKind::cosine: return SigmaClass::angle;
    case VariableKind::kernel:
    case VariableKind::auxiliary:
    case VariableKind::parameter: break;
  }
  return SigmaClass::none;
}

std::vector<SigmaClass> sigma_classes(const System& system, const certify::Reduction& reduction) {
  std::vector<SigmaClass> classes;
  const auto add = [&](int j) { classes.push_back(sigma_class(system.variables[j])); };
  for (const int j : reduction.kept) add(j);
  for (const auto& definition : reduction.definitions) add(definition.variable);
  return classes;
}

double sigma_of(const Sigma& sigma, SigmaClass kind) {
  switch (kind) {
    case SigmaClass::length: return sigma.length;
    case SigmaClass::angle: return sigma.angle;
    case SigmaClass::none: break;
  }
  return HUGE_VAL;
}

Sigma default_sigma(const System& system, const Box& hull, int dimension) {
  Sigma size;
  for (std::size_t j = 0; j < hull.size(); ++j) {
    // A constant, enclosed, has no size, 0 included.
    const double least = 1e-9 * std::max(hull[j].mag(), system.variables[j].domain.mag());
    const double width = hull[j].width() > least ? hull[j].width() : 0;
    const SigmaClass kind = sigma_class(system.variables[j]);
    if (kind == SigmaClass::length) size.length = std::max(size.length, width);
    if (kind == SigmaClass::angle) size.angle = std::max(size.angle, width);
  }
  const auto share = [&](double width) {
    const double sigma = share_of_size(dimension, system.coefficient_tolerance, hull.size()) *
                         (width > 0 && std::isfinite(width) ? width : 1);
    return preferred_number(sigma);
  };
  return {share(size.length), share(size.angle)};
}

}  // namespace corank::solve
