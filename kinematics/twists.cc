#include "corank/kinematics/twists.h"

namespace corank::kinematics {
namespace {

using symbolic::CoordinateKind;
using symbolic::ModelError;
using symbolic::Role;

bool is_rod(JointKind kind) { return kind == JointKind::distance || kind == JointKind::distance_variable; }

Vec unit(std::size_t i) { return {i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0}; }

// Σ sign·rate·axis over the screws.
void add_turning(Vec& sum, const std::vector<Screw>& screws, int sign) {
  for (const Screw& s : screws)
    if (s.turns) sum = sum + (sign * s.rate) * s.axis;
}

}  // namespace

void Twists::run() {
  for (const TreeEdge& edge : tree_.edges) reach(edge);
  for (const std::size_t j : tree_.chords) close(bodies_.joints[j]);
  for (const auto& [joint, from] : tree_.edges)
    if (is_rod(bodies_.joints[joint].kind)) close(bodies_.joints[joint]);
  for (const Output& output : robot_.outputs) add(output);
}

Vec Twists::cleaned(const Vec& v) const { return {algebra_.clean(v[0]), algebra_.clean(v[1]), algebra_.clean(v[2])}; }
Vec Twists::place(const BodyEnd& end) {
  return cleaned(*positions_.origins[end.body] + frames_.image(group(end.body), end.point));
}
Vec Twists::axis(const BodyJoint& j, std::size_t end) { return frames_.image(group(j.ends[end].body), j.ends[end].axis); }

Role Twists::role(std::size_t index) const {
  if (robot_.joints[index].actuated) return Role::input;
  for (const Output& output : robot_.outputs)
    if (output.kind == Output::Kind::joint && output.joint == index) return Role::output;
  return Role::passive;
}
ex Twists::angular(const BodyJoint& j, const std::string& suffix) {
  return draft_.rate("w_" + joint(j).name + suffix, CoordinateKind::angle, role(j.index), joint(j).where);
}
ex Twists::linear(const BodyJoint& j, const std::string& suffix) {
  return draft_.rate("v_" + joint(j).name + suffix, CoordinateKind::length, role(j.index), joint(j).where);
}

/// The screws of a joint, as motions of end 1's body relative to end 0's.
std::vector<Screw> Twists::screws(const BodyJoint& j) {
  std::vector<Screw> list;
  const auto turn = [&](const ex& rate, const Vec& about) { list.push_back({rate, about, place(j.ends[0]), true}); };
  const auto slide = [&](const ex& rate, const Vec& along) { list.push_back({rate, along, {0, 0, 0}, false}); };
  switch (j.kind) {
    case JointKind::revolute: turn(angular(j), axis(j, 0)); break;
    case JointKind::prismatic: slide(linear(j), axis(j, 0)); break;
    case JointKind::cylindrical:
      turn(angular(j), axis(j, 0));
      slide(linear(j), axis(j, 0));
      break;
    case JointKind::universal:
      turn(angular(j, "_1"), axis(j, 0));
      turn(angular(j, "_2"), axis(j, 1));
      break;
    case JointKind::planar: {
      const BodyEnd& e = j.ends[0];
      turn(angular(j), axis(j, 0));
      slide(linear(j, "_x"), frames_.image(group(e.body), e.zero));
      slide(linear(j, "_y"), frames_.image(group(e.body), cross(e.axis, e.zero)));
      // About end 1's point: end 0's need not be on the axis.
      list[0].point = place(j.ends[1]);
      break;
    }
    case JointKind::spherical:
      for (std::size_t i = 0; i < 3; ++i) turn(angular(j, std::string("_") + "xyz"[i]), unit(i));
      break;
    default: break;
  }
  return list;
}

void Twists::reach(const TreeEdge& edge) {
  const BodyJoint& j = bodies_.joints[edge.joint];
  const std::size_t child = j.ends[1 - edge.from].body;
  motion_[child] = motion_[j.ends[edge.from].body];
  if (is_rod(j.kind)) {  // six rates, of the body that hangs on it
    const Vec at = place(j.ends[1 - edge.from]);
    const std::string name = robot_.links[link_of(child)].name;
    for (std::size_t i = 0; i < 3; ++i)
      motion_[child].push_back(
          {draft_.rate("w_" + name + "_" + "xyz"[i], CoordinateKind::angle, Role::passive, joint(j).where), unit(i), at,
           true});
    for (std::size_t i = 0; i < 3; ++i)
      motion_[child].push_back(
          {draft_.rate("v_" + name + "_" + "xyz"[i], CoordinateKind::length, Role::passive, joint(j).where), unit(i), at,
           false});
    return;
  }
  for (Screw s : screws(j)) {
    if (edge.from == 1) s.axis = ex(-1) * s.axis;
    motion_[child].push_back(s);
  }
}

std::size_t Twists::link_of(std::size_t body) const {
  for (std::size_t l = 0; l < robot_.links.size(); ++l)
    if (bodies_.of_link[l] == body) return l;
  return 0;
}
void Twists::add_velocity(Vec& sum, const std::vector<Screw>& screws, const Vec& c, int sign) const {
  for (const Screw& s : screws) sum = sum + (sign * s.rate) * (s.turns ? cross(s.axis, cleaned(c - s.point)) : s.axis);
}
Vec Twists::turning(std::size_t body) const {
  Vec sum{0, 0, 0};
  add_turning(sum, motion_[body], 1);
  return sum;
}
Vec Twists::velocity(std::size_t body, const Vec& c) const {
  Vec sum{0, 0, 0};
  add_velocity(sum, motion_[body], c, 1);
  return sum;
}

void Twists::row(const ex& e, const Joint& of) { draft_.velocity(e, "joint " + of.name, of.where); }
void Twists::rows(const Vec& v, const Joint& of) {
  for (const ex& e : v) row(e, of);
}

void Twists::close(const BodyJoint& j) {
  const Joint& of = joint(j);
  const std::size_t b0 = j.ends[0].body, b1 = j.ends[1].body;
  if (is_rod(j.kind)) {
    const Vec p0 = place(j.ends[0]), p1 = place(j.ends[1]);
    const Vec way = cleaned(p1 - p0);
    ex work = dot(way, velocity(b1, p1) - velocity(b0, p0));
    if (j.kind == JointKind::distance_variable) work -= *positions_.coordinate[j.index] * linear(j);
    row(work, of);
    return;
  }
  const Vec c = place(j.ends[0]);
  Vec turned = turning(b1) - turning(b0), moved = velocity(b1, c) - velocity(b0, c);
  if (j.kind == JointKind::spherical) {
    rows(moved, of);
    return;
  }
  if (j.kind == JointKind::universal && role(j.index) == Role::passive) {
    row(dot(turned, cross(axis(j, 0), axis(j, 1))), of);
    rows(moved, of);
    return;
  }
  if (j.kind == JointKind::planar) {
    const Vec n = axis(j, 0);
    rows(turned - angular(j) * n, of);
    row(dot(n, moved), of);
    return;
  }
  if (j.kind == JointKind::revolute && role(j.index) == Role::passive) {
    for (const Vec& across : frames_.across(group(b1), j.ends[1].axis)) row(dot(turned, across), of);
    rows(moved, of);
    return;
  }
  const std::vector<Screw> own = screws(j);
  add_turning(turned, own, -1);
  add_velocity(moved, own, c, -1);
  rows(turned, of);
  rows(moved, of);
}

void Twists::add(const Output& output) {
  const std::size_t body = bodies_.of_link[output.link];
  const auto rates = [&](const std::string& prefix, CoordinateKind kind) {
    Vec list;
    for (std::size_t i = 0; i < 3; ++i)
      list[i] = draft_.rate(prefix + "_" + output.name + "_" + "xyz"[i], kind, Role::output, output.where);
    return list;
  };
  const auto defined = [&](const Vec& own, const Vec& value) {
    for (std::size_t i = 0; i < 3; ++i) draft_.velocity(own[i] - value[i], "output " + output.name, output.where);
  };
  switch (output.kind) {
    case Output::Kind::joint: return;
    case Output::Kind::direction: {
      // ẇ = ω × w is 0 where ω has no part across w.
      const Placement& at = bodies_.placement[output.link];
      const Vec d = cleaned(algebra_.unit(at.rotation * algebra_.vector(output.point, output.where)));
      int i = 0;
      for (const Vec& across : frames_.across(group(body), d))
        draft_.velocity(
            draft_.rate("w_" + output.name + "_" + std::to_string(++i), CoordinateKind::angle, Role::output, output.where) -
                dot(turning(body), across),
            "output " + output.name, output.where);
      return;
    }
    default: break;
  }
  if (output.kind != Output::Kind::orientation)
    defined(rates("v", CoordinateKind::length), velocity(body, positions_.output_points.at(output.name)));
  if (output.kind != Output::Kind::position) defined(rates("w", CoordinateKind::angle), turning(body));
}

}  // namespace corank::kinematics
