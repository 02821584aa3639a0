#include "corank/kinematics/loops/bodies.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "corank/kinematics/loops/parallelograms.h"

namespace corank::kinematics {
namespace {

using symbolic::ModelError;

std::string name_of(const Joint& joint) { return std::string(to_string(joint.kind)) + " joint '" + joint.name + "'"; }

/// The orthonormal frame of an axis and a direction across it, as columns.
Mat axis_frame(const Algebra& algebra, const Vec& axis, const Vec& zero) {
  return transpose({axis, zero, algebra.clean(cross(axis, zero))});
}

class Builder {
 public:
  Builder(const Robot& robot, Algebra& algebra, std::vector<KeptRotation> kept = {})
      : robot_(robot), algebra_(algebra), kept_(std::move(kept)) {}

  Bodies run() {
    joints_of_.resize(robot_.links.size());
    for (std::size_t j = 0; j < robot_.joints.size(); ++j)
      for (const JointEnd& e : robot_.joints[j].ends) joints_of_[e.link].push_back(j);
    orient_links();
    place_links();
    for (std::size_t j = 0; j < robot_.joints.size(); ++j)
      if (robot_.joints[j].kind != JointKind::fixed) add_joint(j);
    set_idle_rods_apart();
    return std::move(out_);
  }

 private:
  Vec cleaned(const Vec& v) const { return algebra_.named(algebra_.clean(v)); }
  Mat cleaned(const Mat& m) const { return {cleaned(m[0]), cleaned(m[1]), cleaned(m[2])}; }

  Mat rotation_of(const Pose& pose, const SourceLocation& where) const {
    return {algebra_.vector(pose.rotation[0], where), algebra_.vector(pose.rotation[1], where),
            algebra_.vector(pose.rotation[2], where)};
  }

  struct LinkEnd {
    Vec point, axis, zero;
    bool has_zero = false;
  };
  LinkEnd end(const Joint& joint, std::size_t i) const {
    const JointEnd& e = joint.ends[i];
    LinkEnd result{
        algebra_.vector(e.point, joint.where), algebra_.vector(e.axis, joint.where), {0, 0, 0}, e.zero.has_value()};
    if (algebra_.is_zero(result.axis)) return result;
    result.axis = cleaned(algebra_.unit(cleaned(result.axis)));
    if (e.zero) {
      const Vec zero = algebra_.vector(*e.zero, joint.where);
      result.zero = cleaned(algebra_.unit(cleaned(zero - dot(zero, result.axis) * result.axis)));
    } else {
      result.zero = cleaned(algebra_.perpendicular(result.axis));
    }
    return result;
  }

  /// The rotation of end 1's link in end 0's, which the joint keeps.
  Mat kept_rotation(const Joint& joint) const {
    if (joint.kind == JointKind::fixed) return rotation_of(joint.pose, joint.where);
    const LinkEnd a = end(joint, 0), b = end(joint, 1);
    if (a.has_zero && b.has_zero)
      return cleaned(axis_frame(algebra_, a.axis, a.zero) * transpose(axis_frame(algebra_, b.axis, b.zero)));
    if (algebra_.is_zero(cleaned(a.axis - b.axis))) return identity();
    throw ModelError(joint.where,
                     "the " + name_of(joint) +
                         " does not say how its links are turned to each other: its axis has another "
                         "direction in '" +
                         robot_.links[joint.ends[0].link].name + "' than in '" + robot_.links[joint.ends[1].link].name + "'",
                     "the same direction in both frames, or a zero direction in each");
  }

  // Rotations of links in their group's frame, which is its first link's.
  void orient_links() {
    rotation_.resize(robot_.links.size());
    link_group_.assign(robot_.links.size(), 0);
    std::size_t groups = 0;
    for (std::size_t root = 0; root < robot_.links.size(); ++root) {
      if (rotation_[root]) continue;
      rotation_[root] = identity();
      link_group_[root] = groups++;
      std::deque<std::size_t> waiting{root};
      while (!waiting.empty()) {
        const std::size_t link = waiting.front();
        waiting.pop_front();
        const auto turn = [&](std::size_t other, const Mat& kept, const SourceLocation& where, const std::string& what) {
          const Mat rotation = cleaned(*rotation_[link] * kept);
          if (!rotation_[other]) {
            rotation_[other] = rotation;
            link_group_[other] = link_group_[link];
            waiting.push_back(other);
            return;
          }
          for (std::size_t r = 0; r < 3; ++r)
            if (!algebra_.is_zero(cleaned(rotation[r] - (*rotation_[other])[r])))
              throw ModelError(where,
                               what + " another orientation of '" + robot_.links[other].name +
                                   "' than the fixed and prismatic joints before it",
                               "joints that agree");
        };
        for (const std::size_t j : joints_of_[link]) {
          const Joint& joint = robot_.joints[j];
          if (joint.kind != JointKind::fixed && !keeps_orientation(joint.kind)) continue;
          for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
            if (joint.ends[side].link != link) continue;
            const Mat kept = kept_rotation(joint);
            turn(joint.ends[1 - side].link, side == 0 ? kept : transpose(kept), joint.where,
                 "the " + name_of(joint) + " asks for");
          }
        }
        for (const KeptRotation& kept : kept_) {
          const std::string what = "parallelograms that are kept ask for";
          if (kept.first == link) turn(kept.second, kept.rotation, *robot_.keeps_parallelograms, what);
          if (kept.second == link) turn(kept.first, transpose(kept.rotation), *robot_.keeps_parallelograms, what);
        }
      }
    }
    out_.groups = groups;
  }

  void place_links() {
    std::vector<std::optional<Vec>> origin(robot_.links.size());
    out_.of_link.assign(robot_.links.size(), 0);
    out_.placement.resize(robot_.links.size());
    for (std::size_t root = 0; root < robot_.links.size(); ++root) {
      if (origin[root]) continue;
      origin[root] = Vec{0, 0, 0};
      const std::size_t body = out_.group.size();
      out_.group.push_back(link_group_[root]);
      out_.of_link[root] = body;
      std::deque<std::size_t> waiting{root};
      while (!waiting.empty()) {
        const std::size_t link = waiting.front();
        waiting.pop_front();
        for (const std::size_t j : joints_of_[link]) {
          const Joint& joint = robot_.joints[j];
          if (joint.kind != JointKind::fixed) continue;
          const Vec shift = algebra_.vector(joint.pose.translation, joint.where);
          for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
            if (joint.ends[side].link != link) continue;
            const std::size_t other = joint.ends[1 - side].link;
            // x0 = K x1 + p, in group axes o1 = o0 + R0 p.
            const Vec place =
                cleaned(side == 0 ? *origin[link] + *rotation_[link] * shift : *origin[link] - *rotation_[other] * shift);
            if (!origin[other]) {
              origin[other] = place;
              out_.of_link[other] = body;
              waiting.push_back(other);
            } else if (!algebra_.is_zero(cleaned(place - *origin[other]))) {
              throw ModelError(joint.where,
                               "the " + name_of(joint) + " puts '" + robot_.links[other].name +
                                   "' elsewhere than the fixed joints before it",
                               "joints that agree");
            }
          }
        }
      }
    }
    for (std::size_t link = 0; link < robot_.links.size(); ++link) out_.placement[link] = {*rotation_[link], *origin[link]};
  }

  void add_joint(std::size_t index) {
    const Joint& joint = robot_.joints[index];
    BodyJoint result{index, joint.kind, {}};
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t link = joint.ends[i].link;
      const LinkEnd e = end(joint, i);
      const Placement& at = out_.placement[link];
      result.ends[i] = {out_.of_link[link], cleaned(at.translation + at.rotation * e.point), cleaned(at.rotation * e.axis),
                        cleaned(at.rotation * e.zero)};
    }
    if (result.ends[0].body == result.ends[1].body)
      throw ModelError(joint.where,
                       "the " + name_of(joint) + " joins '" + robot_.links[joint.ends[0].link].name + "' and '" +
                           robot_.links[joint.ends[1].link].name + "', which fixed joints make one body",
                       "a joint between two bodies");
    out_.joints.push_back(std::move(result));
  }

  /// The joints' point that is `point` in `end.body` is, in each body that carries it as well.
  using Carried = std::map<std::size_t, Vec>;
  Carried carried(const BodyEnd& end) const {
    Carried places{{end.body, end.point}};
    std::deque<std::size_t> waiting{end.body};
    while (!waiting.empty()) {
      const std::size_t body = waiting.front();
      waiting.pop_front();
      for (const std::size_t k : joints_of_body_[body])
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
          const BodyJoint& j = out_.joints[k];
          const BodyEnd &near = j.ends[side], &far = j.ends[1 - side];
          const bool about_axis = j.kind == JointKind::revolute;
          if (near.body != body || places.contains(far.body) || !turns_about_point(j.kind)) continue;
          const Vec away = algebra_.clean(places.at(body) - near.point);
          const ex along = about_axis ? algebra_.clean(dot(away, near.axis)) : ex(0);
          if (!algebra_.is_zero(algebra_.clean(away - along * near.axis))) continue;
          places.emplace(far.body, algebra_.clean(far.point + along * far.axis));
          waiting.push_back(far.body);
        }
    }
    return places;
  }

  /// Two points that one body carries stay as far apart as they are there.
  void set_idle_rods_apart() {
    joints_of_body_.resize(out_.size());
    for (std::size_t k = 0; k < out_.joints.size(); ++k)
      for (const BodyEnd& e : out_.joints[k].ends) joints_of_body_[e.body].push_back(k);
    const auto is_idle = [&](const BodyJoint& j) {
      if (j.kind != JointKind::distance) return false;
      const Carried first = carried(j.ends[0]), second = carried(j.ends[1]);
      for (const auto& [body, p] : first) {
        const auto q = second.find(body);
        if (q == second.end()) continue;
        const Joint& joint = robot_.joints[j.index];
        const ex length = algebra_.constant(joint.length, joint.where);
        const ex square = algebra_.clean(dot(q->second - p, q->second - p));
        if (algebra_.is_zero(algebra_.clean(square - length * length))) return true;
        throw ModelError(joint.where,
                         "the rod '" + joint.name + "' has the length " + std::to_string(algebra_.value(length)) +
                             ", but the joints keep its ends at the distance " +
                             std::to_string(std::sqrt(algebra_.value(square))),
                         "geometry that fits together");
      }
      return false;
    };
    std::vector<BodyJoint> rest;
    for (BodyJoint& j : out_.joints) (is_idle(j) ? out_.idle_rods : rest).push_back(j);
    out_.joints = std::move(rest);
  }

  const Robot& robot_;
  Algebra& algebra_;
  const std::vector<KeptRotation> kept_;
  Bodies out_;
  std::vector<std::optional<Mat>> rotation_;
  std::vector<std::size_t> link_group_;
  std::vector<std::vector<std::size_t>> joints_of_, joints_of_body_;  ///< of each link, of each body, in their order
};

}  // namespace

std::optional<Vec> carried_over(const Vec& known, const BodyEnd& near, const BodyEnd& far, const Algebra& algebra) {
  if (!algebra.are_parallel(known, near.axis)) return std::nullopt;
  return ex(algebra.sign(algebra.clean(dot(known, near.axis)))) * far.axis;
}

bool Bodies::has_shapes(const Robot& robot, std::size_t body) const {
  for (std::size_t l = 0; l < robot.links.size(); ++l)
    if (of_link[l] == body && !robot.links[l].shapes.empty()) return true;
  return false;
}

bool Bodies::has_output(const Robot& robot, std::size_t body) const {
  return std::ranges::any_of(robot.outputs, [&](const Output& o) {
    return o.kind != Output::Kind::joint && (of_link[o.link] == body || of_link[o.relative_to] == body);
  });
}

Mat basis_of(const Vec& n, const Algebra& algebra) {
  const Vec e1 = algebra.perpendicular(n);
  return {e1, algebra.clean(cross(n, e1)), n};
}

Bodies bodies_of(const Robot& robot, Algebra& algebra) {
  Bodies bodies = Builder(robot, algebra).run();
  if (!robot.keeps_parallelograms) return bodies;
  std::vector<KeptRotation> kept;
  for (const Parallelogram& one : parallelograms_of(robot, bodies, algebra))
    kept.insert(kept.end(), one.opposite.begin(), one.opposite.end());
  if (kept.empty())
    throw ModelError(*robot.keeps_parallelograms, "`keep parallelograms` finds no parallelogram",
                     "four links that turn on each other about parallel axes, opposite sides of one length");
  return Builder(robot, algebra, std::move(kept)).run();
}

std::vector<symbolic::Condition> conditions_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra) {
  for (const BodyJoint& j : bodies.joints) {
    const Joint& joint = robot.joints[j.index];
    if (!keeps_orientation(joint.kind)) continue;
    const Vec a = algebra.vector(joint.ends[0].axis, joint.where), b = algebra.vector(joint.ends[1].axis, joint.where);
    for (const ex& across : cross(a, b)) static_cast<void>(algebra.sign(across.expand()));
    static_cast<void>(algebra.sign(dot(a, b).expand()));
  }
  const Algebra::Translation text(algebra);
  std::multimap<std::pair<std::size_t, std::string>, symbolic::Condition>
      by_text;  // GiNaC's order is another in each process
  for (const auto& [value, sign] : algebra.decisions()) {
    const symbolic::Condition condition{text(value), sign};
    const std::string written = condition.value.text();
    by_text.emplace(std::pair(written.size(), written), condition);
  }
  std::vector<symbolic::Condition> list;
  for (const auto& [written, condition] : by_text) list.push_back(condition);
  return list;
}

}  // namespace corank::kinematics
