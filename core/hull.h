// Boxes that hold others.
#pragma once

#include <cstddef>
#include <span>

#include "corank/core/interval.h"

namespace corank {

/// Makes a box hold another one of as many sides or more: each side becomes the hull of both.
inline void include(std::span<Interval> hull, std::span<const Interval> box) {
  for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], box[j]);
}

}  // namespace corank
