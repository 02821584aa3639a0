// Numbers for what Robot says in expressions: rigid motions in doubles, and the motion of a joint by its ends.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>

#include "corank/kinematics/robot/robot.h"

namespace corank::kinematics {

using Numbers = std::array<double, 3>;
using Matrix = std::array<Numbers, 3>;

/// x ↦ R x + p.
struct Transform {
  Matrix r{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Numbers p{0, 0, 0};
};

inline double value(const Expression& e) {
  using Kind = Expression::Kind;
  const std::vector<Expression>& of = e.operands();
  double result = 0;
  switch (e.kind()) {
    case Kind::number: return std::stod(e.name());
    case Kind::symbol:
      if (e.name() == "pi") return M_PI;
      break;
    case Kind::sum:
      for (const Expression& x : of) result += value(x);
      return result;
    case Kind::product:
      result = 1;
      for (const Expression& x : of) result *= value(x);
      return result;
    case Kind::quotient: return value(of[0]) / value(of[1]);
    case Kind::power: return std::pow(value(of[0]), value(of[1]));
    case Kind::negation: return -value(of[0]);
    case Kind::function:
      if (e.name() == "sin") return std::sin(value(of[0]));
      if (e.name() == "cos") return std::cos(value(of[0]));
      if (e.name() == "sqrt") return std::sqrt(value(of[0]));
  }
  throw std::runtime_error("no number: " + e.text());
}

inline Numbers values(const Vector& v) { return {value(v[0]), value(v[1]), value(v[2])}; }

inline Numbers operator*(const Matrix& a, const Numbers& x) {
  Numbers result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[i] += a[i][k] * x[k];
  return result;
}

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}

inline Transform operator*(const Transform& a, const Transform& b) {
  Transform result{a.r * b.r, a.r * b.p};
  for (std::size_t i = 0; i < 3; ++i) result.p[i] += a.p[i];
  return result;
}

inline Numbers cross(const Numbers& a, const Numbers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Numbers unit(Numbers a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  for (double& x : a) x /= length;
  return a;
}

/// By an angle about a direction (Rodrigues), and by a way along it.
inline Transform turn(const Numbers& direction, double angle) {
  const Numbers u = unit(direction);
  const double c = std::cos(angle), s = std::sin(angle);
  const Matrix cross_u{{{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}}};
  Transform result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result.r[i][j] = (i == j ? c : 0) + s * cross_u[i][j] + (1 - c) * u[i] * u[j];
  return result;
}

inline Transform slide(const Numbers& direction, double way) {
  Transform result;
  result.p = unit(direction);
  for (double& x : result.p) x *= way;
  return result;
}

/// Of an end in its link: the point, the axis as z, what its zero direction leaves perpendicular to the axis as x.
inline Transform end_frame(const JointEnd& end) {
  const Numbers z = unit(values(end.axis));
  const Numbers y = unit(cross(z, values(*end.zero)));
  const Numbers x = cross(y, z);
  Transform frame{{}, values(end.point)};
  for (std::size_t i = 0; i < 3; ++i) frame.r[i] = {x[i], y[i], z[i]};
  return frame;
}

inline Transform inverse(const Transform& a) {
  Transform result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result.r[i][j] = a.r[j][i];
  result.p = result.r * a.p;
  for (double& x : result.p) x = -x;
  return result;
}

/// End 1's link in end 0's: `angle` about the axis (x, y ways across it for a planar joint), `way` along it.
inline Transform joint_motion(const Joint& joint, double angle, double way, double x = 0, double y = 0) {
  if (joint.kind == JointKind::fixed) {
    Transform pose{{}, values(joint.pose.translation)};
    for (std::size_t i = 0; i < 3; ++i) pose.r[i] = values(joint.pose.rotation[i]);
    return pose;
  }
  Transform moved = turn({0, 0, 1}, angle);
  moved.p = {x, y, way};
  return end_frame(joint.ends[0]) * moved * inverse(end_frame(joint.ends[1]));
}

}  // namespace corank::kinematics
