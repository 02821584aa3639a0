// Samples of a tube's lift.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "corank/analyze/paths/path_space.h"
#include "corank/core/tube.h"

namespace corank::analyze {

/// Moves x, in units of the space's sizes, by Newton's method to the configuration in the section at t between two nodes;
/// false: it does not converge.
inline bool move_to_section(const PathSpace& space, const TubeNode& a, const TubeNode& b, double t, Eigen::VectorXd& x) {
  const auto n = static_cast<Eigen::Index>(space.size());
  const auto d = static_cast<Eigen::Index>(a.values.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Eigen::VectorXd> sizes(space.sizes().data(), n);
  const Eigen::Map<const Rows> rows_a(a.rows.data(), d, n), rows_b(b.rows.data(), d, n);
  const Eigen::Map<const Eigen::VectorXd> c_a(a.values.data(), d), c_b(b.values.data(), d);
  const Eigen::MatrixXd rows = ((1 - t) * rows_a + t * rows_b) * sizes.asDiagonal();
  const Eigen::VectorXd c = (1 - t) * c_a + t * c_b;
  double change = 1;
  for (int step = 0; step < 20 && change > 1e-13; ++step) {
    Eigen::MatrixXd jacobian(n, n);
    jacobian << space.jacobian(x), rows;
    Eigen::VectorXd f(n);
    f << space.residual(x), rows * x - c;
    const Eigen::VectorXd move = jacobian.partialPivLu().solve(f);
    x -= move;
    change = move.lpNorm<Eigen::Infinity>();
  }
  return change < 1e-9;
}

/// Follows the lift of each piece by Newton's method on the piece's own equations; false where it leaves the box, meets
/// another sign of a determinant, or what the model asks.
inline bool samples_agree(const PathSpace& space, const Tube& tube, int samples) {
  const auto n = static_cast<Eigen::Index>(space.size());
  Eigen::VectorXd x = space.middle(tube.nodes.front().box);
  const Eigen::Map<const Eigen::VectorXd> sizes(space.sizes().data(), n);
  const std::vector<int> signs = space.state(x).signs;
  const int each = samples / static_cast<int>(tube.pieces.size()) + 1;
  for (std::size_t k = 0; k < tube.pieces.size(); ++k) {
    const TubeNode &a = tube.nodes[k], &b = tube.nodes[k + 1];
    for (int s = 1; s <= each; ++s) {
      if (!move_to_section(space, a, b, static_cast<double>(s) / each, x)) return false;
      for (Eigen::Index j = 0; j < n; ++j) {
        const Interval& side = tube.pieces[k][static_cast<std::size_t>(j)];
        const double value = sizes(j) * x(j), room = 1e-12 * sizes(j);
        if (value < side.lo() - room || value > side.hi() + room) return false;
      }
      const PathSpace::State state = space.state(x);
      if (state.signs != signs || !state.inside || !(state.margin > 0)) return false;
    }
    for (Eigen::Index j = 0; j < n; ++j)
      if (const double value = sizes(j) * x(j), room = 1e-9 * sizes(j);
          value < b.box[j].lo() - room || value > b.box[j].hi() + room)
        return false;
  }
  return true;
}

}  // namespace corank::analyze
