// Turns and points of a plane as complex numbers, with angles that are coordinates; and how bodies lie in it.
#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

#include "corank/kinematics/bodies.h"

namespace corank::kinematics {

/// x + iy in constants.
struct Complex {
  ex re = 1, im = 0;
};
inline Complex operator*(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
inline Complex conjugate(const Complex& a) { return {a.re, -a.im}; }

/// k e^{iα}, α a sum of angles.
struct Turn {
  Complex k;
  ex angle = 0;
  ex cosine() const { return k.re * GiNaC::cos(angle) - k.im * GiNaC::sin(angle); }
  ex sine() const { return k.re * GiNaC::sin(angle) + k.im * GiNaC::cos(angle); }
};
inline Turn operator*(const Turn& a, const Turn& b) { return {a.k * b.k, a.angle + b.angle}; }
inline Turn inverse(const Turn& a) { return {conjugate(a.k), -a.angle}; }  // |k| = 1

/// A point of the plane: a sum of k e^{iα}, with its height over the plane. k may hold lengths.
struct PlanePoint {
  std::vector<Turn> terms;  ///< of different angles, in the order in which they came: GiNaC's differs from run to run
  ex height = 0;

  void add(const Turn& turn, const Complex& k) {
    const Complex sum = turn.k * k;
    const auto at = std::ranges::find_if(terms, [&](const Turn& term) { return term.angle.is_equal(turn.angle); });
    if (at == terms.end())
      terms.push_back({sum, turn.angle});
    else
      at->k = {at->k.re + sum.re, at->k.im + sum.im};
  }
  ex x() const {
    ex sum = 0;
    for (const Turn& term : terms) sum += term.cosine();
    return sum;
  }
  ex y() const {
    ex sum = 0;
    for (const Turn& term : terms) sum += term.sine();
    return sum;
  }
  /// x² + y² + height², squares of a cosine and its sine put together.
  ex squared() const {
    ex sum = height * height;
    for (auto a = terms.begin(); a != terms.end(); ++a) {
      sum += a->k.re * a->k.re + a->k.im * a->k.im;
      for (auto b = std::next(a); b != terms.end(); ++b)
        sum += 2 * Turn{a->k * conjugate(b->k), a->angle - b->angle}.cosine();
    }
    return sum;
  }
};
inline PlanePoint plus(PlanePoint a, const PlanePoint& b, int sign = 1) {
  for (const Turn& term : b.terms) a.add({{1, 0}, term.angle}, {sign * term.k.re, sign * term.k.im});
  a.height += sign * b.height;
  return a;
}

/// How bodies lie in a plane.
struct Plane {
  const Bodies& bodies;
  const Algebra& algebra;
  std::map<std::size_t, Mat> basis{};           ///< e1, e2 and the normal n of each group, in its frame
  std::map<std::size_t, Turn> turns{};          ///< of each group
  std::map<std::size_t, PlanePoint> origins{};  ///< of each body's frame

  /// A constant vector of a group's frame, in the plane's basis: e1 + i e2.
  Complex in_plane(std::size_t group, const Vec& v) const {
    const Mat& own = basis.at(group);
    return {algebra.clean(dot(v, own[0])), algebra.clean(dot(v, own[1]))};
  }
  PlanePoint image(std::size_t body, const Vec& v) const {
    const std::size_t group = bodies.group[body];
    PlanePoint p;
    p.add(turns.at(group), in_plane(group, v));
    p.height = dot(v, basis.at(group)[2]);
    return p;
  }
  /// A direction of a body; nothing where the body does not move in the plane.
  std::optional<Turn> direction(std::size_t body, const Vec& v) const {
    const auto turn = turns.find(bodies.group[body]);
    if (turn == turns.end()) return std::nullopt;
    return turn->second * Turn{in_plane(bodies.group[body], v)};
  }
  PlanePoint place(const BodyEnd& end) const { return plus(origins.at(end.body), image(end.body, end.point)); }
  /// Where a body's frame is whose end is at a point.
  PlanePoint origin(const PlanePoint& at, const BodyEnd& end) const { return plus(at, image(end.body, end.point), -1); }
  /// A constant vector of a body, so many times, turned.
  PlanePoint way(std::size_t body, const Vec& v, const ex& times, const Turn& by = {}) const {
    const Complex k = in_plane(bodies.group[body], v);
    PlanePoint p;
    p.add(turns.at(bodies.group[body]) * by, {times * k.re, times * k.im});
    return p;
  }
  /// +1 where turning about the joint's axis is turning about the normal.
  int sense(const BodyJoint& joint) const {
    const BodyEnd& end = joint.ends[0];
    return algebra.sign(algebra.clean(dot(end.axis, basis.at(bodies.group[end.body])[2])));
  }
  /// By what end 1's zero is turned from end 0's, about the normal.
  Turn turned(const BodyJoint& joint) const {
    const auto zero = [&](const BodyEnd& end) { return *direction(end.body, end.zero); };
    return zero(joint.ends[1]) * inverse(zero(joint.ends[0]));
  }
  /// Of a group that a joint carries which is turned by θ: its parent's turn, times e^{iθ} from zero to zero.
  Turn carried(const BodyEnd& parent, const BodyEnd& child, const Turn& theta) const {
    const std::size_t group = bodies.group[parent.body];
    const Turn turn = turns.at(group) * Turn{in_plane(group, parent.zero)} * theta *
                      Turn{conjugate(in_plane(bodies.group[child.body], child.zero))};
    return {{algebra.clean(turn.k.re), algebra.clean(turn.k.im)}, turn.angle};
  }
};

}  // namespace corank::kinematics
