#include <algorithm>
#include <chrono>
#include <limits>
#include <random>

#include "corank/analyze/paths/tube_builder.h"

namespace corank::analyze {
namespace {

using Point = PathSpace::Point;

// Configurations that a way joins to its first one, each near its parent.
class Tree {
 public:
  explicit Tree(Point root) : points_{std::move(root)}, parents_{0} {}

  const Point& operator[](std::size_t node) const { return points_[node]; }
  std::size_t add(Point x, std::size_t parent) {
    points_.push_back(std::move(x));
    parents_.push_back(parent);
    return points_.size() - 1;
  }
  std::size_t nearest(const Point& x) const {
    std::size_t best = 0;
    double least = (points_[0] - x).squaredNorm();
    for (std::size_t k = 1; k < points_.size(); ++k)
      if (const double distance = (points_[k] - x).squaredNorm(); distance < least) least = distance, best = k;
    return best;
  }
  /// From a node to the root.
  TubeBuilder::Points way(std::size_t node) const {
    TubeBuilder::Points points{points_[node]};
    while (node != 0) points.push_back(points_[node = parents_[node]]);
    return points;
  }

 private:
  TubeBuilder::Points points_;
  std::vector<std::size_t> parents_;
};

}  // namespace

std::optional<TubeBuilder::Points> sampled_way(const PathSpace& space, const Point& from, const Point& to, double margin,
                                               double seconds, const solve::Control& control) {
  constexpr double kStep = 0.05, kReach = 1.5;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  const std::vector<int> signs = space.state(from).signs;
  // Grows the tree from a node in steps towards the configuration x, as far as these come nearer; the last node.
  const auto grow = [&](Tree& tree, std::size_t node, const Point& x, double reach) {
    double left = (x - tree[node]).norm();
    for (double gone = 0; gone < reach && left > 0; gone += kStep) {
      Point next = x;
      if (left > kStep) {
        next = tree[node] + (x - tree[node]) * (kStep / left);
        if (!space.project(next) || (next - tree[node]).norm() > 2 * kStep) break;
      }
      const double still = (x - next).norm();
      if (still >= left || !space.admits(next, signs, margin)) break;
      node = tree.add(std::move(next), node);
      left = still;
    }
    return node;
  };
  std::mt19937_64 random(1);  // the same way each time
  const auto sample = [&] {
    Point x(space.size());
    for (int j = 0; j < space.size(); ++j) {
      const Interval& side = space.system().variables[j].domain;
      x[j] = std::uniform_real_distribution(side.lo(), side.hi())(random) / space.sizes()[j];
    }
    return x;
  };
  Tree from_start(from), from_goal(to);
  for (bool forward = true; std::chrono::steady_clock::now() < end && !control.ended(); forward = !forward) {
    Point x = sample();
    if (!space.project(x)) continue;
    Tree &near = forward ? from_start : from_goal, &far = forward ? from_goal : from_start;
    const std::size_t reached = grow(near, near.nearest(x), x, kReach);
    const Point middle = near[reached];
    const std::size_t met = grow(far, far.nearest(middle), middle, std::numeric_limits<double>::infinity());
    if (far[met] != middle) continue;
    TubeBuilder::Points way = near.way(reached), rest = far.way(met);
    std::ranges::reverse(way);
    way.insert(way.end(), rest.begin() + 1, rest.end());
    if (!forward) std::ranges::reverse(way);
    return way;
  }
  return std::nullopt;
}

}  // namespace corank::analyze
