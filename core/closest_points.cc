#include "corank/core/closest_points.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "corank/core/dense.h"

namespace corank {
namespace {

using Point = Eigen::Vector3d;

Point point(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

// A point of the hull of differences, as a sum of some of them.
struct Member {
  std::size_t first, second;
  Point at;
  double weight = 0;
};

// The weights with sum 1, of any sign, of the sum of least norm.
Eigen::VectorXd flat_weights(const std::vector<Member>& members) {
  const auto n = static_cast<Eigen::Index>(members.size());
  Eigen::VectorXd weights(n);
  Eigen::MatrixXd edges(3, n - 1);
  for (Eigen::Index k = 1; k < n; ++k) edges.col(k - 1) = members[k].at - members[0].at;
  if (n > 1) weights.tail(n - 1) = least_squares(edges, -members[0].at).x;
  weights(0) = 1 - weights.tail(n - 1).sum();
  return weights;
}

// Towards the weights of least norm until one becomes 0; its member leaves.
bool step(std::vector<Member>& members) {
  const Eigen::VectorXd wanted = flat_weights(members);
  double share = 1;
  std::size_t leaves = members.size();
  for (std::size_t k = 0; k < members.size(); ++k)
    if (const double left = members[k].weight - wanted(static_cast<Eigen::Index>(k));
        wanted(static_cast<Eigen::Index>(k)) <= 0 && members[k].weight <= share * left) {
      share = left > 0 ? members[k].weight / left : 0;
      leaves = k;
    }
  for (std::size_t k = 0; k < members.size(); ++k)
    members[k].weight += share * (wanted(static_cast<Eigen::Index>(k)) - members[k].weight);
  if (leaves == members.size()) return false;
  members.erase(members.begin() + static_cast<std::ptrdiff_t>(leaves));
  return true;
}

}  // namespace

ClosestPoints closest_points(const PointsOfBodies& hulls) {
  constexpr int kSteps = 200;
  constexpr double kNear = 1e-14;  // beside the squares of distances
  std::vector<Member> members;
  Point x;
  double size = 0;
  const auto least_along = [&](auto&& value) {
    Member best{0, 0, point(hulls[0][0]) - point(hulls[1][0])};
    for (std::size_t i = 0; i < hulls[0].size(); ++i)
      for (std::size_t j = 0; j < hulls[1].size(); ++j)
        if (const Point p = point(hulls[0][i]) - point(hulls[1][j]); value(p) < value(best.at)) best = {i, j, p};
    return best;
  };
  members.push_back(least_along([&](const Point& p) {
    size = std::max(size, p.squaredNorm());
    return p.squaredNorm();
  }));
  members[0].weight = 1;
  x = members[0].at;
  for (int k = 0; k < kSteps && members.size() <= 4; ++k) {
    const Member next = least_along([&](const Point& p) { return x.dot(p); });
    const auto same = [&](const Member& m) { return m.first == next.first && m.second == next.second; };
    if (!(x.dot(next.at) < x.squaredNorm() - kNear * size) || std::ranges::any_of(members, same)) break;
    members.push_back(next);
    while (members.size() > 1 && step(members)) continue;
    x.setZero();
    for (const Member& m : members) x += m.weight * m.at;
  }
  ClosestPoints result;
  for (std::size_t b = 0; b < 2; ++b) result.weights[b].assign(hulls[b].size(), 0);
  for (const Member& m : members) {
    result.weights[0][m.first] += std::max(m.weight, 0.0);
    result.weights[1][m.second] += std::max(m.weight, 0.0);
  }
  result.distance = x.norm();
  if (result.distance * result.distance > kNear * size)
    for (std::size_t i = 0; i < 3; ++i) result.direction[i] = x(static_cast<Eigen::Index>(i)) / result.distance;
  return result;
}

std::vector<std::array<double, 3>> turn_of_direction(const PointsOfBodies& hulls, const ClosestPoints& closest,
                                                     const std::vector<PointsOfBodies>& slopes) {
  constexpr double kParallel = 1e-3;  // edges that are nearly so do not say how the direction turns about them
  const Point e = point(closest.direction);
  // e·edge = 0 of edges of the faces that hold the nearest points, and e·e = 1, differentiated.
  std::vector<std::array<std::size_t, 3>> edges;  // body, from, to
  for (std::size_t b = 0; b < 2; ++b) {
    const std::vector<double>& w = closest.weights[b];
    const std::size_t first = std::ranges::find_if(w, [](double x) { return x > 0; }) - w.begin();
    for (std::size_t i = first + 1; i < w.size(); ++i)
      if (w[i] > 0) edges.push_back({b, first, i});
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(edges.size()) + 1, 3);
  std::vector<double> lengths;
  rows.row(0) = e;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto [b, from, to] = edges[k];
    const Point edge = point(hulls[b][to]) - point(hulls[b][from]);
    lengths.push_back(edge.norm() > 0 ? edge.norm() : 1);
    rows.row(static_cast<Eigen::Index>(k) + 1) = edge / lengths[k];
  }
  std::vector<std::array<double, 3>> result;
  for (const PointsOfBodies& s : slopes) {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows.rows());
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto [b, from, to] = edges[k];
      right(static_cast<Eigen::Index>(k) + 1) = -e.dot(point(s[b][to]) - point(s[b][from])) / lengths[k];
    }
    const Eigen::VectorXd turn = least_squares(rows, right, kParallel).x;
    result.push_back({turn(0), turn(1), turn(2)});
  }
  return result;
}

}  // namespace corank
