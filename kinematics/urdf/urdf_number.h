// The decimals of a URDF file as exact numbers. Angles in decimals that mean a multiple of pi become that multiple.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "corank/kinematics/robot/robot.h"

namespace corank::kinematics {

/// A decimal and its value in the nearest double, for comparisons.
struct UrdfNumber {
  Expression value;  ///< as written; 0 and whole numbers without their decimals
  double approximate = 0;
  bool is_zero = false;
  /// Of an angle that is a multiple of half a degree, k pi/360; then `value` is that multiple.
  std::optional<int> half_degrees;
  /// "1.5708 read as pi/2" where an angle's decimal was taken for a multiple of pi; else empty.
  std::string reading;
};

/// One decimal, with or without a sign. Throws ModelError for anything else; `what` is what the number says, "the radius".
UrdfNumber urdf_number(std::string_view text, const SourceLocation& where, const std::string& what);

/// The same of an angle in radians. A decimal x of d significant digits (not counting zeros at its end) is read as the
/// multiple m of pi next to it where the digits of m, rounded or cut off, are those of x:  −½ u ≤ |m| − |x| ≤ u, u a unit of
/// the last digit of x, or, for d ≥ 15, within 2⁻⁵⁰ |x|, as a program's doubles are. The rarer m, the more digits are asked
/// for:
///   d ≥ 3: multiples of pi/2, and pi/4;  d ≥ 4: multiples of pi/8 and pi/12;  d ≥ 6: multiples of pi/360, half a degree.
/// Beyond ±4 pi a decimal is what it is.
UrdfNumber urdf_angle(std::string_view text, const SourceLocation& where, const std::string& what);

/// Three of them, separated by white space.
std::array<UrdfNumber, 3> urdf_numbers(std::string_view text, const SourceLocation& where, const std::string& what,
                                       UrdfNumber (*read)(std::string_view, const SourceLocation&, const std::string&));

/// Whole numbers for quarter turns; else functions of the positive angle, so that equal values are equal trees.
Expression exact_cos(const UrdfNumber& angle);
Expression exact_sin(const UrdfNumber& angle);

}  // namespace corank::kinematics
