// What an expression is worth where some of its names run through ranges.
#pragma once

#include <functional>
#include <optional>

#include "corank/core/interval.h"
#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// Encloses the expression. `known` encloses parts of it that it is asked about first: a name, or what does not vary.
/// Nothing where the expression has a name that is not known, is unbounded, or has another function of what varies than a
/// sum, product, quotient or square. Requires UpwardRounding::active().
std::optional<Interval> range_of(const Expression& e,
                                 const std::function<std::optional<Interval>(const Expression&)>& known);

/// The length with a search range that holds this one, and a fiftieth more: so that where its ends vary they cut nothing
/// off.
Coordinate with_range(Coordinate length, const Interval& range);

}  // namespace corank::symbolic
