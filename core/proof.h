// Why a cover is complete: the search tree as a script that a checker can replay, in the variables of the reduced system
// (certify/reduction.h). A plain value; what each instruction claims is the checker's to prove, in its own arithmetic.
//
// The script acts on a current box, at first a root. In preorder: a `split` or `cut` is followed by the scripts of its
// parts, each of which ends in a leaf (empty, box, elsewhere, root). Every instruction's claim is about zeros of the system
// in the current box.
#pragma once

#include <cstdint>
#include <vector>

#include "corank/core/interval.h"

namespace corank {

struct Proof {
  enum class Step : std::uint8_t {
    row,     ///< integers: i. The box is shrunk by projections of row i (equations, then inequalities; −1 − k: implied
             ///< equation k)
    newton,  ///< integers: k. The box is shrunk by a Hansen–Sengupta step with combination k about its midpoint
    keep,   ///< integers: c, then c times 2·variable + (1: upper); reals: c bounds. The zeros lie between these bounds; the
            ///< box becomes exactly that
    split,  ///< integers: variable; reals: where. Two parts follow, the lower one first
    cut,    ///< integers: variable, c; reals: c places, ascending. c + 1 parts follow
    empty,  ///< leaf: no zero in the box
    box,    ///< leaf; integers: i. The zeros lie in box i of the cover
    elsewhere,  ///< leaf: no zero in the box; it was found so by other means than the steps before
    root,       ///< leaf; integers: r. The box lies in root r
  };
  /// Real linear combinations of equations: row a of Y·F is solved for dependent[a].
  struct Combination {
    std::vector<int> equations, dependent;
    std::vector<float> y;  ///< r×r, row-major
    friend bool operator==(const Combination&, const Combination&) = default;
  };

  std::vector<std::vector<Interval>> roots;  ///< in the kept variables; root 0 holds the search domain
  std::vector<Combination> combinations;
  std::vector<std::uint8_t> steps;  ///< each a Step; the script of root 0, then of root 1 …
  std::vector<std::int32_t> integers;
  std::vector<double> reals;

  friend bool operator==(const Proof&, const Proof&) = default;
};

}  // namespace corank
