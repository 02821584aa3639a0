// From a polyline on C-space, in doubles, to a tube that is proven: steps as short as the proofs need.
#pragma once

#include <optional>
#include <vector>

#include "corank/analyze/paths/path_space.h"
#include "corank/certify/tube.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

class TubeBuilder {
 public:
  using Points = std::vector<PathSpace::Point>;

  explicit TubeBuilder(const PathSpace& space);

  struct Outcome {
    std::optional<Tube> tube;
    std::size_t failed = 0;  ///< where there is none: the polyline's piece that could not be proven, from 0
  };
  /// Between two enclosed configurations along the points; the first and the last are theirs. `radius`: each piece is to be
  /// free in that distance at least.
  Outcome build(const Box& from, const Points& points, const Box& to, double radius, const solve::Control& control);

  /// Fewer points, whose way in doubles has margins no less than `share` of the polyline's least.
  Points shortcut(const Points& points, double share, const solve::Control& control) const;
  /// The points between, a step apart at most, each projected. Nothing where the way breaks off, or `accept` says no.
  template <class Accept>
  std::optional<Points> follow(const PathSpace::Point& a, const PathSpace::Point& b, double step, Accept accept) const {
    Points points;
    const double length = (b - a).norm();
    const int steps = std::max(1, static_cast<int>(length / step) + 1);
    PathSpace::Point last = a;
    for (int k = 1; k < steps; ++k) {
      PathSpace::Point x = a + (b - a) * (static_cast<double>(k) / steps);
      if (!space_.project(x) || (x - last).norm() > 3 * step || !accept(x)) return std::nullopt;
      last = x;
      points.push_back(std::move(x));
    }
    if ((b - last).norm() > 3 * step) return std::nullopt;
    return points;
  }

 private:
  struct Node {
    TubeNode node;
    PathSpace::Point point;
    Eigen::MatrixXd across;  // T, n − m rows
  };
  std::optional<Node> node(const PathSpace::Point& x, const Node* before);
  std::optional<Node> connect(Tube& tube, const Node& a, const PathSpace::Point& b, double radius, int depth,
                              const solve::Control& control);
  double widest_radius(const Box& piece, double known, double guess) const;

  const PathSpace& space_;
  certify::TubeProver prover_;
  double hope_ = 0;  // a step's length that may be proven
};

/// A way on a C-space of any dimension by sampling: RRT-Connect, two trees that grow towards samples and each other
/// (Kuffner2000), each step projected to C-space (Kingston2019). It is in doubles, and proves nothing. Its margins
/// (PathSpace::state) are at least `margin`, and its signs are those of its start. Nothing where no way was found in
/// `seconds`.
std::optional<TubeBuilder::Points> sampled_way(const PathSpace& space, const PathSpace::Point& from,
                                               const PathSpace::Point& to, double margin, double seconds,
                                               const solve::Control& control);

}  // namespace corank::analyze
