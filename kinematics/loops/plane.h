// Turns and points of a plane as complex numbers, with angles that are coordinates; and how bodies lie in it.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "corank/kinematics/loops/bodies.h"

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
  /// With cos a in place of cos(-a), -sin a in place of sin(-a), a a coordinate.
  ex cosine() const { return k.re * GiNaC::cos(size()) - sign() * k.im * GiNaC::sin(size()); }
  ex sine() const { return sign() * k.re * GiNaC::sin(size()) + k.im * GiNaC::cos(size()); }

 private:
  int sign() const { return GiNaC::is_a<GiNaC::symbol>(-angle) ? -1 : 1; }
  ex size() const { return sign() * angle; }
};
inline Turn operator*(const Turn& a, const Turn& b) { return {a.k * b.k, a.angle + b.angle}; }
inline Turn inverse(const Turn& a) { return {conjugate(a.k), -a.angle}; }  // |k| = 1

/// A point of the plane: a sum of k e^{iα}, with its height over the plane. k may hold lengths.
struct PlanePoint {
  std::vector<Turn> terms;  ///< of different angles, in the order in which they came: GiNaC's differs from run to run
  ex height = 0;

  void add(const Turn& turn, const Complex& k);
  ex x() const;
  ex y() const;
  /// x² + y² + height², squares of a cosine and its sine put together.
  ex squared() const;
};
PlanePoint shifted(PlanePoint a, const PlanePoint& b, int sign = 1);

/// How bodies lie in a plane.
struct Plane {
  const Bodies& bodies;
  const Algebra& algebra;
  std::map<std::size_t, Mat> basis{};           ///< e1, e2 and the normal n of each group, in its frame
  std::map<std::size_t, Turn> turns{};          ///< of each group
  std::map<std::size_t, PlanePoint> origins{};  ///< of each body's frame

  /// A constant vector of a body, with its height.
  PlanePoint image(std::size_t body, const Vec& v) const;
  /// A direction of a body; nothing where the body does not move in the plane.
  std::optional<Turn> direction(std::size_t body, const Vec& v) const;
  PlanePoint place(const BodyEnd& end) const { return shifted(origins.at(end.body), image(end.body, end.point)); }
  /// Where a body's frame is whose end is at a point.
  PlanePoint origin(const PlanePoint& at, const BodyEnd& end) const { return shifted(at, image(end.body, end.point), -1); }
  /// A constant vector of a body, multiplied by `times` and turned.
  PlanePoint way(std::size_t body, const Vec& v, const ex& times, const Turn& by = {}) const;
  /// +1 where turning about the joint's axis is turning about the normal.
  int sense(const BodyJoint& joint) const;
  /// By what end 1's zero is turned from end 0's, about the normal.
  Turn turned(const BodyJoint& joint) const;
  /// The turn of a group that a joint carries, where the joint is turned by θ: its parent's, times e^{iθ} from zero to zero.
  Turn carried(const BodyEnd& parent, const BodyEnd& child, const Turn& theta) const;

 private:
  /// A constant vector of a group's frame, in the plane's basis: e1 + i e2.
  Complex in_plane(std::size_t group, const Vec& v) const;
};

}  // namespace corank::kinematics
