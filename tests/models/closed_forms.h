// Closed forms for the models' singularity loci: dense samples that a cover must hold.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace corank::test {

struct Point {
  double x, y;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double k, Point a) { return {k * a.x, k * a.y}; }
};
inline double length(Point a) { return std::hypot(a.x, a.y); }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double angle_of(Point a) { return std::atan2(a.y, a.x); }
inline Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The points at distance r from a and s from b (none, or two; sign chooses).
inline std::optional<Point> intersect_circles(Point a, double r, Point b, double s, int sign) {
  const Point ab = b - a;
  const double d = length(ab);
  if (d == 0) return std::nullopt;
  const double along = (d * d + r * r - s * s) / (2 * d), square = r * r - along * along;
  if (square < 0) return std::nullopt;
  const Point u = (1 / d) * ab, normal{-u.y, u.x};
  return a + along * u + (sign * std::sqrt(square)) * normal;
}

/// Dextar: J5 = (0, 0), J1 = (d, 0), J4 = J5 + l e(θ5), J2 = J1 + l e(θ2), J3 = J2 + l e(θ3) = J4 − l e(θ4).
/// Values in the order of the algebrized model: J3x, J3y, c2, s2, c3, s3, c4, s4, c5, s5.
inline constexpr double kDextarLink = 0.9, kDextarBase = 1.18;
using DextarConfiguration = std::array<double, 10>;

inline DextarConfiguration dextar_configuration(Point j2, Point j3, Point j4) {
  const Point e2 = (1 / kDextarLink) * (j2 - Point{kDextarBase, 0}), e3 = (1 / kDextarLink) * (j3 - j2),
              e4 = (1 / kDextarLink) * (j4 - j3), e5 = (1 / kDextarLink) * j4;
  return {j3.x, j3.y, e2.x, e2.y, e3.x, e3.y, e4.x, e4.y, e5.x, e5.y};
}

inline std::vector<DextarConfiguration> dextar_cspace_samples(int n) {
  std::vector<DextarConfiguration> result;
  const double step = 2 * M_PI / n;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      for (int sign : {-1, 1}) {
        const Point j2 = Point{kDextarBase, 0} + kDextarLink * direction(0.1 + step * i),
                    j4 = kDextarLink * direction(0.2 + step * k);
        if (const auto j3 = intersect_circles(j2, kDextarLink, j4, kDextarLink, sign))
          result.push_back(dextar_configuration(j2, *j3, j4));
      }
  return result;
}

/// J2, J3, J4 aligned: stretched (|J2 J4| = 2 l) or folded (J2 = J4).
inline std::vector<DextarConfiguration> dextar_forward_samples(int n) {
  std::vector<DextarConfiguration> result;
  const Point j1{kDextarBase, 0};
  for (int i = 0; i < n; ++i)
    for (int sign : {-1, 1}) {
      const Point e = direction(0.01 + 2 * M_PI * i / n), j4 = kDextarLink * e;
      if (const auto j2 = intersect_circles(j1, kDextarLink, j4, 2 * kDextarLink, sign))
        result.push_back(dextar_configuration(*j2, 0.5 * (*j2 + j4), j4));
      if (const auto meeting = intersect_circles({0, 0}, kDextarLink, j1, kDextarLink, sign))
        result.push_back(dextar_configuration(*meeting, *meeting + kDextarLink * e, *meeting));
    }
  return result;
}

/// An arm straight or folded: J1 J2 J3 aligned (J3 on a circle of radius 2 l about J1, or J3 = J1), or J5 J4 J3.
inline std::vector<DextarConfiguration> dextar_inverse_samples(int n) {
  std::vector<DextarConfiguration> result;
  const Point j1{kDextarBase, 0}, j5{0, 0};
  for (int i = 0; i < n; ++i)
    for (int sign : {-1, 1}) {
      const Point e = direction(0.01 + 2 * M_PI * i / n);
      const auto add = [&](Point j2, Point j3) {
        if (const auto j4 = intersect_circles(j5, kDextarLink, j3, kDextarLink, sign))
          result.push_back(dextar_configuration(j2, j3, *j4));
      };
      add(j1 + kDextarLink * e, j1 + 2 * kDextarLink * e);
      add(j1 + kDextarLink * e, j1);
      const auto add_left = [&](Point j4, Point j3) {
        if (const auto j2 = intersect_circles(j1, kDextarLink, j3, kDextarLink, sign))
          result.push_back(dextar_configuration(*j2, j3, j4));
      };
      add_left(kDextarLink * e, 2 * kDextarLink * e);
      add_left(kDextarLink * e, j5);
    }
  return result;
}

}  // namespace corank::test
