#include "corank/kinematics/equations/frames.h"

#include <algorithm>
#include <cmath>

namespace corank::kinematics {
namespace {

using GiNaC::cos;
using GiNaC::sin;
using symbolic::ModelError;

bool shares_axis(JointKind kind) {
  return kind == JointKind::revolute || kind == JointKind::cylindrical || kind == JointKind::planar;
}

}  // namespace

Frames::Frames(const Drafter& drafter, PlaneLoops& loops)
    : Drafter(drafter),
      loops_(loops),
      frames_(bodies_.groups),
      axes_(bodies_.joints.size()),
      aligned_(bodies_.joints.size(), false),
      angles_(robot_.joints.size()) {
  const Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  frames_[0] = Frame{{x, y}, {x, y}, z, false};
}

std::string Frames::name_of_group(std::size_t group) const {
  for (std::size_t l = 0; l < robot_.links.size(); ++l)
    if (bodies_.group[bodies_.of_link[l]] == group) return robot_.links[l].name;
  return "link";
}

// Linear, with two terms at most in each component.
bool Frames::is_simple(const Vec& v) const {
  const auto is_linear = [&](const ex& term) {
    int degree = 0;
    for (const ex& f : symbolic::parts_of<GiNaC::mul>(term))
      if (!algebra_.is_constant(f)) degree += GiNaC::is_a<GiNaC::power>(f) ? 2 : 1;
    return degree <= 1;
  };
  return std::ranges::all_of(v, [&](const ex& component) {
    const GiNaC::exvector terms = symbolic::parts_of<GiNaC::add>(component.expand());
    return terms.size() <= 2 && std::ranges::all_of(terms, is_linear);
  });
}

Vec Frames::simplified(const Vec& v, const std::string& name, const SourceLocation& where) {
  const Vec clean = algebra_.clean(v);
  if (is_simple(clean)) return clean;
  const Vec w = draft_.vector(name, where);
  for (std::size_t i = 0; i < 3; ++i) draft_.equation(w[i] - clean[i], name, where);
  return w;
}

Vec Frames::coefficients(std::size_t group, const Vec& v) const {
  const auto& [g0, g1] = frames_[group]->own;
  const auto clean = [&](const ex& e) { return algebra_.named(algebra_.clean(e)); };
  const ex c = clean(dot(g0, g1)), a0 = dot(v, g0), a1 = dot(v, g1), a2 = dot(v, cross(g0, g1));
  if (c.is_zero()) return {clean(a0), clean(a1), clean(a2)};
  const ex square = clean(1 - c * c);
  return {clean(clean(a0 - c * a1) / square), clean(clean(a1 - c * a0) / square), clean(clean(a2) / square)};
}

Vec Frames::direction(std::size_t group, std::size_t i) {
  Frame& frame = *frames_[group];
  if (i > 0 && frame.is_product && !finished_) {
    frame.world[1] = simplified(frame.world[1], "u_" + name_of_group(group), {});
    frame.is_product = false;
  }
  if (i < 2) return frame.world[i];
  if (!frame.third) {
    const Vec product = cross(frame.world[0], frame.world[1]);
    if (finished_) return product;
    frame.third = simplified(product, "n_" + name_of_group(group), {});
  }
  return *frame.third;
}

Vec Frames::image(std::size_t group, const Vec& v) {
  const Vec c = coefficients(group, v);
  Vec sum{0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    if (!algebra_.is_zero(c[i])) sum = sum + c[i] * direction(group, i);
  return algebra_.clean(sum);
}

std::array<Vec, 2> Frames::across(std::size_t group, const Vec& v) {
  const auto& own = directions(group);
  const Vec& b = algebra_.are_parallel(own[1], v) ? own[0] : own[1];
  const ex c = algebra_.named(algebra_.clean(dot(v, b)));
  return {image(group, cross(v, b)), image(group, c * v - b)};
}

Vec Frames::axis(std::size_t j, std::size_t end) {
  if (!axes_[j]) {
    const BodyEnd& e = bodies_.joints[j].ends[end];
    const Joint& of = joint(bodies_.joints[j]);
    axes_[j] = simplified(image(group(e.body), e.axis), "axis_" + of.name, of.where);
  }
  return *axes_[j];
}

std::vector<Frames::Candidate> Frames::candidates(std::size_t group) const {
  std::vector<Candidate> list;
  for (std::size_t j = 0; j < bodies_.joints.size(); ++j)
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const BodyEnd& e = bodies_.joints[j].ends[end];
      if (bodies_.group[e.body] == group && !algebra_.is_zero(e.axis)) list.push_back({e.axis, j, end});
    }
  // Axes that are known already come first: they need no new coordinates.
  std::ranges::stable_sort(list, [&](const Candidate& a, const Candidate& b) {
    const auto rank = [&](const Candidate& c) {
      const BodyJoint& j = bodies_.joints[*c.joint];
      if (!shares_axis(j.kind)) return 2;
      return axes_[*c.joint] || has_frame(bodies_.group[j.ends[1 - c.end].body]) ? 0 : 1;
    };
    return rank(a) < rank(b);
  });
  // Ways between joints, where they are rational: what is a sum of three directions else is a multiple of one.
  for (const BodyJoint& a : bodies_.joints)
    for (const BodyEnd& p : a.ends)
      for (const BodyJoint& b : bodies_.joints)
        for (const BodyEnd& q : b.ends) {
          if (&a == &b || p.body != q.body || bodies_.group[p.body] != group) continue;
          const Vec way = q.point - p.point;
          if (algebra_.is_zero(way)) continue;
          const Vec along = algebra_.unit(way);
          if (std::ranges::all_of(along, [](const ex& e) { return GiNaC::is_a<GiNaC::numeric>(e); }))
            list.push_back({along, {}, 0});
        }
  return list;
}

void Frames::complete(std::size_t group, const Vec& own, const Vec& world, const SourceLocation& where) {
  const auto finish = [&](const Vec& second_own, const Vec& second_world) {
    frames_[group] = Frame{{own, second_own}, {world, second_world}, {}, false};
  };
  const auto with_angle_to_first = [&](const Vec& second_own, const Vec& second_world) {
    draft_.equation(dot(world, second_world) - dot(own, second_own), "angle in " + name_of_group(group), where);
    finish(second_own, second_world);
  };
  for (const Candidate& c : candidates(group)) {
    if (algebra_.are_parallel(c.own, own)) continue;
    if (!c.joint || !shares_axis(bodies_.joints[*c.joint].kind)) {
      with_angle_to_first(c.own, draft_.unit_vector("u_" + name_of_group(group), where));
      return;
    }
    const BodyJoint& j = bodies_.joints[*c.joint];
    const bool known = axes_[*c.joint].has_value(), far = has_frame(bodies_.group[j.ends[1 - c.end].body]);
    if (!known && far && bodies_.group[j.ends[1 - c.end].body] != group) axis(*c.joint, 1 - c.end);
    if (!axes_[*c.joint]) axes_[*c.joint] = draft_.unit_vector("axis_" + joint(j).name, joint(j).where);
    if (far || known) aligned_[*c.joint] = true;
    with_angle_to_first(c.own, *axes_[*c.joint]);
    return;
  }
  with_angle_to_first(algebra_.perpendicular(own), draft_.unit_vector("u_" + name_of_group(group), where));
}

void Frames::start_free(std::size_t group, const SourceLocation& where) {
  for (const Candidate& c : candidates(group)) {
    if (c.joint && axes_[*c.joint]) continue;  // known: left for the second
    if (c.joint && shares_axis(bodies_.joints[*c.joint].kind)) {
      if (has_frame(bodies_.group[bodies_.joints[*c.joint].ends[1 - c.end].body])) continue;
      axes_[*c.joint] = draft_.unit_vector("axis_" + joint(bodies_.joints[*c.joint]).name, where);
      complete(group, c.own, *axes_[*c.joint], where);
    } else {
      complete(group, c.own, draft_.unit_vector("w_" + name_of_group(group), where), where);
    }
    return;
  }
  complete(group, {1, 0, 0}, draft_.unit_vector("w_" + name_of_group(group), where), where);
}

Frames::CosineSine Frames::own_angle(std::size_t index) {
  const Draft::JointCoordinate theta = draft_.joint_angle(index, robot_.joints[index].name);
  angles_[index] = theta.value();
  const ex c = cos(theta.moving), s = sin(theta.moving);
  if (theta.offset.is_zero()) return {c, s};
  const ex c0 = algebra_.named(algebra_.clean(cos(theta.offset))), s0 = algebra_.named(algebra_.clean(sin(theta.offset)));
  return {c0 * c - s0 * s, s0 * c + c0 * s};
}

void Frames::turn_by_angle(const TreeEdge& edge) {
  const BodyJoint& j = bodies_.joints[edge.joint];
  const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
  const std::size_t from = group(parent.body), turned_group = group(child.body);
  const Joint& of = joint(j);
  const CosineSine theta = own_angle(j.index);
  const Vec along = axis(edge.joint, edge.from);
  const int sign = edge.from == 0 ? 1 : -1;
  const Vec turned =
      theta.cosine * image(from, parent.zero) + (sign * theta.sine) * image(from, cross(parent.axis, parent.zero));
  frames_[turned_group] =
      Frame{{child.axis, child.zero}, {along, simplified(turned, "u_" + name_of_group(turned_group), of.where)}, {}, false};
  aligned_[edge.joint] = true;
}

bool Frames::turn_in_plane(const TreeEdge& edge) {
  PlanePart* const part = loops_.of(edge.joint);
  const BodyJoint& j = bodies_.joints[edge.joint];
  if (part == nullptr || is_rod(j.kind)) return false;
  const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
  const std::size_t from = group(parent.body), turned = group(child.body);
  if (!part->root) {
    part->root = parent.body;
    part->reached.insert(parent.body);
    part->turns[from] = {};
    part->turning[from] = {};
  }
  if (!part->reached.contains(parent.body)) return false;
  if (from == turned || part->turns.contains(turned)) {
    part->reached.insert(child.body);
    if (from == turned) return true;
    part->following.insert(edge.joint);
    close_in_plane(j, *part);
    return true;
  }
  if (has_frame(turned)) return false;
  const Joint& of = joint(j);
  const int sign = part->sense(j) * (edge.from == 0 ? 1 : -1);
  if (robot_.is_asked_for(j.index) || (part->turns.at(from).angle.is_zero() && of.range())) {
    const Draft::JointCoordinate theta = draft_.joint_angle(j.index, of.name);
    angles_[j.index] = theta.value();
    part->turns[turned] = part->carried(parent, child, theta.turn(sign));
  } else {
    part->angles[turned] = draft_.angle("phi_" + name_of_group(turned), {}, of.where);
    part->turns[turned] = {{1, 0}, part->angles.at(turned)};
  }
  part->turning[turned] = part->turning.at(from);
  part->turning[turned].push_back({edge.joint, sign});
  part->reached.insert(child.body);
  const std::size_t carrier = group(*part->root);
  const Mat &there = part->basis.at(carrier), &own = part->basis.at(turned);
  const Turn& turn = part->turns.at(turned);
  const Vec u = turn.cosine() * image(carrier, there[0]) + turn.sine() * image(carrier, there[1]);
  if (!part->normal) part->normal = simplified(image(carrier, there[2]), "axis_" + of.name, of.where);
  frames_[turned] = Frame{{own[2], own[0]}, {*part->normal, u}, {}, true};
  if (!axes_[edge.joint]) axes_[edge.joint] = ex(part->sense(j)) * *part->normal;
  aligned_[edge.joint] = true;
  return true;
}

/// Directions agree wherever a loop in its plane is turned to; its own angle is that of its two bodies.
void Frames::close_in_plane(const BodyJoint& j, const PlanePart& part) {
  if (j.kind != JointKind::revolute || !robot_.is_asked_for(j.index)) return;
  const Draft::JointCoordinate theta = draft_.joint_angle(j.index, joint(j).name);
  angles_[j.index] = theta.value();
  draft_.no_turn(part.turned(j) * theta.turn(-part.sense(j)), joint(j).where);
}

void Frames::turn_by_universal(const TreeEdge& edge) {
  const BodyJoint& j = bodies_.joints[edge.joint];
  const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
  const std::size_t from = group(parent.body);
  const Joint& of = joint(j);
  const Vec first = image(from, parent.axis);
  Vec second;
  if (algebra_.is_constant(first)) {
    const ex theta = draft_.angle(of.name, {}, of.where);
    second = simplified(cos(theta) * image(from, parent.zero) + sin(theta) * image(from, cross(parent.axis, parent.zero)),
                        "axis_" + of.name, of.where);
  } else {
    second = draft_.unit_vector("axis_" + of.name, of.where);
    draft_.equation(dot(first, second), "universal joint", of.where);
  }
  complete(group(child.body), child.axis, second, of.where);
}

void Frames::keep(std::size_t group, const Mat& rotation, const std::string& name, const SourceLocation& where) {
  const Range held{0, 0};
  std::array<ex, 3> c, s;
  for (std::size_t i = 0; i < 3; ++i) {
    const ex angle = draft_.angle(name + "_turn_" + "zyx"[i], held, where);
    c[i] = cos(angle), s[i] = sin(angle);
  }
  const Mat turn{Vec{c[0] * c[1], c[0] * s[1] * s[2] - s[0] * c[2], c[0] * s[1] * c[2] + s[0] * s[2]},
                 Vec{s[0] * c[1], s[0] * s[1] * s[2] + c[0] * c[2], s[0] * s[1] * c[2] - c[0] * s[2]},
                 Vec{-s[1], c[1] * s[2], c[1] * c[2]}};
  const Mat columns =
      transpose(Mat{algebra_.named(rotation[0]), algebra_.named(rotation[1]), algebra_.named(rotation[2])} * turn);
  frames_[group] = Frame{{Vec{1, 0, 0}, Vec{0, 1, 0}}, {columns[0], columns[1]}, columns[2], false};
}

void Frames::orient(const TreeEdge& edge) {
  const BodyJoint& j = bodies_.joints[edge.joint];
  const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
  const std::size_t turned = group(child.body);
  if (turn_in_plane(edge)) return;
  if (has_frame(turned)) {
    // Reached before, by another body of its group, or kept turned as an output says: the joint says how the two are
    // turned, as one that closes a loop does.
    close(j);
    return;
  }
  switch (j.kind) {
    case JointKind::revolute:
      if (robot_.is_asked_for(j.index) || group(parent.body) == 0) return turn_by_angle(edge);
      [[fallthrough]];
    case JointKind::cylindrical:
    case JointKind::planar: {
      const Vec along = axis(edge.joint, edge.from);
      aligned_[edge.joint] = true;
      complete(turned, child.axis, along, joint(j).where);
      return;
    }
    case JointKind::universal: turn_by_universal(edge); return;
    default: start_free(turned, joint(j).where);
  }
}

void Frames::close(const BodyJoint& j) {
  const std::size_t g0 = group(j.ends[0].body), g1 = group(j.ends[1].body);
  const Joint& of = joint(j);
  const std::string what = "the joint '" + of.name + "'";
  if (const PlanePart* part = loops_.closing(number(j))) return close_in_plane(j, *part);
  if (j.kind == JointKind::universal) {
    draft_.equation(dot(image(g0, j.ends[0].axis), image(g1, j.ends[1].axis)), "universal joint", of.where, what);
    return;
  }
  if (!shares_axis(j.kind)) return;
  if (g0 == g1) {
    for (std::size_t i = 0; i < 3; ++i) draft_.equation(j.ends[0].axis[i] - j.ends[1].axis[i], "axis", of.where, what);
  } else if (!aligned_[number(j)]) {
    // Two unit vectors are equal where two components in an orthonormal frame are, and the third, which is not 0, has the
    // same sign.
    const Vec a = image(g0, j.ends[0].axis);
    const auto& own = directions(g1);
    const Vec e0 = own[0], e2 = algebra_.unit(cross(own[0], own[1])), e1 = cross(e2, e0);
    const std::array<Vec, 3> basis{e0, e1, e2};
    std::array<ex, 3> b;
    std::size_t largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      b[i] = algebra_.clean(dot(j.ends[1].axis, basis[i]));
      if (std::fabs(algebra_.value(b[i])) > std::fabs(algebra_.value(b[largest]))) largest = i;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const ex component = dot(a, image(g1, basis[i]));
      if (i == largest) {
        draft_.at_least_zero(algebra_.sign(b[i]) * component, "choice of axis", of.where);
      } else {
        draft_.equation(component - b[i], "axis", of.where, what);
      }
    }
  }
  if (j.kind != JointKind::revolute || !robot_.is_asked_for(j.index)) return;
  // tan θ by the zeros: x sin θ − y cos θ = 0 and x cos θ + y sin θ ≥ 0, where (x, y) = (cos, sin) at solutions.
  const CosineSine theta = own_angle(j.index);
  const Vec zero = image(g1, j.ends[1].zero);
  const ex x = dot(zero, image(g0, j.ends[0].zero)), y = dot(zero, image(g0, cross(j.ends[0].axis, j.ends[0].zero)));
  draft_.equation(x * theta.sine - y * theta.cosine, "angle", of.where);
  draft_.at_least_zero(x * theta.cosine + y * theta.sine, "choice of angle", of.where);
}

void Frames::limit(const BodyJoint& j) {
  const Joint& of = joint(j);
  const std::size_t g0 = group(j.ends[0].body), g1 = group(j.ends[1].body);
  const BodyEnd &e0 = j.ends[0], &e1 = j.ends[1];
  // cos(θ − middle) ≥ cos(half), where θ turns `zero` of group g about `axis` to the image of `turned`, sense −1: the
  // other way.
  const auto keep = [&](const Range& limits, std::size_t g, const Vec& axis, const Vec& zero, int sense, const Vec& turned) {
    const auto arc = draft_.arc(limits, of.where);
    if (!arc) return;
    const Vec centre = image(g, cos(arc->middle) * zero + (sense * sin(arc->middle)) * cross(axis, zero));
    draft_.at_least_zero(dot(centre, turned) - cos(arc->half), "range of " + of.name, of.where);
  };
  switch (j.kind) {
    case JointKind::spherical: {
      if (!of.range(0) || algebra_.is_zero(e0.axis)) return;
      const ex upper = algebra_.constant(of.range(0)->upper, of.where);
      if (algebra_.sign(upper - GiNaC::Pi) < 0)
        draft_.at_least_zero(dot(image(g0, e0.axis), image(g1, e1.axis)) - cos(upper),
                             of.name.empty() ? "cone" : "cone of " + of.name, of.where);
      return;
    }
    case JointKind::revolute:
    case JointKind::cylindrical:
      if (of.range(0) && !angles_[j.index]) keep(*of.range(0), g0, e0.axis, e0.zero, 1, image(g1, e1.zero));
      return;
    case JointKind::universal:
      if (of.range(0)) keep(*of.range(0), g0, e0.axis, e0.zero, 1, image(g1, e1.axis));
      if (of.range(1)) keep(*of.range(1), g1, e1.axis, e1.zero, -1, image(g0, e0.axis));
      return;
    default: return;
  }
}

}  // namespace corank::kinematics
