#include "corank/kinematics/equations/twists.h"

#include <algorithm>

namespace corank::kinematics {
namespace {

using symbolic::CoordinateKind;
using symbolic::ModelError;
using symbolic::Role;

Vec unit(std::size_t i) { return {i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0}; }

// Σ sign·rate·axis over the screws.
void add_turning(Vec& sum, const std::vector<Screw>& screws, int sign) {
  for (const Screw& s : screws)
    if (s.turns) sum = sum + (sign * s.rate) * s.axis;
}

}  // namespace

void Twists::run() {
  for (const Dyad& dyad : dyads_of(robot_, bodies_, algebra_, tree_, true)) {
    const auto outer = std::ranges::find_if(tree_.edges, [&](const TreeEdge& edge) { return edge.joint == dyad.outer; });
    if (outer == tree_.edges.end() || turned_by_output(*outer)) dyads_.push_back(dyad);
  }
  const auto in_dyad = [&](std::size_t joint) {
    return std::ranges::any_of(dyads_, [&](const Dyad& dyad) { return dyad.outer == joint; });
  };
  for (const TreeEdge& edge : tree_.edges) reach(edge);
  for (const Dyad& dyad : dyads_) turn_within(dyad);
  for (const TreeEdge& edge : tree_.edges)
    if (turned_by_output(edge) && !in_dyad(edge.joint)) close(bodies_.joints[edge.joint]);
  for (const Dyad& dyad : dyads_) close(dyad);
  for (const std::size_t j : tree_.chords)
    if (!in_dyad(j)) close(bodies_.joints[j]);
  for (const auto& [joint, from] : tree_.edges)
    if (is_rod(bodies_.joints[joint].kind)) close(bodies_.joints[joint]);
  for (const Output& output : robot_.outputs) add(output);
}

Vec Twists::axis(const BodyJoint& j, std::size_t end) { return frames_.image(group(j.ends[end].body), j.ends[end].axis); }

Vec Twists::own_axis(std::size_t j, std::size_t body) const {
  const auto& ends = bodies_.joints[j].ends;
  return ends[ends[0].body == body ? 0 : 1].axis;
}
std::array<Vec, 2> Twists::axes(const Dyad& dyad) {
  const std::size_t g = group(dyad.link);
  return {frames_.image(g, own_axis(dyad.inner.joint, dyad.link)), frames_.image(g, own_axis(dyad.outer, dyad.link))};
}

Role Twists::role(std::size_t index) const {
  const std::vector<std::size_t> joints = draft_.moving_with(index);
  if (std::ranges::any_of(joints, [&](std::size_t j) { return robot_.joints[j].actuated; })) return Role::input;
  for (const Output& output : robot_.outputs)
    if (output.kind == Output::Kind::joint && std::ranges::find(joints, output.joint) != joints.end()) return Role::output;
  return Role::passive;
}
bool Twists::has_rate(std::size_t index) const { return role(index) != Role::passive || robot_.is_coupled(index); }
ex Twists::angular(const BodyJoint& j, const std::string& suffix) {
  if (suffix.empty()) return draft_.joint_rate(j.index, "w_", CoordinateKind::angle, role(j.index));
  return draft_.rate("w_" + joint(j).name + suffix, CoordinateKind::angle, role(j.index), joint(j).where);
}
ex Twists::linear(const BodyJoint& j, const std::string& suffix) {
  if (j.kind == JointKind::prismatic) return draft_.joint_rate(j.index, "v_", CoordinateKind::length, role(j.index));
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
    case JointKind::parallelogram: {
      // The way from point to point turns about the axis: n × (p₁ − p₀) θ̇.
      const Vec way = algebra_.clean(place(j.ends[1]) - place(j.ends[0]));
      slide(angular(j), algebra_.clean(cross(axis(j, 0), way)));
      break;
    }
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
    case JointKind::slot:
      slide(linear(j), axis(j, 0));
      for (std::size_t i = 0; i < 3; ++i)  // which no motor drives
        list.push_back(
            {draft_.rate("w_" + joint(j).name + "_" + "xyz"[i], CoordinateKind::angle, Role::passive, joint(j).where),
             unit(i), place(j.ends[1]), true});
      break;
    case JointKind::spherical:
      for (std::size_t i = 0; i < 3; ++i) turn(angular(j, std::string("_") + "xyz"[i]), unit(i));
      break;
    default: break;
  }
  if (list.size() == 1) rate_of_[number(j)] = list[0].rate;
  return list;
}

// A driven joint says itself how its body turns.
const Output* Twists::turned_by_output(const TreeEdge& edge) const {
  const BodyJoint& j = bodies_.joints[edge.joint];
  if (!spherical_ || has_rate(j.index) || loops_.has(edge.joint)) return nullptr;
  for (const Output& output : robot_.outputs)
    if (output.kind == Output::Kind::orientation && bodies_.of_link[output.link] == j.ends[1 - edge.from].body)
      return &output;
  return nullptr;
}

Vec Twists::output_rates(const std::string& prefix, const Output& output, CoordinateKind kind,
                         const std::array<bool, 3>& of) {
  Vec list;
  for (std::size_t i = 0; i < 3; ++i)
    if (of[i]) list[i] = draft_.rate(prefix + "_" + output.name + "_" + "xyz"[i], kind, Role::output, output.where);
  return list;
}

void Twists::reach(const TreeEdge& edge) {
  const BodyJoint& j = bodies_.joints[edge.joint];
  const std::size_t child = j.ends[1 - edge.from].body;
  if (const Output* output = turned_by_output(edge)) {
    const Vec rates = output_rates("w", *output, CoordinateKind::angle, output->asked);
    for (std::size_t i = 0; i < 3; ++i) motion_[child].push_back({rates[i], unit(i), place(j.ends[edge.from]), true});
    return;
  }
  motion_[child] = motion_[j.ends[edge.from].body];
  for (const Dyad& dyad : dyads_)
    if (dyad.link == child) return;
  if (is_rod(j.kind)) {  // six rates, of the body that hangs on it
    const Vec at = place(j.ends[1 - edge.from]);
    const std::string& name = name_of(child);
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
  if (const PlanePart* part = loops_.of(edge.joint); part != nullptr && part->following.contains(edge.joint)) {
    const ex rate = relative_turning(*part, j);
    if (has_rate(j.index)) row(rate - angular(j), joint(j));
    motion_[child].push_back({rate, ex(edge.from == 0 ? 1 : -1) * axis(j, 0), place(j.ends[0]), true});
    return;
  }
  for (Screw s : screws(j)) {
    if (edge.from == 1) s.axis = ex(-1) * s.axis;
    motion_[child].push_back(s);
  }
}

// ω₁ − ω₀ = α a + β b; across b, along a − (a·b) b, that is α (1 − (a·b)²).
void Twists::turn_within(const Dyad& dyad) {
  const BodyJoint& j = bodies_.joints[dyad.inner.joint];
  const auto [a, b] = axes(dyad);
  const ex c = algebra_.named(algebra_.clean(dot(own_axis(dyad.inner.joint, dyad.link), own_axis(dyad.outer, dyad.link))));
  const ex square = algebra_.named(algebra_.clean(1 - c * c));
  const ex rate = dot(turning(dyad.to) - turning(dyad.from), a - c * b) / square;
  motion_[dyad.link].push_back({algebra_.clean(rate), a, place(j.ends[dyad.inner.from]), true});
}

void Twists::add_velocity(Vec& sum, const std::vector<Screw>& screws, const Vec& c, int sign) const {
  for (const Screw& s : screws)
    sum = sum + (sign * s.rate) * (s.turns ? cross(s.axis, algebra_.clean(c - s.point)) : s.axis);
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

void Twists::closing_rows(const Vec& v, const BodyJoint& j) {
  const auto closing = positions_.closing.find(number(j));
  if (closing == positions_.closing.end()) return rows(v, joint(j));
  for (const Vec& direction : closing->second) row(dot(v, direction), joint(j));
}

void Twists::close(const Dyad& dyad) {
  const Joint& of = joint(bodies_.joints[dyad.outer]);
  const auto [a, b] = axes(dyad);
  const Vec c = place(bodies_.joints[dyad.inner.joint].ends[dyad.inner.from]);
  row(dot(turning(dyad.to) - turning(dyad.from), algebra_.clean(cross(a, b))), of);
  rows(velocity(dyad.to, c) - velocity(dyad.from, c), of);
}

ex Twists::turning_in_plane(const PlanePart& part, std::size_t of) const {
  ex sum = 0;
  for (const PlanePart::Rate& r : part.turning.at(of)) sum += r.sign * rate_of_.at(r.joint);
  return sum;
}
ex Twists::relative_turning(const PlanePart& part, const BodyJoint& j) const {
  return part.sense(j) * (turning_in_plane(part, group(j.ends[1].body)) - turning_in_plane(part, group(j.ends[0].body)));
}

/// The loop's two equations along a motion: of each coordinate in them the rate is a sum of joints' rates.
void Twists::close_in_plane(const BodyJoint& j, const PlanePart& part, const std::vector<ex>& closing) {
  const Joint& of = joint(j);
  if (!is_rod(j.kind) && (keeps_orientation(j.kind) || has_rate(j.index))) {
    const ex own = screws(j)[0].rate;
    if (j.kind == JointKind::revolute) row(relative_turning(part, j) - own, of);
  }
  std::map<ex, ex, GiNaC::ex_is_less> rates;  // by the coordinate
  for (const auto& [g, angle] : part.angles) rates.emplace(angle, turning_in_plane(part, g));
  for (const auto& [joint_index, rate] : rate_of_) {
    const std::size_t index = bodies_.joints[joint_index].index;
    if (loops_.of(joint_index) == &part && positions_.coordinates[index])
      rates.emplace(draft_.symbol_of(index, *positions_.coordinates[index]), draft_.rate_of_symbol(index, rate));
  }
  for (const ex& open : closing) {
    ex sum = 0;
    for (const auto& [coordinate, rate] : rates) sum += open.diff(GiNaC::ex_to<GiNaC::symbol>(coordinate)) * rate;
    if (j.kind == JointKind::distance_variable) sum -= *positions_.coordinates[j.index] * linear(j);
    row(sum, of);
  }
}

void Twists::close(const BodyJoint& j) {
  const Joint& of = joint(j);
  if (const PlanePart* part = loops_.of(number(j)); part != nullptr && part->closings.contains(number(j)))
    return close_in_plane(j, *part, part->closings.at(number(j)));
  const std::size_t b0 = j.ends[0].body, b1 = j.ends[1].body;
  if (is_rod(j.kind)) {
    const Vec p0 = place(j.ends[0]), p1 = place(j.ends[1]);
    const Vec way = algebra_.clean(p1 - p0);
    ex work = dot(way, velocity(b1, p1) - velocity(b0, p0));
    if (is_extensible(j.kind)) work -= *positions_.coordinates[j.index] * linear(j);
    row(work, of);
    if (j.kind == JointKind::universal_rod) {
      // det(a, p, b) = 0 along a motion, where a turns with one body, b with the other, and p goes from one to the other.
      const Vec a = axis(j, 0), b = axis(j, 1);
      row(dot(cross(b, a), velocity(b1, p1) - velocity(b0, p0)) + dot(cross(a, cross(way, b)), turning(b0)) +
              dot(cross(b, cross(a, way)), turning(b1)),
          of);
    }
    return;
  }
  const Vec c = place(j.ends[0]);
  Vec turned = turning(b1) - turning(b0), moved = velocity(b1, c) - velocity(b0, c);
  if (j.kind == JointKind::spherical) {
    closing_rows(moved, j);
    return;
  }
  if (j.kind == JointKind::slot) {
    const Vec pin = place(j.ends[1]);
    closing_rows(velocity(b1, pin) - velocity(b0, pin) - linear(j) * axis(j, 0), j);
    return;
  }
  if (j.kind == JointKind::universal && role(j.index) == Role::passive) {
    row(dot(turned, cross(axis(j, 0), axis(j, 1))), of);
    closing_rows(moved, j);
    return;
  }
  if (j.kind == JointKind::planar) {
    const Vec n = axis(j, 0);
    rows(turned - angular(j) * n, of);
    row(dot(n, moved), of);
    return;
  }
  if (j.kind == JointKind::revolute && !has_rate(j.index)) {
    for (const Vec& across : frames_.across(group(b1), j.ends[1].axis)) row(dot(turned, across), of);
    closing_rows(moved, j);
    return;
  }
  const std::vector<Screw> own = screws(j);
  add_turning(turned, own, -1);
  add_velocity(moved, own, c, -1);
  rows(turned, of);
  closing_rows(moved, j);
}

void Twists::add(const Output& output) {
  const std::size_t body = bodies_.of_link[output.link];
  // As rates of the output's.
  const auto define = [&](const std::string& prefix, CoordinateKind kind, const Vec& value, const std::array<bool, 3>& of) {
    const Vec own = output_rates(prefix, output, kind, of);
    for (std::size_t i = 0; i < 3; ++i)
      if (of[i]) draft_.velocity(own[i] - value[i], "output " + output.name, output.where);
  };
  for (const TreeEdge& edge : tree_.edges)
    if (turned_by_output(edge) == &output) return;  // its rates are the link's
  switch (output.kind) {
    case Output::Kind::joint: return;
    case Output::Kind::direction: {
      // ẇ = ω × w is 0 where ω has no part across w.
      const Placement& at = bodies_.placement[output.link];
      const Vec d = algebra_.clean(algebra_.unit(at.rotation * algebra_.vector(output.point, output.where)));
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
  if (output.kind != Output::Kind::orientation) {
    const Vec& at = positions_.output_points.at(output.name);
    define("v", CoordinateKind::length, velocity(body, at), draft_.moving(output, at));
  }
  if (output.kind != Output::Kind::position) define("w", CoordinateKind::angle, turning(body), output.asked);
}

}  // namespace corank::kinematics
