// A tube: a path on the solution set of m equations in n variables, in boxes that prove it.
//
// Node k is the solution of F(x) = 0, T_k·x = c_k in its box, T_k real (n − m)×n; piece k joins nodes k and k + 1 by the
// solutions x(t), 0 ≤ t ≤ 1, of F(x) = 0, (1 − t)(T_k·x − c_k) + t (T_{k+1}·x − c_{k+1}) = 0 in its box.
#pragma once

#include <vector>

#include "corank/core/cover.h"

namespace corank {

struct TubeNode {
  std::vector<double> rows;    ///< T_k, row by row
  std::vector<double> values;  ///< c_k
  Box box;                     ///< holds the node
};

struct Tube {
  std::vector<TubeNode> nodes;
  std::vector<Box> pieces;  ///< of each two nodes that follow each other
  /// Of each piece: what is claimed of the path is claimed about its box, as far as this times sizes[j] in variable j.
  std::vector<double> radii;
  std::vector<double> sizes;  ///< of each variable, positive: 1 of sines and cosines, the same of all lengths

  /// The least of the radii; 0 where there are none.
  double radius() const {
    double least = radii.empty() ? 0 : radii.front();
    for (const double r : radii) least = r < least ? r : least;
    return least;
  }
};

}  // namespace corank
