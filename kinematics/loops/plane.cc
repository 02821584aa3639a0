#include "corank/kinematics/loops/plane.h"

#include <algorithm>
#include <iterator>

namespace corank::kinematics {

void PlanePoint::add(const Turn& turn, const Complex& k) {
  const Complex sum = turn.k * k;
  const auto at = std::ranges::find_if(terms, [&](const Turn& term) { return term.angle.is_equal(turn.angle); });
  if (at == terms.end())
    terms.push_back({sum, turn.angle});
  else
    at->k = {at->k.re + sum.re, at->k.im + sum.im};
}

ex PlanePoint::x() const {
  ex sum = 0;
  for (const Turn& term : terms) sum += term.cosine();
  return sum;
}

ex PlanePoint::y() const {
  ex sum = 0;
  for (const Turn& term : terms) sum += term.sine();
  return sum;
}

ex PlanePoint::squared() const {
  ex sum = height * height;
  for (auto a = terms.begin(); a != terms.end(); ++a) {
    sum += a->k.re * a->k.re + a->k.im * a->k.im;
    for (auto b = std::next(a); b != terms.end(); ++b) sum += 2 * Turn{a->k * conjugate(b->k), a->angle - b->angle}.cosine();
  }
  return sum;
}

PlanePoint shifted(PlanePoint a, const PlanePoint& b, int sign) {
  for (const Turn& term : b.terms) a.add({{1, 0}, term.angle}, {sign * term.k.re, sign * term.k.im});
  a.height += sign * b.height;
  return a;
}

Complex Plane::in_plane(std::size_t group, const Vec& v) const {
  const Mat& own = basis.at(group);
  return {algebra.clean(dot(v, own[0])), algebra.clean(dot(v, own[1]))};
}

PlanePoint Plane::image(std::size_t body, const Vec& v) const {
  PlanePoint p = way(body, v, 1);
  p.height = dot(v, basis.at(bodies.group[body])[2]);
  return p;
}

std::optional<Turn> Plane::direction(std::size_t body, const Vec& v) const {
  const auto turn = turns.find(bodies.group[body]);
  if (turn == turns.end()) return std::nullopt;
  return turn->second * Turn{in_plane(bodies.group[body], v)};
}

PlanePoint Plane::way(std::size_t body, const Vec& v, const ex& times, const Turn& by) const {
  const Complex k = in_plane(bodies.group[body], v);
  PlanePoint p;
  p.add(turns.at(bodies.group[body]) * by, {times * k.re, times * k.im});
  return p;
}

int Plane::sense(const BodyJoint& joint) const {
  const BodyEnd& end = joint.ends[0];
  return algebra.sign(algebra.clean(dot(end.axis, basis.at(bodies.group[end.body])[2])));
}

Turn Plane::turned(const BodyJoint& joint) const {
  const auto zero = [&](const BodyEnd& end) { return *direction(end.body, end.zero); };
  return zero(joint.ends[1]) * inverse(zero(joint.ends[0]));
}

Turn Plane::carried(const BodyEnd& parent, const BodyEnd& child, const Turn& theta) const {
  const std::size_t group = bodies.group[parent.body];
  const Turn turn = turns.at(group) * Turn{in_plane(group, parent.zero)} * theta *
                    Turn{conjugate(in_plane(bodies.group[child.body], child.zero))};
  return {{algebra.clean(turn.k.re), algebra.clean(turn.k.im)}, turn.angle};
}

}  // namespace corank::kinematics
