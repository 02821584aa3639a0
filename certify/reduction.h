// Exact simplification of a system before it is solved, and the way back.
//
// Variables that an equation defines are eliminated, equations that then hold identically or repeat another are dropped:
//   (a) a·x + b = 0 and a·x + b·y + c = 0 with rational a, b ≠ 0: x is replaced everywhere by its value;
//       Likewise a variable whose domain is one number;
//   (b) a·x + g = 0 with a rational a ≠ 0 and x in no other equation or inequality: x is g's image, whatever g is;
//   (c) f = 0 becomes f + q·g = 0 with a rational q and another equation g = 0, where that has fewer terms: shorter
//       equations are tighter over boxes. The rows of a kernel condition that speak of the same velocity are such. Before
//       that, products that several equations share are eliminated in the same way (certify/elimination.h), with any
//       rational q.
// Numbers of more than 2,000 bits are left alone: exact arithmetic with them takes minutes, and intervals of doubles gain
// nothing by it.
// Theorem: let x_e = p_e(x') be the eliminated variables' values as polynomials in the variables x' that are kept. Then
// x' ↦ (x', p(x')) is a bijection from the reduced system's solutions to the system's, and keeps boxes of values of kept
// variables. Proof:
// (a) and (b) replace the pair {x = p, f = 0} by {x = p, f(p) = 0}, have p's range in x's domain as a condition (on the
// domain of y, or as an inequality), and multiply by no polynomial; (c) keeps g, so {f + q·g = 0, g = 0} ⇔ {f = 0, g = 0}. A
// dropped equation is 0 = 0 or a rational multiple of one that is kept, for every choice of coefficients within their
// tolerance (but see Reduction::subset). So exactly one solution of the reduced system for every value of some kept
// variables means exactly one of the system's.
#pragma once

#include <vector>

#include "corank/core/ended.h"
#include "corank/core/reduction_step.h"
#include "corank/core/system.h"

namespace corank::certify {

struct Reduction {
  struct Definition {
    int variable;      ///< index in the original system
    Polynomial value;  ///< in the kept variables, by their indices in `system`
  };

  System system;                        ///< in the kept variables
  std::vector<int> kept;                ///< kept[j]: index in the original system of variable j of `system`
  std::vector<Definition> definitions;  ///< the others
  std::vector<int> origins;             ///< of each equation of `system`: its index in the original one
  int given_equations = 0;              ///< of the original system
  std::vector<ReductionStep> steps;     ///< in their order; those that eliminate are in the order of `definitions`
  bool tolerant = false;                ///< enclosures carry the coefficient tolerance
  /// An equation was dropped that holds for some choices of coefficients only, and for the others to kPartialTolerance · τ,
  /// relative to the sum of its |coefficients|: proofs about `system` are about a subset of the equations.
  bool subset = false;
  bool consistent = true;  ///< false: an equation became "a nonzero number = 0", the system has no solution

  /// The box of the original system whose kept sides are the first of `sides` and whose other sides are the rest, in the
  /// order of `definitions`.
  std::vector<Interval> lift(const std::vector<Interval>& sides) const;
};

/// Which equations may define a variable.
enum class Eliminate {
  none,
  exact,  ///< all, in exact arithmetic: enclosures carry no tolerance
  /// those with integer coefficients, which carry no tolerance; the others' enclosures are widened by the tolerance
  integers
};

/// Throws std::invalid_argument where the system is not valid. Once `ended` is true the reduction is given up: the result is
/// the system as it is, without any step, which is a reduction, too.
Reduction reduce(const System& system, Eliminate eliminate, const Ended& ended = {});

/// Eliminate::exact where the system carries no tolerance, or where it is over-determined and that ends consistent and no
/// longer so: then only `partial` needs the tolerance, every other proof is about the exact system. Else
/// Eliminate::integers.
Reduction reduce(const System& system, const Ended& ended = {});

}  // namespace corank::certify
