// Which exact steps make a system shorter before it is solved? certify/reduction.h applies them, and proves what they keep.
//
// - Variables that an equation ties to one other, or to a number, are replaced; so are those that only one equation has.
// - Products that several equations share are eliminated by sums of equations (solve/reduction/product_elimination.h).
// - A multiple of one equation is added to another where that leaves fewer terms: shorter equations are tighter over boxes.
//   The rows of a kernel condition that speak of the same velocity are such.
// Numbers of more than 2,000 bits are left alone: exact arithmetic with them takes minutes, and intervals of doubles gain
// nothing by it.
#pragma once

#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/ended.h"

namespace corank::solve {

/// Which equations may define a variable.
enum class Eliminate {
  exact,  ///< all, in exact arithmetic: enclosures carry no tolerance
  /// those with integer coefficients, which carry no tolerance; the others' enclosures are widened by the tolerance
  integers
};

/// Throws std::invalid_argument where the system is not valid. Once `ended` is true the reduction is given up: the result is
/// the system as it is, without any step, which is a reduction, too. `parameters`: variables that are
/// kept, since the question is asked for each of their values.
certify::Reduction reduce(const System& system, Eliminate eliminate, const Ended& ended = {},
                          const std::vector<int>& parameters = {});

/// Eliminate::exact where the system carries no tolerance, or where it is over-determined and that ends consistent and no
/// longer so: then only `partial` needs the tolerance, every other proof is about the exact system. Else
/// Eliminate::integers.
certify::Reduction reduce(const System& system, const Ended& ended = {});

}  // namespace corank::solve
