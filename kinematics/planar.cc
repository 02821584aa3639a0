#include "corank/kinematics/planar.h"

#include "corank/kinematics/plane.h"
#include "corank/kinematics/portrayal.h"
#include "corank/kinematics/spanning_tree.h"

namespace corank::kinematics {
namespace {

using GiNaC::cos;
using GiNaC::sin;
using symbolic::ModelError;

class PlanarRobot {
 public:
  PlanarRobot(const Robot& robot, const Bodies& bodies, const std::vector<Vec>& normals, Algebra& algebra, Draft& draft)
      : robot_(robot), bodies_(bodies), algebra_(algebra), draft_(draft) {
    for (const Vec& n : normals) basis_.push_back(basis_of(n, algebra));
    turns_.resize(bodies.groups);
    origins_.resize(bodies.size());
    coordinate_.resize(robot.joints.size());
  }

  void run() {
    turns_[0] = Turn{};
    origins_[0] = PlanePoint{};
    const SpanningTree tree = spanning_tree(robot_, bodies_, algebra_, order());
    for (const TreeEdge& edge : tree.edges) reach(edge);
    for (const std::size_t j : tree.chords) close(bodies_.joints[j]);
    for (const BodyJoint& joint : bodies_.joints) limit(joint);
    for (const Joint& joint : robot_.joints)
      if (joint.actuated) draft_.input(symbol_of(&joint - robot_.joints.data()));
    for (const Output& output : robot_.outputs) add(output);
    if (draft_.has_branches()) draft_.velocity_of_equations();
    draw(robot_, bodies_, algebra_, draft_, Space::planar, [this](std::size_t body, const Vec& point) -> Motion {
      const PlanePoint p = plus(*origins_[body], image(body, point));
      return {{p.x(), p.y(), 0}, {}};
    });
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      const std::size_t body = bodies_.of_link[l];
      const Placement& at = bodies_.placement[l];
      Mat axes;
      for (std::size_t i = 0; i < 3; ++i) axes[i] = world(image(body, transpose(at.rotation)[i]));
      draft_.pose({world(plus(*origins_[body], image(body, at.translation))), transpose(axes)});
    }
    for (const BodyJoint& j : bodies_.joints)
      if (coordinate_[j.index]) {
        draft_.joint_value(joint(j).name, *coordinate_[j.index]);
      } else if (j.kind == JointKind::revolute) {
        draft_.joint_value(joint(j).name, joint_turn(j).cosine(), joint_turn(j).sine());
      }
  }

 private:
  const Joint& joint(const BodyJoint& j) const { return robot_.joints[j.index]; }

  /// Of a joint that has a coordinate, its own or one that it shares.
  ex symbol_of(std::size_t index) const { return draft_.symbol_of(index, *coordinate_[index]); }

  bool is_asked_for(std::size_t index) const {
    if (robot_.joints[index].actuated || draft_.is_coupled(index)) return true;
    for (const Output& output : robot_.outputs)
      if (output.kind == Output::Kind::joint && output.joint == index) return true;
    return false;
  }

  std::vector<int> order() const {
    std::vector<int> list;
    for (const BodyJoint& j : bodies_.joints)
      list.push_back(keeps_orientation(j.kind) || (j.kind == JointKind::revolute && is_asked_for(j.index)) ? 1 : 0);
    return list;
  }

  std::optional<Range> range(const BodyJoint& j) const {
    return joint(j).ranges.empty() ? std::nullopt : joint(j).ranges[0];
  }

  std::size_t group(std::size_t body) const { return bodies_.group[body]; }

  /// A constant vector of a body's frame, in the plane's basis: e1 + i e2.
  Complex in_plane(std::size_t g, const Vec& v) const {
    return {algebra_.clean(dot(v, basis_[g][0])), algebra_.clean(dot(v, basis_[g][1]))};
  }
  PlanePoint image(std::size_t body, const Vec& v) const {
    const std::size_t g = group(body);
    PlanePoint p;
    p.add(*turns_[g], in_plane(g, v));
    p.height = dot(v, basis_[g][2]);
    return p;
  }
  PlanePoint place(const BodyEnd& end) const { return plus(*origins_[end.body], image(end.body, end.point)); }

  /// +1 where turning about the joint's axis is turning about the plane's normal.
  int sense(const BodyJoint& j) const { return algebra_.sign(dot(j.ends[0].axis, basis_[group(j.ends[0].body)][2])); }
  /// By what end 1's zero is turned from end 0's, about the normal.
  Turn turned(const BodyJoint& j) const {
    const auto zero = [&](const BodyEnd& e) { return *turns_[group(e.body)] * Turn{in_plane(group(e.body), e.zero)}; };
    return zero(j.ends[1]) * inverse(zero(j.ends[0]));
  }

  /// The link that gives a body its name: the first that is not a mere frame.
  const std::string& link_of(std::size_t body) const {
    for (std::size_t l = 0; l < robot_.links.size(); ++l)
      if (bodies_.of_link[l] == body) return robot_.links[l].name;
    return robot_.links[0].name;
  }
  std::string angle_name(std::size_t body) const {
    for (const Output& output : robot_.outputs) {
      const bool turns = output.kind == Output::Kind::orientation || output.kind == Output::Kind::pose;
      if (!turns || bodies_.of_link[output.relative_to] != 0 || group(bodies_.of_link[output.link]) != group(body)) continue;
      return output.kind == Output::Kind::pose ? output.name + "_phi" : output.name;
    }
    return "phi_" + link_of(body);
  }

  void reach(const TreeEdge& edge) {
    const BodyJoint& j = bodies_.joints[edge.joint];
    const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
    const SourceLocation& where = joint(j).where;
    if (!turns_[group(child.body)]) turns_[group(child.body)] = child_turn(j, edge.from);
    PlanePoint origin = place(parent);
    if (keeps_orientation(j.kind)) {
      origin = plus(origin, way(j), edge.from == 0 ? 1 : -1);
    } else if (j.kind == JointKind::planar) {
      origin.add(*turns_[group(parent.body)], {draft_.length(joint(j).name + "_x", {}, where),  //
                                               draft_.length(joint(j).name + "_y", {}, where)});
    }
    origins_[child.body] = plus(origin, image(child.body, child.point), -1);
    // Where prismatic joints already carry the child's direction, no coordinate is this joint's angle yet.
    if (j.kind == JointKind::revolute && is_asked_for(j.index) && !coordinate_[j.index]) close_angle(j);
  }

  /// Of end 1's point from end 0's, with the joint's coordinate.
  PlanePoint way(const BodyJoint& j) {
    const Joint& of = joint(j);
    const BodyEnd& e = j.ends[0];
    const Turn& base = *turns_[group(e.body)];
    PlanePoint p;
    if (j.kind == JointKind::prismatic) {
      coordinate_[j.index] = draft_.joint_way(j.index, of.name).value();
      const Complex along = in_plane(group(e.body), e.axis);
      p.add(base, {*coordinate_[j.index] * along.re, *coordinate_[j.index] * along.im});
    } else {
      const ex radius = algebra_.constant(of.length, of.where);
      const Complex zero = in_plane(group(e.body), e.zero);
      p.add(base * own_turn(j, of.name, sense(j)), {radius * zero.re, radius * zero.im});
    }
    return p;
  }

  /// e^{i sign θ}, θ the joint's angle, which becomes a coordinate.
  Turn own_turn(const BodyJoint& j, const std::string& name, int sign) {
    const Draft::JointCoordinate theta = draft_.joint_angle(j.index, name);
    coordinate_[j.index] = theta.value();
    return theta.turn(sign);
  }

  Turn child_turn(const BodyJoint& j, std::size_t from) {
    const BodyEnd &parent = j.ends[from], &child = j.ends[1 - from];
    const SourceLocation& where = joint(j).where;
    const Turn& base = *turns_[group(parent.body)];
    const bool from_ground = base.angle.is_zero();
    const bool named = is_asked_for(j.index) || joint(j).is_named;
    // A joint that is told from the link to the ground counts the link's angle backwards: it needs a reason to be it.
    const bool is_link_angle = from == 0 || named || range(j);
    if (j.kind != JointKind::revolute || !(is_asked_for(j.index) || (from_ground && is_link_angle)))
      return {{1, 0}, draft_.angle(angle_name(child.body), {}, where)};
    const Turn theta = own_turn(j, named ? joint(j).name : angle_name(child.body), sense(j) * (from == 0 ? 1 : -1));
    const Complex z0 = in_plane(group(parent.body), parent.zero), z1 = in_plane(group(child.body), child.zero);
    const Turn turn = base * Turn{z0} * theta * Turn{conjugate(z1)};
    return {{algebra_.clean(turn.k.re), algebra_.clean(turn.k.im)}, turn.angle};
  }

  void all_zero(const PlanePoint& p, const Joint& of) {
    const std::string what = "the loop that the joint '" + of.name + "' closes";
    draft_.equation(p.height, "height", of.where, what + " leaves the plane and");
    draft_.closing({p.x(), p.y()}, draft_.branches().of_loop(p, seen()), "loop", of.where, what);
  }

  BranchFinder::Image seen() const {
    return [this](std::size_t body, const Vec& way) { return *turns_[group(body)] * Turn{in_plane(group(body), way)}; };
  }

  /// The angle of a turn, where no coordinate is it: sin(turn − θ) = 0 and cos(turn − θ) ≥ 0.
  void equal(const Turn& turn, const Turn& minus_theta, const SourceLocation& where) {
    const Turn difference = turn * minus_theta;
    if (!draft_.equation(difference.sine(), "angle", where)) return;
    draft_.at_least_zero(difference.cosine(), "angle", where);
  }
  ex angle_of(const Turn& turn, const std::string& name, const std::optional<Range>& range, const SourceLocation& where) {
    const ex theta = draft_.angle(name, range, where);
    equal(turn, {{1, 0}, -theta}, where);
    return theta;
  }
  void close_angle(const BodyJoint& j) { equal(joint_turn(j), own_turn(j, joint(j).name, -1), joint(j).where); }

  Turn joint_turn(const BodyJoint& j) const {
    const Turn about_normal = turned(j);
    return sense(j) > 0 ? about_normal : inverse(about_normal);
  }

  void close(const BodyJoint& j) {
    const Joint& of = joint(j);
    const PlanePoint gap = plus(place(j.ends[1]), place(j.ends[0]), -1);
    switch (j.kind) {
      case JointKind::revolute:
        all_zero(gap, of);
        if (is_asked_for(j.index)) close_angle(j);
        break;
      case JointKind::prismatic:
      case JointKind::parallelogram: all_zero(plus(gap, way(j), -1), of); break;
      case JointKind::planar: draft_.equation(gap.height, "height", of.where, "the joint '" + of.name + "'"); break;
      case JointKind::distance: {
        const ex length = algebra_.constant(of.length, of.where);
        const std::size_t number = &j - bodies_.joints.data();
        draft_.closing({gap.squared() - length * length}, draft_.branches().of_rod(number, gap, seen()), "rod", of.where,
                       "the rod '" + of.name + "'");
        break;
      }
      case JointKind::distance_variable: {
        const ex length = draft_.length(of.name, range(j), of.where);
        draft_.limit_last();
        coordinate_[j.index] = length;
        draft_.equation(gap.squared() - length * length, "rod", of.where);
        break;
      }
      default: break;
    }
  }

  // Ranges of angles that are no coordinates: cos(θ − middle) ≥ cos(half).
  void limit(const BodyJoint& j) {
    if (j.kind != JointKind::revolute || coordinate_[j.index] || !range(j)) return;
    const Joint& of = joint(j);
    const ex lower = algebra_.constant(range(j)->lower, of.where), upper = algebra_.constant(range(j)->upper, of.where);
    const ex middle = (lower + upper) / 2, half = (upper - lower) / 2;
    if (algebra_.sign(half - GiNaC::Pi) >= 0) return;
    const Turn theta = joint_turn(j) * Turn{{cos(middle), -sin(middle)}};
    draft_.at_least_zero(theta.cosine() - cos(half), "range", of.where);
  }

  /// In the world's axes.
  Vec world(const PlanePoint& p) const { return p.x() * basis_[0][0] + p.y() * basis_[0][1] + p.height * basis_[0][2]; }

  void add(const Output& output) {
    if (output.kept)
      throw ModelError(output.where, "the output '" + output.name + "' keeps an orientation in a plane",
                       "for a robot that moves in a plane: range phi [a, a]");
    const std::size_t body = bodies_.of_link[output.link], base = bodies_.of_link[output.relative_to];
    switch (output.kind) {
      case Output::Kind::joint:
        if (!coordinate_[output.joint])
          throw ModelError(output.where, "the joint '" + robot_.joints[output.joint].name + "' has no coordinate",
                           "a revolute or prismatic joint, or a rod of variable length");
        draft_.output(symbol_of(output.joint));
        return;
      case Output::Kind::direction:
        throw ModelError(output.where, "a direction is an output of a robot that moves in a plane",
                         "orientation of the link");
      default: break;
    }
    if (output.kind != Output::Kind::orientation) add_position(output, base);
    if (output.kind == Output::Kind::position) return;
    const Turn relative = inverse(*turns_[group(base)]) * *turns_[group(body)];
    const bool is_coordinate =
        algebra_.is_zero(relative.k.im) && algebra_.sign(relative.k.re) > 0 && GiNaC::is_a<GiNaC::symbol>(relative.angle);
    const std::string name = output.kind == Output::Kind::pose ? output.name + "_phi" : output.name;
    const std::string range_of = "the range of phi of the output '" + output.name + "'";
    if (is_coordinate && output.turn) draft_.slice(relative.angle, *output.turn, range_of, output.where);
    draft_.output(is_coordinate ? relative.angle : angle_of(relative, name, output.turn, output.where));
  }

  void add_position(const Output& output, std::size_t base) {
    const auto at = [&](std::size_t link, const Vec& point) {
      const Placement& p = bodies_.placement[link];
      const std::size_t b = bodies_.of_link[link];
      return plus(*origins_[b], image(b, p.translation + p.rotation * point));
    };
    PlanePoint point = at(output.link, algebra_.vector(output.point, output.where));
    Vec components;
    if (base == 0) {
      const Placement& frame = bodies_.placement[output.relative_to];
      components = transpose(frame.rotation) * (world(point) - frame.translation);
    } else {
      const PlanePoint way = plus(point, at(output.relative_to, {0, 0, 0}), -1);
      PlanePoint seen;
      for (const auto& [angle, k] : way.terms) seen.add(Turn{k, angle} * inverse(*turns_[group(base)]), {1, 0});
      seen.height = way.height;
      const auto& b = basis_[group(base)];
      components = transpose(bodies_.placement[output.relative_to].rotation) *
                   (seen.x() * b[0] + seen.y() * b[1] + seen.height * b[2]);
    }
    const std::array<bool, 3> moves = draft_.moving(output, components);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!moves[i]) continue;
      const ex coordinate = draft_.length(output.name + "_" + "xyz"[i], output.ranges[i], output.where);
      draft_.equation(coordinate - components[i], "output", output.where);
      draft_.output(coordinate);
    }
    if (moves == std::array<bool, 3>{})
      throw ModelError(output.where, "the output '" + output.name + "' does not move", "a point of a link that moves");
  }

  const Robot& robot_;
  const Bodies& bodies_;
  Algebra& algebra_;
  Draft& draft_;
  std::vector<Mat> basis_;                          // e1, e2, n of each group
  std::vector<std::optional<Turn>> turns_;          // of each group
  std::vector<std::optional<PlanePoint>> origins_;  // of each body
  std::vector<std::optional<ex>> coordinate_;       // of each joint of the robot
};

}  // namespace

std::optional<std::vector<Vec>> plane_of(const Bodies& bodies, const Algebra& algebra) {
  std::vector<std::optional<Vec>> normals(bodies.groups);
  const auto turns_in_plane = [](JointKind kind) {
    return kind == JointKind::revolute || kind == JointKind::planar || kind == JointKind::parallelogram;
  };
  const Vec* sliding = nullptr;
  for (const BodyJoint& j : bodies.joints) {
    const std::size_t g = bodies.group[j.ends[0].body];
    if (j.kind == JointKind::prismatic && g == 0 && !normals[0] && sliding &&
        !algebra.are_parallel(*sliding, j.ends[0].axis)) {
      normals[0] = algebra.unit(cross(*sliding, j.ends[0].axis));
    }
    if (j.kind == JointKind::prismatic && g == 0) sliding = &j.ends[0].axis;
  }
  for (const BodyJoint& j : bodies.joints)
    if (turns_in_plane(j.kind)) {
      normals[bodies.group[j.ends[0].body]] = j.ends[0].axis;
      if (bodies.group[j.ends[0].body] != 0) normals[0].reset();
      break;
    }
  if (bodies.groups == 1 && !normals[0] && sliding) normals[0] = algebra.perpendicular(*sliding);
  for (bool grew = true; grew;) {
    grew = false;
    for (const BodyJoint& j : bodies.joints) {
      if (!turns_in_plane(j.kind)) continue;
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        auto &known = normals[bodies.group[j.ends[side].body]], &other = normals[bodies.group[j.ends[1 - side].body]];
        if (!known || other) continue;
        other = carried_over(*known, j.ends[side], j.ends[1 - side], algebra);
        if (!other) return std::nullopt;
        grew = true;
      }
    }
  }
  std::vector<Vec> result;
  int up = 1;  // so that the plane is seen as xy, xz or yz, its second axis upwards
  for (const auto& n : normals) {
    if (!n) return std::nullopt;
    const Vec e2 = cross(*n, algebra.perpendicular(*n));
    for (std::size_t i = 0; i < 3 && result.empty(); ++i)
      if (const int sign = algebra.sign(algebra.clean(e2[i]))) {
        up = sign;
        break;
      }
    result.push_back(ex(up) * *n);
  }
  for (const BodyJoint& j : bodies.joints) {
    const Vec &n0 = result[bodies.group[j.ends[0].body]], &n1 = result[bodies.group[j.ends[1].body]];
    switch (j.kind) {
      case JointKind::revolute:
      case JointKind::parallelogram:
      case JointKind::planar:
        if (!algebra.are_parallel(n0, j.ends[0].axis) || !algebra.are_parallel(n1, j.ends[1].axis) ||
            algebra.sign(dot(n0, j.ends[0].axis)) != algebra.sign(dot(n1, j.ends[1].axis)))
          return std::nullopt;
        break;
      case JointKind::prismatic:
        if (!algebra.is_zero(algebra.clean(dot(n0, j.ends[0].axis)))) return std::nullopt;
        break;
      case JointKind::distance:
      case JointKind::distance_variable: break;
      default: return std::nullopt;
    }
  }
  return result;
}

void draft_planar(const Robot& robot, const Bodies& bodies, const std::vector<Vec>& normals, Algebra& algebra,
                  Draft& draft) {
  PlanarRobot(robot, bodies, normals, algebra, draft).run();
}

}  // namespace corank::kinematics
