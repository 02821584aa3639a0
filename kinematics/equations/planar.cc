#include "corank/kinematics/equations/drafting.h"
#include "corank/kinematics/loops/spanning_tree.h"

namespace corank::kinematics {
namespace {

using GiNaC::cos;
using GiNaC::sin;
using symbolic::ModelError;

class PlanarRobot : Drafter {
 public:
  PlanarRobot(const Drafter& drafter, const std::vector<Vec>& normals)
      : Drafter(drafter), plane_{bodies_, algebra_}, coordinates_(robot_.joints.size()) {
    for (std::size_t g = 0; g < normals.size(); ++g) plane_.basis.emplace(g, basis_of(normals[g], algebra_));
  }

  void run() {
    plane_.turns[0] = {};
    plane_.origins[0] = {};
    const SpanningTree tree = spanning_tree(robot_, bodies_, algebra_, order());
    for (const TreeEdge& edge : tree.edges) reach(edge);
    for (const std::size_t j : tree.chords) close(bodies_.joints[j]);
    for (const BodyJoint& joint : bodies_.joints) limit(joint);
    for (std::size_t j = 0; j < robot_.joints.size(); ++j)
      if (robot_.joints[j].actuated) draft_.input(draft_.symbol_of(j, *coordinates_[j]));
    for (const Output& output : robot_.outputs) add(output);
    if (draft_.has_branches()) draft_.velocity_of_equations();
    const auto place = [this](std::size_t body, const Vec& point) { return plane_.place({body, point, {}, {}}); };
    draw(*this, Space::planar, [&](std::size_t body, const Vec& point) -> Motion {
      const PlanePoint p = place(body, point);
      return {{p.x(), p.y(), 0}, {}};
    });
    report(
        coordinates_, [&](std::size_t body, const Vec& v) { return world(plane_.image(body, v)); },
        [&](std::size_t body, const Vec& point) { return world(place(body, point)); },
        [&](const BodyJoint& j) { return std::pair(joint_turn(j).cosine(), joint_turn(j).sine()); });
  }

 private:
  std::vector<int> order() const {
    std::vector<int> list;
    for (const BodyJoint& j : bodies_.joints)
      list.push_back(keeps_orientation(j.kind) || (j.kind == JointKind::revolute && robot_.is_asked_for(j.index)) ? 1 : 0);
    return list;
  }

  std::string angle_name(std::size_t body) const {
    for (const Output& output : robot_.outputs) {
      const bool turns = output.kind == Output::Kind::orientation || output.kind == Output::Kind::pose;
      if (!turns || bodies_.of_link[output.relative_to] != 0 || group(bodies_.of_link[output.link]) != group(body)) continue;
      return output.kind == Output::Kind::pose ? output.name + "_phi" : output.name;
    }
    return "phi_" + name_of(body);
  }

  void reach(const TreeEdge& edge) {
    const BodyJoint& j = bodies_.joints[edge.joint];
    const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
    const SourceLocation& where = joint(j).where;
    if (!plane_.turns.contains(group(child.body))) plane_.turns.emplace(group(child.body), child_turn(j, edge.from));
    PlanePoint origin = plane_.place(parent);
    if (keeps_orientation(j.kind) || j.kind == JointKind::slot) {
      origin = shifted(origin, way(j), edge.from == 0 ? 1 : -1);
    } else if (j.kind == JointKind::planar) {
      origin.add(plane_.turns.at(group(parent.body)), {draft_.length(joint(j).name + "_x", {}, where),  //
                                                       draft_.length(joint(j).name + "_y", {}, where)});
    }
    plane_.origins[child.body] = plane_.origin(origin, child);
    // Where prismatic joints already carry the child's direction, no coordinate is this joint's angle yet.
    if (j.kind == JointKind::revolute && robot_.is_asked_for(j.index) && !coordinates_[j.index]) close_angle(j);
  }

  /// Of end 1's point from end 0's, with the joint's coordinate.
  PlanePoint way(const BodyJoint& j) {
    const BodyEnd& e = j.ends[0];
    if (j.kind == JointKind::prismatic || j.kind == JointKind::slot) return plane_.way(e.body, e.axis, own_way(j));
    const ex radius = algebra_.constant(joint(j).length, joint(j).where);
    return plane_.way(e.body, e.zero, radius, own_turn(j, joint(j).name, plane_.sense(j)));
  }

  /// The joint's way, or length, which becomes a coordinate.
  const ex& own_way(const BodyJoint& j) {
    return coordinates_[j.index].emplace(draft_.joint_way(j.index, joint(j).name).value());
  }
  /// e^{i sign θ}, θ the joint's angle, which becomes a coordinate.
  Turn own_turn(const BodyJoint& j, const std::string& name, int sign) {
    const Draft::JointCoordinate theta = draft_.joint_angle(j.index, name);
    coordinates_[j.index] = theta.value();
    return theta.turn(sign);
  }

  Turn child_turn(const BodyJoint& j, std::size_t from) {
    const BodyEnd &parent = j.ends[from], &child = j.ends[1 - from];
    const SourceLocation& where = joint(j).where;
    const bool from_ground = plane_.turns.at(group(parent.body)).angle.is_zero(), asked_for = robot_.is_asked_for(j.index),
               named = asked_for || joint(j).is_named;
    // A joint that is told from the link to the ground counts the link's angle backwards: it needs a reason to be it.
    const bool is_link_angle = from == 0 || named || joint(j).range();
    if (j.kind != JointKind::revolute || !(asked_for || (from_ground && is_link_angle)))
      return {{1, 0}, draft_.angle(angle_name(child.body), {}, where)};
    const int sign = plane_.sense(j) * (from == 0 ? 1 : -1);
    return plane_.carried(parent, child, own_turn(j, named ? joint(j).name : angle_name(child.body), sign));
  }

  void all_zero(const PlanePoint& p, const Joint& of) {
    const std::string what = "the loop that the joint '" + of.name + "' closes";
    draft_.equation(p.height, "height", of.where, what + " leaves the plane and");
    draft_.closing({p.x(), p.y()}, draft_.branches().of_loop(p, plane_), "loop", of.where, what);
  }

  /// The angle of a turn, where no coordinate is it.
  ex angle_of(const Turn& turn, const std::string& name, const std::optional<Range>& range, const SourceLocation& where) {
    const ex theta = draft_.angle(name, range, where);
    draft_.no_turn(turn * Turn{{1, 0}, -theta}, where);
    return theta;
  }
  void close_angle(const BodyJoint& j) {
    const Turn turn = joint_turn(j);
    draft_.no_turn(turn * own_turn(j, joint(j).name, -1), joint(j).where);
  }

  Turn joint_turn(const BodyJoint& j) const {
    const Turn about_normal = plane_.turned(j);
    return plane_.sense(j) > 0 ? about_normal : inverse(about_normal);
  }

  void close(const BodyJoint& j) {
    const Joint& of = joint(j);
    const PlanePoint gap = shifted(plane_.place(j.ends[1]), plane_.place(j.ends[0]), -1);
    switch (j.kind) {
      case JointKind::revolute:
        all_zero(gap, of);
        if (robot_.is_asked_for(j.index)) close_angle(j);
        break;
      case JointKind::prismatic:
      case JointKind::slot:
      case JointKind::parallelogram: all_zero(shifted(gap, way(j), -1), of); break;
      case JointKind::planar: draft_.equation(gap.height, "height", of.where, "the joint '" + of.name + "'"); break;
      case JointKind::distance: {
        const ex length = algebra_.constant(of.length, of.where);
        draft_.closing({gap.squared() - length * length}, draft_.branches().of_rod(number(j), gap, plane_), "rod", of.where,
                       "the rod '" + of.name + "'");
        break;
      }
      case JointKind::distance_variable: {
        const ex length = own_way(j);
        draft_.equation(gap.squared() - length * length, "rod", of.where);
        break;
      }
      default: break;
    }
  }

  // Ranges of angles that are no coordinates: cos(θ − middle) ≥ cos(half).
  void limit(const BodyJoint& j) {
    const Joint& of = joint(j);
    if (j.kind != JointKind::revolute || coordinates_[j.index] || !of.range()) return;
    const auto arc = draft_.arc(*of.range(), of.where);
    if (!arc) return;
    const Turn theta = joint_turn(j) * Turn{{cos(arc->middle), -sin(arc->middle)}};
    draft_.at_least_zero(theta.cosine() - cos(arc->half), "range of " + of.name, of.where);
  }

  /// In the world's axes.
  Vec world(const PlanePoint& p) const { return in_frame(0, p); }
  Vec in_frame(std::size_t g, const PlanePoint& p) const {
    const Mat& b = plane_.basis.at(g);
    return p.x() * b[0] + p.y() * b[1] + p.height * b[2];
  }

  void add(const Output& output) {
    if (output.kept)
      throw ModelError(output.where, "the output '" + output.name + "' keeps an orientation in a plane",
                       "for a robot that moves in a plane: range phi [a, a]");
    const std::size_t body = bodies_.of_link[output.link], base = bodies_.of_link[output.relative_to];
    if (output.kind == Output::Kind::joint) return draft_.output_of_joint(output, coordinates_[output.joint]);
    if (output.kind == Output::Kind::direction)
      throw ModelError(output.where, "a direction is an output of a robot that moves in a plane", "orientation of the link");
    if (output.kind != Output::Kind::orientation) add_position(output, base);
    if (output.kind == Output::Kind::position) return;
    const Turn relative = inverse(plane_.turns.at(group(base))) * plane_.turns.at(group(body));
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
      return plane_.place({bodies_.of_link[link], p.translation + p.rotation * point, {}, {}});
    };
    PlanePoint point = at(output.link, algebra_.vector(output.point, output.where));
    Vec components;
    if (base == 0) {
      const Placement& frame = bodies_.placement[output.relative_to];
      components = transpose(frame.rotation) * (world(point) - frame.translation);
    } else {
      const PlanePoint way = shifted(point, at(output.relative_to, {0, 0, 0}), -1);
      PlanePoint seen;
      for (const Turn& term : way.terms) seen.add(term * inverse(plane_.turns.at(group(base))), {1, 0});
      seen.height = way.height;
      components = transpose(bodies_.placement[output.relative_to].rotation) * in_frame(group(base), seen);
    }
    draft_.output_components(output, components);
  }

  Plane plane_;
  std::vector<std::optional<ex>> coordinates_;  // of each joint of the robot
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
      case JointKind::slot:
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
  PlanarRobot({robot, bodies, algebra, draft}, normals).run();
}

}  // namespace corank::kinematics
