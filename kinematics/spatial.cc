#include "corank/kinematics/spatial.h"

#include <algorithm>
#include <ranges>

#include "corank/kinematics/concentric.h"
#include "corank/kinematics/frames.h"
#include "corank/kinematics/portrayal.h"
#include "corank/kinematics/rods.h"
#include "corank/kinematics/twists.h"

namespace corank::kinematics {
namespace {

using symbolic::ModelError;

bool same_points(const Bodies& a, const Bodies& b) {
  for (std::size_t j = 0; j < a.joints.size(); ++j)
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      for (std::size_t i = 0; i < 3; ++i)
        if (!a.joints[j].ends[end].point[i].is_equal(b.joints[j].ends[end].point[i])) return false;
  return true;
}

class SpatialRobot {
 public:
  SpatialRobot(const Robot& robot, const Bodies& bodies, Algebra& algebra, Draft& draft, bool deep)
      : robot_(robot),
        given_(bodies),
        bodies_(about_centres(robot, bodies, algebra)),
        algebra_(algebra),
        draft_(draft),
        deep_(deep),
        loops_(bodies_, algebra),
        frames_(robot, bodies_, loops_, algebra, draft),
        positions_{bodies_, algebra, frames_},
        rods_(robot, bodies_, loops_, algebra, draft, positions_) {
    positions_.origins.resize(bodies.size());
    positions_.origins[0] = Vec{0, 0, 0};
    positions_.coordinate.resize(robot.joints.size());
  }

  void run() {
    std::vector<int> order;
    for (std::size_t j = 0; j < bodies_.joints.size(); ++j) {
      const BodyJoint& joint = bodies_.joints[j];
      const bool early =
          keeps_orientation(joint.kind) || (joint.kind == JointKind::revolute && frames_.is_asked_for(joint.index));
      order.push_back(is_rod(joint.kind) ? 0 : loops_.has(j) ? (early ? 1 : 2) : early ? 3 : 0);
    }
    tree_ = spanning_tree(robot_, bodies_, algebra_, order, deep_);
    keep_orientations();
    orient();
    for (const std::size_t j : tree_.chords) frames_.close(bodies_.joints[j]);
    for (const TreeEdge& edge : tree_.edges) reach(edge);
    for (const TreeEdge& edge : tree_.edges) place_in_plane(edge);
    for (const std::size_t j : tree_.chords)
      if (!close_in_plane(j)) is_rod(bodies_.joints[j].kind) ? rods_.close(j) : close(bodies_.joints[j]);
    for (const BodyJoint& j : bodies_.joints) frames_.limit(j);
    bool moves = false;
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      if (!positions_.coordinate[j] && frames_.angle(j)) positions_.coordinate[j] = frames_.angle(j);
      if (!robot_.joints[j].actuated) continue;
      moves = true;
      if (positions_.coordinate[j]) draft_.input(draft_.symbol_of(j, *positions_.coordinate[j]));
    }
    for (const Output& output : robot_.outputs) add(output);
    std::optional<Twists> twists;
    if (rods_.has_two() && all_are_coordinates()) {
      if (draft_.has_branches()) draft_.velocity_of_equations();
    } else if (moves || !robot_.outputs.empty()) {
      twists.emplace(robot_, bodies_, tree_, frames_, loops_, positions_, algebra_, draft_, is_spherical());
      twists->run();
    }
    frames_.finish();
    const bool on_a_sphere = is_spherical() && same_points(given_, bodies_);
    draw(robot_, given_, algebra_, draft_, on_a_sphere ? Space::spherical : Space::spatial,
         [&](std::size_t body, const Vec& point) -> Motion {
           const Vec at = place({body, point, {}, {}});
           return {at, twists ? std::optional(twists->velocity(body, at)) : std::nullopt};
         });
    report();
  }

  bool is_spherical() const {
    return !translates_ && !tree_.chords.empty() &&
           std::all_of(bodies_.joints.begin(), bodies_.joints.end(), [](const BodyJoint& j) {
             return j.kind == JointKind::revolute || j.kind == JointKind::universal || j.kind == JointKind::spherical;
           });
  }

 private:
  const Joint& joint(const BodyJoint& j) const { return robot_.joints[j.index]; }
  std::optional<Range> range(const BodyJoint& j, std::size_t i = 0) const {
    return joint(j).ranges.size() > i ? joint(j).ranges[i] : std::nullopt;
  }
  std::size_t group(std::size_t body) const { return bodies_.group[body]; }
  Vec place(const BodyEnd& end) const { return positions_.place(end); }

  /// Inputs and outputs: then Φ's own derivative says all.
  bool all_are_coordinates() const {
    const auto has_coordinate = [&](std::size_t j) {
      const JointKind kind = robot_.joints[j].kind;
      return (moves_one_way(kind) || is_extensible(kind)) && positions_.coordinate[j];
    };
    const auto is_input = [&](std::size_t j) { return !robot_.joints[j].actuated || has_coordinate(j); };
    const auto is_output = [&](const Output& output) {
      return output.kind == Output::Kind::joint ? has_coordinate(output.joint) : output.kind == Output::Kind::position;
    };
    const auto joints = std::views::iota(std::size_t{0}, robot_.joints.size());
    return std::ranges::all_of(joints, is_input) && std::ranges::all_of(robot_.outputs, is_output);
  }

  /// Of links that are looked at in one orientation only.
  void keep_orientations() {
    for (const Output& output : robot_.outputs) {
      if (!output.kept) continue;
      Mat kept;
      for (std::size_t i = 0; i < 3; ++i) kept[i] = algebra_.vector(output.kept->rotation[i], output.where);
      const Mat rotation = kept * transpose(bodies_.placement[output.link].rotation);
      const std::size_t g = group(bodies_.of_link[output.link]);
      if (frames_.has_frame(g))
        throw ModelError(output.where, "the orientation of '" + robot_.links[output.link].name + "' is given already",
                         g == 0 ? "a link that turns" : "one output that keeps it");
      frames_.keep(g, rotation, output.name, output.where);
    }
  }

  /// The links of dyads come last: when what they join has its frame they have both of their axes.
  void orient() {
    const std::vector<Dyad> dyads = dyads_of(robot_, bodies_, algebra_, tree_, false);
    const auto is_dyad = [&](const TreeEdge& edge) {
      return std::any_of(dyads.begin(), dyads.end(), [&](const Dyad& d) { return d.inner.joint == edge.joint; });
    };
    for (const TreeEdge& edge : tree_.edges)
      if (!is_dyad(edge)) frames_.orient(edge);
    for (const TreeEdge& edge : tree_.edges)
      if (is_dyad(edge)) frames_.orient(edge);
  }

  /// A way of end 1's point from end 0's, in the world, with its coordinates.
  Vec way(const BodyJoint& j) {
    const Joint& of = joint(j);
    const BodyEnd& e = j.ends[0];
    switch (j.kind) {
      case JointKind::prismatic:
      case JointKind::cylindrical: {
        const ex d = draft_.joint_way(j.index, j.kind == JointKind::prismatic ? of.name : of.name + "_way").value();
        positions_.coordinate[j.index] = d;
        return d * frames_.image(group(e.body), e.axis);
      }
      case JointKind::parallelogram: {
        const auto [c, s] = frames_.own_angle(j.index);
        const ex radius = algebra_.constant(of.length, of.where);
        return (radius * c) * frames_.image(group(e.body), e.zero) +
               (radius * s) * frames_.image(group(e.body), cross(e.axis, e.zero));
      }
      case JointKind::planar:
        return draft_.length(of.name + "_x", {}, of.where) * frames_.image(group(e.body), e.zero) +
               draft_.length(of.name + "_y", {}, of.where) * frames_.image(group(e.body), cross(e.axis, e.zero));
      default: return {0, 0, 0};
    }
  }

  void reach(const TreeEdge& edge) {
    const BodyJoint& j = bodies_.joints[edge.joint];
    const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
    Vec at = place(parent);
    if (is_rod(j.kind)) {
      at = at + rods_.hang(edge);
    } else {
      at = edge.from == 0 ? at + way(j) : at - way(j);
    }
    positions_.origins[child.body] = algebra_.clean(at - frames_.image(group(child.body), child.point));
  }

  // In the plane of loops with parallel axes, from the body that carries them.
  PlanePoint plane_place(const PlanePart& part, const BodyEnd& end) const {
    return plus(part.origins.at(end.body), part.image(group(end.body), end.point, algebra_));
  }
  PlanePoint plane_way(const PlanePart& part, const BodyJoint& j) const {
    PlanePoint way;
    const std::size_t g = group(j.ends[0].body);
    if (j.kind == JointKind::prismatic) {
      const ex& d = *positions_.coordinate[j.index];
      const Complex along = part.in_plane(g, j.ends[0].axis, algebra_);
      way.add(part.turns.at(g), {d * along.re, d * along.im});
    } else if (j.kind == JointKind::parallelogram) {
      const ex radius = algebra_.constant(joint(j).length, joint(j).where);
      const Complex zero = part.in_plane(g, j.ends[0].zero, algebra_);
      way.add(part.turns.at(g) * Turn{{1, 0}, part.sense(bodies_, j, algebra_) * *frames_.angle(j.index)},
              {radius * zero.re, radius * zero.im});
    }
    return way;
  }

  void place_in_plane(const TreeEdge& edge) {
    PlanePart* const part = loops_.of(edge.joint);
    if (part == nullptr || !part->root || is_rod(bodies_.joints[edge.joint].kind)) return;
    part->origins.try_emplace(*part->root);
    const BodyJoint& j = bodies_.joints[edge.joint];
    const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
    if (!part->bodies.contains(parent.body) || !part->bodies.contains(child.body)) return;
    const PlanePoint at = plus(plane_place(*part, parent), plane_way(*part, j), edge.from == 0 ? 1 : -1);
    part->origins[child.body] = plus(at, part->image(group(child.body), child.point, algebra_), -1);
  }

  bool close_in_plane(std::size_t index) {
    PlanePart* const part = loops_.closing(bodies_, index);
    if (part == nullptr) return false;
    const BodyJoint& j = bodies_.joints[index];
    const Joint& of = joint(j);
    const PlanePoint gap = plus(plane_place(*part, j.ends[1]), plane_place(*part, j.ends[0]), -1);
    const BranchFinder::Image seen = [&](std::size_t body, const Vec& way) -> std::optional<Turn> {
      const auto turn = part->turns.find(group(body));
      if (turn == part->turns.end()) return std::nullopt;
      return turn->second * Turn{part->in_plane(group(body), way, algebra_)};
    };
    if (is_rod(j.kind)) {
      const ex length = rods_.length(j), square = gap.squared();
      const auto branches = j.kind == JointKind::distance ? draft_.branches().of_rod(index, gap, seen) : std::nullopt;
      draft_.closing({square - length * length}, branches, "rod", of.where, "the rod '" + of.name + "'");
      part->closings[index] = {square / 2};
      return true;
    }
    if (keeps_orientation(j.kind)) way(j);  // which declares its coordinate
    const PlanePoint open = plus(gap, plane_way(*part, j), -1);
    const std::string what = "the loop that the joint '" + of.name + "' closes";
    draft_.equation(open.height, "height", of.where, what + " leaves its plane and");
    part->closings[index] = {open.x(), open.y()};
    if (draft_.closing({open.x(), open.y()}, draft_.branches().of_loop(open, seen), "loop", of.where, what))
      translates_ = true;
    return true;
  }

  void close(const BodyJoint& j) {
    const Joint& of = joint(j);
    const std::string what = "the loop that the joint '" + of.name + "' closes";
    const Vec gap = place(j.ends[1]) - place(j.ends[0]);
    if (j.kind == JointKind::planar) {
      draft_.equation(dot(gap, frames_.image(group(j.ends[0].body), j.ends[0].axis)), "plane", of.where, what);
      return;
    }
    const Vec open = algebra_.clean(gap - way(j));
    Vec components = open;
    if (const auto along = closing_directions(open)) {
      components = {dot(open, (*along)[0]), dot(open, (*along)[1]), dot(open, (*along)[2])};
      positions_.closing.emplace(static_cast<std::size_t>(&j - bodies_.joints.data()), *along);
    }
    for (const ex& component : components)
      if (draft_.equation(component, "loop", of.where, what)) translates_ = true;
  }

  /// A loop closes along the world's directions; or, where it is known to be closed along a direction of a body, along three
  /// that span space, this one first. Looking for it may make coordinates, so only those who seek identities do.
  std::optional<std::array<Vec, 3>> closing_directions(const Vec& open) {
    if (!draft_.seeks_identities()) return std::nullopt;
    for (std::size_t g = 1; g < bodies_.groups; ++g) {
      if (!frames_.has_frame(g)) continue;
      const std::array<Vec, 2> own = frames_.directions(g);
      for (std::size_t i = 0; i < 2; ++i) {
        const Vec direction = frames_.direction(g, i);
        if (!draft_.follows(dot(open, direction))) continue;
        const std::array<Vec, 2> across = frames_.across(g, own[i]);
        return std::array<Vec, 3>{direction, across[0], across[1]};
      }
    }
    return std::nullopt;
  }

  /// Poses of links and values of joints, for whoever wants to know them of a solution.
  void report() {
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      const std::size_t body = bodies_.of_link[l];
      const Placement& at = bodies_.placement[l];
      const Mat columns = transpose(at.rotation);
      Mat axes;
      for (std::size_t i = 0; i < 3; ++i) axes[i] = frames_.image(group(body), columns[i]);
      draft_.pose({place({body, at.translation, {}, {}}), transpose(axes)});
    }
    for (const BodyJoint& j : bodies_.joints) {
      if (positions_.coordinate[j.index]) {
        draft_.joint_value(joint(j).name, *positions_.coordinate[j.index]);
      } else if (j.kind == JointKind::revolute) {
        const BodyEnd &a = j.ends[0], &b = j.ends[1];
        const Vec zero = frames_.image(group(b.body), b.zero);
        draft_.joint_value(joint(j).name, dot(zero, frames_.image(group(a.body), a.zero)),
                           dot(zero, frames_.image(group(a.body), cross(a.axis, a.zero))));
      }
    }
  }

  void add(const Output& output) {
    const bool place_wanted = output.kind == Output::Kind::position || output.kind == Output::Kind::pose;
    if (output.kind == Output::Kind::joint) {
      if (!positions_.coordinate[output.joint])
        throw ModelError(output.where, "the joint '" + robot_.joints[output.joint].name + "' has no coordinate",
                         "a revolute or prismatic joint, or a rod of variable length");
      draft_.output(draft_.symbol_of(output.joint, *positions_.coordinate[output.joint]));
      return;
    }
    if (bodies_.of_link[output.relative_to] != 0)
      throw ModelError(output.where,
                       "the output '" + output.name + "' is relative to '" + robot_.links[output.relative_to].name + "'",
                       "for a robot in space: relative to the ground '" + robot_.links[0].name + "'");
    if (place_wanted) add_components(output, point_of(output));
    if (output.kind == Output::Kind::direction) {
      const Placement& at = bodies_.placement[output.link];
      add_components(
          output, frames_.image(group(bodies_.of_link[output.link]),
                                algebra_.clean(algebra_.unit(at.rotation * algebra_.vector(output.point, output.where)))));
    }
  }

  Vec point_of(const Output& output) {
    const Placement& at = bodies_.placement[output.link];
    const std::size_t body = bodies_.of_link[output.link];
    const Vec local = algebra_.clean(at.translation + at.rotation * algebra_.vector(output.point, output.where));
    const Vec p = place({body, local, {}, {}});
    positions_.output_points.emplace(output.name, p);
    return p;
  }

  void add_components(const Output& output, const Vec& value) {
    const std::array<bool, 3> moves = draft_.moving(output, value);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!moves[i]) continue;
      const ex coordinate = draft_.length(output.name + "_" + "xyz"[i], output.ranges[i], output.where);
      draft_.equation(coordinate - value[i], "output", output.where);
      draft_.output(coordinate);
    }
  }

  const Robot& robot_;
  const Bodies& given_;  // joints where the robot has them, for pictures
  const Bodies bodies_;  // joints about the centres of spherical loops
  Algebra& algebra_;
  Draft& draft_;
  const bool deep_;
  PlaneLoops loops_;
  Frames frames_;
  SpanningTree tree_;
  Positions positions_;
  Rods rods_;
  bool translates_ = false;  // a loop's positions say something
};

}  // namespace

bool draft_spatial(const Robot& robot, const Bodies& bodies, Algebra& algebra, Draft& draft, bool deep) {
  SpatialRobot spatial(robot, bodies, algebra, draft, deep);
  spatial.run();
  return spatial.is_spherical();
}

}  // namespace corank::kinematics
