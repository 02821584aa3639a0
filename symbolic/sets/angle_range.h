// An angle's range [α, β] as conditions on c = cos θ and s = sin θ.
//
// Let β − α < 2π, m = (α + β)/2, h = (β − α)/2. Then θ ∈ [α, β] (mod 2π)  ⇔  cos(θ − m) ≥ cos h
//        ⇔  cos(m) c + sin(m) s ≥ cos(h),   for any h ∈ (0, π).
#pragma once

#include <optional>

#include "corank/symbolic/algebra/constant_value.h"

namespace corank::symbolic {

struct ConstantRange {
  ConstantValue lower, upper;
};

struct AngleRange {
  /// [lower, upper] ⊇ {cos θ}, {sin θ}: exact ends, the hull wherever signs of the constants involved can be decided.
  ConstantRange cosine, sine;
  /// cos(m)·c + sin(m)·s ≥ cos(h), where the range is smaller than the circle and more than one value.
  struct Chord {
    ConstantValue cos_m, sin_m, cos_h;
  };
  std::optional<Chord> chord;
  /// cos α and sin α where α = β; then there is no chord, and `cosine` and `sine` are [-1, 1].
  struct Value {
    ConstantValue cosine, sine;
  };
  std::optional<Value> value;
};

/// Requires α ≤ β. Throws std::domain_error where the bounds are absurdly large.
AngleRange angle_range(const ConstantRange& range);

}  // namespace corank::symbolic
