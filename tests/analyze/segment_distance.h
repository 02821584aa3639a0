// The distance of two segments in plain doubles.
#pragma once

#include <Eigen/Dense>
#include <algorithm>

namespace corank::test {

/// By clamping one parameter after the other (Ericson, Real-Time Collision Detection, 5.1.9); points are
/// segments of length 0.
inline double segment_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                               const Eigen::Vector3d& s) {
  const Eigen::Vector3d u = q - p, v = s - r, w = p - r;
  const double a = u.dot(u), e = v.dot(v), f = v.dot(w), c = u.dot(w), b = u.dot(v), den = a * e - b * b;
  double x = a > 0 && den > 1e-14 * a * e ? std::clamp((b * f - c * e) / den, 0.0, 1.0) : 0;
  double y = e > 0 ? (b * x + f) / e : 0;
  if (y < 0 || y > 1) {
    y = std::clamp(y, 0.0, 1.0);
    x = a > 0 ? std::clamp((b * y - c) / a, 0.0, 1.0) : 0;
  } else if (e == 0 && a > 0) {
    x = std::clamp(-c / a, 0.0, 1.0);
  }
  return (p + x * u - r - y * v).norm();
}

}  // namespace corank::test
