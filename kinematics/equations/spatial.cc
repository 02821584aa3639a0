#include <algorithm>
#include <ranges>

#include "corank/kinematics/equations/drafting.h"
#include "corank/kinematics/equations/frames.h"
#include "corank/kinematics/equations/rods.h"
#include "corank/kinematics/equations/twists.h"

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

class SpatialRobot : public Drafter {
 public:
  /// `given`: joints where the robot has them, for pictures; else about the centres of spherical loops.
  SpatialRobot(const Drafter& drafter, const Bodies& given, bool deep)
      : Drafter(drafter),
        given_(given),
        deep_(deep),
        loops_(bodies_, algebra_),
        frames_(*this, loops_),
        positions_{bodies_, algebra_, frames_},
        rods_(*this, loops_, positions_) {
    positions_.origins.resize(bodies_.size());
    positions_.origins[0] = Vec{0, 0, 0};
    positions_.coordinates.resize(robot_.joints.size());
  }

  void run() {
    std::vector<int> order;
    for (std::size_t j = 0; j < bodies_.joints.size(); ++j) {
      const auto& [index, kind, ends] = bodies_.joints[j];
      const bool early = keeps_orientation(kind) || (kind == JointKind::revolute && robot_.is_asked_for(index));
      order.push_back(is_rod(kind) ? 0 : loops_.has(j) ? (early ? 1 : 2) : early ? 3 : 0);
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
      if (!positions_.coordinates[j] && frames_.angle(j)) positions_.coordinates[j] = frames_.angle(j);
      if (!robot_.joints[j].actuated) continue;
      moves = true;
      if (positions_.coordinates[j]) draft_.input(draft_.symbol_of(j, *positions_.coordinates[j]));
    }
    for (const Output& output : robot_.outputs) add(output);
    std::optional<Twists> twists;
    if (rods_.has_two() && all_are_coordinates()) {
      if (draft_.has_branches()) draft_.velocity_of_equations();
    } else if (moves || !robot_.outputs.empty()) {
      twists.emplace(*this, tree_, frames_, loops_, positions_, is_spherical());
      twists->run();
    }
    frames_.finish();
    const bool on_a_sphere = is_spherical() && same_points(given_, bodies_);
    draw({robot_, given_, algebra_, draft_}, on_a_sphere ? Space::spherical : Space::spatial,
         [&](std::size_t body, const Vec& point) -> Motion {
           const Vec at = place({body, point, {}, {}});
           return {at, twists ? std::optional(twists->velocity(body, at)) : std::nullopt};
         });
    report(
        positions_.coordinates, [&](std::size_t body, const Vec& v) { return positions_.image(body, v); },
        [&](std::size_t body, const Vec& point) {
          return place({body, point, {}, {}});
        },
        [&](const BodyJoint& j) {
          const BodyEnd &a = j.ends[0], &b = j.ends[1];
          const Vec zero = positions_.image(b.body, b.zero);
          return std::pair(dot(zero, positions_.image(a.body, a.zero)),
                           dot(zero, positions_.image(a.body, cross(a.axis, a.zero))));
        });
  }

  bool is_spherical() const {
    return !translates_ && !tree_.chords.empty() && std::ranges::all_of(bodies_.joints, turns_about_point, &BodyJoint::kind);
  }

 private:
  Vec place(const BodyEnd& end) const { return positions_.place(end); }

  /// Inputs and outputs: then Φ's own derivative says all.
  bool all_are_coordinates() const {
    const auto has_coordinate = [&](std::size_t j) {
      const JointKind kind = robot_.joints[j].kind;
      return (moves_one_way(kind) || is_extensible(kind)) && positions_.coordinates[j];
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
      return std::ranges::any_of(dyads, [&](const Dyad& d) { return d.inner.joint == edge.joint; });
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
      case JointKind::slot:
      case JointKind::cylindrical: {
        const ex d = draft_.joint_way(j.index, j.kind == JointKind::cylindrical ? of.name + "_way" : of.name).value();
        positions_.coordinates[j.index] = d;
        return d * positions_.image(e.body, e.axis);
      }
      case JointKind::parallelogram: {
        const auto [c, s] = frames_.own_angle(j.index);
        const ex radius = algebra_.constant(of.length, of.where);
        return (radius * c) * positions_.image(e.body, e.zero) +
               (radius * s) * positions_.image(e.body, cross(e.axis, e.zero));
      }
      case JointKind::planar:
        return draft_.length(of.name + "_x", {}, of.where) * positions_.image(e.body, e.zero) +
               draft_.length(of.name + "_y", {}, of.where) * positions_.image(e.body, cross(e.axis, e.zero));
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
    positions_.origins[child.body] = algebra_.clean(at - positions_.image(child.body, child.point));
  }

  // In the plane of loops with parallel axes, from the body that carries them.
  PlanePoint plane_way(const PlanePart& part, const BodyJoint& j) const {
    const BodyEnd& e = j.ends[0];
    if (j.kind == JointKind::prismatic) return part.way(e.body, e.axis, *positions_.coordinates[j.index]);
    if (j.kind != JointKind::parallelogram) return {};
    return part.way(e.body, e.zero, algebra_.constant(joint(j).length, joint(j).where),
                    {{1, 0}, part.sense(j) * *frames_.angle(j.index)});
  }

  void place_in_plane(const TreeEdge& edge) {
    PlanePart* const part = loops_.of(edge.joint);
    if (part == nullptr || !part->root || is_rod(bodies_.joints[edge.joint].kind)) return;
    part->origins.try_emplace(*part->root);
    const BodyJoint& j = bodies_.joints[edge.joint];
    const BodyEnd &parent = j.ends[edge.from], &child = j.ends[1 - edge.from];
    if (!part->reached.contains(parent.body) || !part->reached.contains(child.body)) return;
    const PlanePoint at = shifted(part->place(parent), plane_way(*part, j), edge.from == 0 ? 1 : -1);
    part->origins[child.body] = part->origin(at, child);
  }

  bool close_in_plane(std::size_t index) {
    PlanePart* const part = loops_.closing(index);
    if (part == nullptr) return false;
    const BodyJoint& j = bodies_.joints[index];
    const Joint& of = joint(j);
    const PlanePoint gap = shifted(part->place(j.ends[1]), part->place(j.ends[0]), -1);
    if (is_rod(j.kind)) {
      const ex length = rods_.length(j), square = gap.squared();
      const auto branches = j.kind == JointKind::distance ? draft_.branches().of_rod(index, gap, *part) : std::nullopt;
      draft_.closing({square - length * length}, branches, "rod", of.where, "the rod '" + of.name + "'");
      part->closings[index] = {square / 2};
      return true;
    }
    if (keeps_orientation(j.kind)) way(j);  // which declares its coordinate
    const PlanePoint open = shifted(gap, plane_way(*part, j), -1);
    const std::string what = "the loop that the joint '" + of.name + "' closes";
    draft_.equation(open.height, "height", of.where, what + " leaves its plane and");
    part->closings[index] = {open.x(), open.y()};
    if (draft_.closing(part->closings[index], draft_.branches().of_loop(open, *part), "loop", of.where, what))
      translates_ = true;
    return true;
  }

  void close(const BodyJoint& j) {
    const Joint& of = joint(j);
    const std::string what = "the loop that the joint '" + of.name + "' closes";
    const Vec gap = place(j.ends[1]) - place(j.ends[0]);
    if (j.kind == JointKind::planar) {
      draft_.equation(dot(gap, positions_.image(j.ends[0].body, j.ends[0].axis)), "plane", of.where, what);
      return;
    }
    const Vec open = algebra_.clean(gap - way(j));
    Vec components = open;
    if (const auto along = closing_directions(open)) {
      components = {dot(open, (*along)[0]), dot(open, (*along)[1]), dot(open, (*along)[2])};
      positions_.closing.emplace(number(j), *along);
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

  void add(const Output& output) {
    if (output.kind == Output::Kind::joint) return draft_.output_of_joint(output, positions_.coordinates[output.joint]);
    if (bodies_.of_link[output.relative_to] != 0)
      throw ModelError(output.where,
                       "the output '" + output.name + "' is relative to '" + robot_.links[output.relative_to].name + "'",
                       "for a robot in space: relative to the ground '" + robot_.links[0].name + "'");
    const Placement& at = bodies_.placement[output.link];
    const std::size_t body = bodies_.of_link[output.link];
    const Vec turned = at.rotation * algebra_.vector(output.point, output.where);
    if (output.kind == Output::Kind::position || output.kind == Output::Kind::pose) {
      const Vec p = place({body, algebra_.clean(at.translation + turned), {}, {}});
      positions_.output_points.emplace(output.name, p);
      draft_.output_components(output, p, output.kind == Output::Kind::pose);
    } else if (output.kind == Output::Kind::direction) {
      draft_.output_components(output, positions_.image(body, algebra_.clean(algebra_.unit(turned))));
    }
  }

  const Bodies& given_;
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
  const Bodies moved = about_centres(robot, bodies, algebra);
  SpatialRobot spatial({robot, moved, algebra, draft}, bodies, deep);
  spatial.run();
  return spatial.is_spherical();
}

}  // namespace corank::kinematics
