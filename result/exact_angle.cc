#include "corank/result/exact_angle.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "corank/certify/algebraic_number.h"

namespace corank::result {
namespace {

/// The cosine of kπ/12 for the multiples of π/6 and π/4, as exact_coordinate() writes it.
std::optional<std::string> cosine_of_twelfths(int k) {
  k = ((k % 24) + 24) % 24;
  const int acute = k <= 6 ? k : k < 18 ? std::abs(12 - k) : 24 - k;  // |cos| is that of this one
  const auto half_root = [](int n) { return ExactNumber::rational("1/2") * ExactNumber::apply(ConstantFunction::sqrt, n); };
  ExactNumber value;
  switch (acute) {
    case 0: value = 1; break;
    case 2: value = half_root(3); break;
    case 3: value = half_root(2); break;
    case 4: value = ExactNumber::rational("1/2"); break;
    case 6: return "0";
    default: return std::nullopt;
  }
  return (k > 6 && k < 18 ? -value : value).text();
}

int turns(const Interval& enclosure, double angle) {
  return static_cast<int>(std::lround((enclosure.mid() - angle) / (2 * std::numbers::pi)));
}

}  // namespace

std::optional<std::string> exact_coordinate(const ExactPoint& point, int variable) {
  const RationalPolynomial& x = point.coordinates[static_cast<std::size_t>(variable)];
  if (x.empty()) return std::nullopt;
  try {
    return certify::text({point.polynomial, point.lower, point.upper}, x);
  } catch (const std::invalid_argument&) {  // no polynomial with one root in the interval
    return std::nullopt;
  } catch (const std::domain_error&) {  // numbers of too many bits
    return std::nullopt;
  }
}

std::optional<std::string> multiple_of_pi(const ExactPoint& point, const Angle& angle, const Interval& enclosure) {
  const auto cosine = exact_coordinate(point, angle.cosine), sine = exact_coordinate(point, angle.sine);
  if (!cosine || !sine) return std::nullopt;
  for (int k = -11; k <= 12; ++k) {
    if (cosine_of_twelfths(k) != cosine || cosine_of_twelfths(k - 6) != sine) continue;
    const int twelfths = k + 24 * turns(enclosure, k * std::numbers::pi / 12);
    if (twelfths == 0) return "0";
    const int common = std::gcd(twelfths, 12), top = std::abs(twelfths / common), bottom = 12 / common;
    return fmt::format("{}{}pi{}", twelfths < 0 ? "-" : "", top == 1 ? "" : fmt::format("{}*", top),
                       bottom == 1 ? "" : fmt::format("/{}", bottom));
  }
  return std::nullopt;
}

std::optional<std::string> exact_angle(const ExactPoint& point, const Angle& angle, const Interval& enclosure) {
  if (const auto multiple = multiple_of_pi(point, angle, enclosure)) return multiple;
  const auto cosine = exact_coordinate(point, angle.cosine), sine = exact_coordinate(point, angle.sine);
  if (!cosine || !sine) return std::nullopt;
  const certify::AlgebraicNumber t(point.polynomial, point.lower, point.upper);
  const auto middle = [&](int v) { return t.enclose(point.coordinates[static_cast<std::size_t>(v)]).mid(); };
  const int k = turns(enclosure, std::atan2(middle(angle.sine), middle(angle.cosine)));
  const std::string base = fmt::format("atan2({}, {})", *sine, *cosine);
  return k == 0 ? base : fmt::format("{} {} {}*pi", base, k < 0 ? "-" : "+", 2 * std::abs(k));
}

}  // namespace corank::result
