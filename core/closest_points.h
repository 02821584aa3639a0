// Where two convex bodies are nearest to each other, in doubles: a guess at where to look. Nothing is proven by it.
#pragma once

#include <array>
#include <vector>

namespace corank {

using PointsOfBodies = std::array<std::vector<std::array<double, 3>>, 2>;

/// Of two convex hulls: the points Σ weights[b][i]·hulls[b][i] are the nearest ones, or nearly so.
struct ClosestPoints {
  std::array<std::vector<double>, 2> weights;  ///< none negative, at least one of each positive
  double distance = 0;
  std::array<double, 3> direction{};  ///< from the second point to the first, of length 1; 0 where they meet
};

/// Of hulls of one point or more each, finite. Wolfe's algorithm (1976) for the point of least norm, on the differences of
/// their points.
ClosestPoints closest_points(const PointsOfBodies& hulls);

/// How the direction turns with offsets, so that it stays at right angles to the faces that hold the nearest points, as far
/// as that goes: its derivatives, where `slopes` are those of the hulls' points, by each offset.
std::vector<std::array<double, 3>> turn_of_direction(const PointsOfBodies& hulls, const ClosestPoints& closest,
                                                     const std::vector<PointsOfBodies>& slopes);

}  // namespace corank
