// Robot::validate(): every comparison is made in the exact arithmetic of constants. Where enclosures leave a sign open, the
// number may be 0: an axis or a length is then refused, an equation (of a rotation matrix) accepted.
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <numeric>
#include <set>

#include "corank/kinematics/robot/constant_scope.h"
#include "corank/kinematics/robot/robot.h"
#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;

bool has_axis(const Joint& joint, const JointEnd& end) {
  const bool has_cone = joint.kind == JointKind::spherical && joint.range();
  const bool is_pin = joint.kind == JointKind::slot && &end == &joint.ends[1];
  return (traits(joint.kind).has_axis && !is_pin) || has_cone;
}

class RobotValidator {
 public:
  explicit RobotValidator(const Robot& robot) : robot_(robot), scope_(robot.constants) {}

  void check_links() const {
    if (robot_.links.empty()) throw ModelError(whole(), "the robot has no links", "at least one, in [LINKS]");
    check_names(robot_.links, "links");
    check_names(robot_.joints, "joints");
    check_names(robot_.outputs, "outputs");
  }

  void check_shapes() {
    for (const Link& link : robot_.links) {
      const std::string owner = "a shape of the link " + in_quotes(link.name);
      for (const Shape& shape : link.shapes) {
        for (const Vector& point : shape.points) check(point, owner, shape.where);
        if (shape.kind == Shape::Kind::polygon) continue;
        require_positive(shape.radius, "the radius of " + owner, "a positive radius", shape.where);
      }
    }
  }

  void check_joint(const Joint& joint) {
    const std::string what = described(joint);
    const symbolic::SourceLocation where = at(joint.where);
    for (const JointEnd& end : joint.ends) {
      if (end.link >= robot_.links.size())
        throw ModelError(where, what + " has an end on a link that is not there", "two of the robot's links");
    }
    const std::string& first = robot_.links[joint.ends[0].link].name;
    if (joint.ends[0].link == joint.ends[1].link)
      throw ModelError(where, what + " connects the link " + in_quotes(first) + " with itself", "two different links");
    for (const JointEnd& end : joint.ends) check_end(joint, end, what, where);
    check_ranges(joint, what, where);
    if (joint.kind == JointKind::fixed) check_pose(joint.pose, what, where);
    if (joint.kind == JointKind::distance || joint.kind == JointKind::parallelogram)
      require_positive(joint.length, "the length of " + what, "a length above 0", where);
    if (joint.actuated && !has_coordinate(joint.kind))
      throw ModelError(where, what + " cannot be actuated: it has no angle or displacement of its own",
                       "an actuated joint of the kind " + symbolic::listed(kind_names(true), " or "));
  }

  /// Each follows one joint, and nobody himself.
  void check_couplings() {
    std::vector<std::size_t> driver(robot_.joints.size());
    std::iota(driver.begin(), driver.end(), std::size_t{0});
    const auto first = [&](std::size_t j) {
      while (driver[j] != j) j = driver[j];
      return j;
    };
    for (const Coupling& c : robot_.couplings) {
      const symbolic::SourceLocation where = at(c.where);
      if (c.driver >= driver.size() || c.follower >= driver.size())
        throw ModelError(where, "a joint follows one that is not there", "two of the robot's joints");
      const Joint &follower = robot_.joints[c.follower], &leader = robot_.joints[c.driver];
      const std::string what = described(follower) + " follows " + described(leader);
      const bool slides = follower.kind == JointKind::prismatic;
      if (!moves_one_way(follower.kind) || !moves_one_way(leader.kind) || slides != (leader.kind == JointKind::prismatic))
        throw ModelError(where, what, "two joints that turn, revolute or parallelogram, or two prismatic ones");
      if (driver[c.follower] != c.follower)
        throw ModelError(where, described(follower) + " follows two joints", "one joint that it follows");
      if (first(c.driver) == c.follower) throw ModelError(where, what + ", which follows it", "a joint that leads");
      driver[c.follower] = c.driver;
      const std::string ratio = "the ratio by which " + what;
      if (scope_.sign(c.ratio, ratio, where).value_or(0) == 0)
        throw ModelError(where, ratio + ", " + in_quotes(c.ratio.text()) + ", is 0", "another number, or a fixed joint");
      scope_.value(c.offset, "the offset by which " + what, where);
    }
    std::vector<int> actuated(driver.size(), -1);
    for (std::size_t j = 0; j < driver.size(); ++j) {
      if (!robot_.joints[j].actuated) continue;
      int& known = actuated[first(j)];
      if (known >= 0)
        throw ModelError(
            at(robot_.joints[j].where),
            described(robot_.joints[j]) + " and " + described(robot_.joints[known]) + " are actuated, but turn together",
            "one of joints that follow each other");
      known = static_cast<int>(j);
    }
    for (const Output& output : robot_.outputs)
      if (output.kind == Output::Kind::joint && output.joint < driver.size() && actuated[first(output.joint)] >= 0)
        throw ModelError(at(output.where),
                         "the output " + in_quotes(output.name) + " is of " + described(robot_.joints[output.joint]) +
                             ", which turns with an actuated one: its coordinate is an input",
                         "a joint that no actuator drives");
  }

  void check_output(const Output& output) {
    const std::string what = "the output " + in_quotes(output.name);
    const symbolic::SourceLocation where = at(output.where);
    if (output.kind == Output::Kind::joint) {
      if (output.joint >= robot_.joints.size())
        throw ModelError(where, what + " is of a joint that is not there", "a joint of the robot");
      const Joint& joint = robot_.joints[output.joint];
      if (!has_coordinate(joint.kind))
        throw ModelError(where, what + " is of " + described(joint) + ", which has no angle or displacement of its own",
                         "a joint of the kind " + symbolic::listed(kind_names(true), " or "));
      if (joint.actuated)
        throw ModelError(where, what + " is of " + described(joint) + ", which is actuated: its coordinate is an input",
                         "a joint that no actuator drives");
      return;
    }
    const std::size_t links = robot_.links.size();
    if (output.link >= links || output.relative_to >= links)
      throw ModelError(where, what + " is of a link that is not there", "a link of the robot");
    if (output.link == output.relative_to)
      throw ModelError(where, what + " is of the link " + in_quotes(robot_.links[output.link].name) + " in itself",
                       "two different links; without `in` an output is measured in the first link, the ground");
    check(output.point, what, where);
    if (output.kind == Output::Kind::direction) require_direction(output.point, "the direction of " + what, where);
    check_slice(output, what, where);
  }

  void check_components(const Output& output, const std::string& what, const symbolic::SourceLocation& where) {
    const auto& asked = output.asked;
    if (asked[0] && asked[1] && asked[2]) return;
    if (output.kind != Output::Kind::position)
      throw ModelError(where, what + " is asked for some components only, but is not a position", "`only` after a position");
    if (!asked[0] && !asked[1] && !asked[2]) throw ModelError(where, what + " has no component", "x, y or z");
    for (std::size_t i = 0; i < 3; ++i)
      if (!asked[i] && output.ranges[i])
        throw ModelError(where, std::string("there is a range of ") + "xyz"[i] + ", for which " + what + " does not ask",
                         "ranges of the components after only");
  }

  void check_slice(const Output& output, const std::string& what, const symbolic::SourceLocation& where) {
    check_components(output, what, where);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!output.ranges[i]) continue;
      if (output.kind != Output::Kind::position && output.kind != Output::Kind::pose)
        throw ModelError(where, what + " has a range, but no components that are lengths",
                         "a range of a position or a pose");
      check_range(*output.ranges[i], std::string("the range of ") + "xyz"[i] + " of " + what, where);
    }
    if (output.turn) {
      if (output.kind != Output::Kind::orientation && output.kind != Output::Kind::pose)
        throw ModelError(where, what + " has a range of an angle, but no angle", "a range of an orientation or a pose");
      check_range(*output.turn, "the range of phi of " + what, where);
    }
    if (!output.kept) return;
    if (output.kind != Output::Kind::orientation && output.kind != Output::Kind::pose)
      throw ModelError(where, what + " keeps an orientation, but it is not an orientation or a pose",
                       "`keeps` after an orientation or a pose");
    if (output.relative_to != 0)
      throw ModelError(where, what + " keeps an orientation relative to " + in_quotes(robot_.links[output.relative_to].name),
                       "one in the ground " + in_quotes(robot_.links[0].name));
    check_pose(*output.kept, what, where);
    for (const Expression& e : output.kept->translation)
      if (scope_.sign(e, what, where).value_or(1) != 0)
        throw ModelError(where, what + " keeps more than a rotation", "a product of Rx Ry Rz, or TR without a translation");
  }

  void check_connections() const {
    boost::disjoint_sets_with_storage<> joined(robot_.links.size());
    for (const Joint& joint : robot_.joints) joined.union_set(joint.ends[0].link, joint.ends[1].link);
    for (std::size_t i = 1; i < robot_.links.size(); ++i) {
      if (joined.find_set(i) == joined.find_set(std::size_t{0})) continue;
      throw ModelError(at(robot_.links[i].where),
                       "no joint connects the link " + in_quotes(robot_.links[i].name) + " with the first link, " +
                           in_quotes(robot_.links[0].name) + ", which is the ground",
                       "joints from every link to the ground, directly or through other links");
    }
  }

 private:
  symbolic::SourceLocation whole() const { return {robot_.file.empty() ? robot_.name : robot_.file, 0, 0}; }
  symbolic::SourceLocation at(const symbolic::SourceLocation& where) const { return where.line > 0 ? where : whole(); }

  void check_names(const auto& things, const std::string& noun) const {
    std::set<std::string> taken;
    for (const auto& thing : things)
      if (!taken.insert(thing.name).second)
        throw ModelError(at(thing.where), "there are two " + noun + " " + in_quotes(thing.name),
                         "another name for one of them");
  }

  std::string described(const Joint& joint) const {
    const std::string kind = to_string(joint.kind);
    std::string links;
    for (const JointEnd& end : joint.ends)
      if (end.link < robot_.links.size()) links += (links.empty() ? "" : "–") + robot_.links[end.link].name;
    return "the " + kind + " joint " + in_quotes(joint.is_named ? joint.name : links);
  }

  void check(const Vector& v, const std::string& owner, const symbolic::SourceLocation& where) {
    for (const Expression& e : v) scope_.value(e, owner, where);
  }

  void require_positive(const Expression& e, const std::string& what, const std::string& expectation,
                        const symbolic::SourceLocation& where) {
    const std::optional<int> sign = scope_.sign(e, what, where);
    if (sign == 1) return;
    const std::string problem = sign == 0 ? "is 0" : sign == -1 ? "is negative" : "cannot be distinguished from 0";
    throw ModelError(where, what + ", " + in_quotes(e.text()) + ", " + problem, expectation);
  }

  bool is_surely_not_zero(const Expression& e, const std::string& what, const symbolic::SourceLocation& where) {
    return scope_.sign(e, what, where).value_or(0) != 0;
  }
  bool has_length(const Vector& v, const std::string& what, const symbolic::SourceLocation& where) {
    return std::ranges::any_of(v, [&](const Expression& e) { return is_surely_not_zero(e, what, where); });
  }

  void require_direction(const Vector& v, const std::string& what, const symbolic::SourceLocation& where) {
    if (!has_length(v, what, where)) throw ModelError(where, what + " has the length 0", "a direction such as (0, 0, 1)");
  }

  void check_end(const Joint& joint, const JointEnd& end, const std::string& what, const symbolic::SourceLocation& where) {
    const std::string on = " of " + what + " on the link " + in_quotes(robot_.links[end.link].name);
    check(end.point, "the point" + on, where);
    check(end.axis, "the axis" + on, where);
    if (has_axis(joint, end)) require_direction(end.axis, "the axis" + on, where);
    if (!end.zero) return;
    const std::string zero = "the zero direction" + on;
    require_direction(*end.zero, zero, where);
    if (has_axis(joint, end) && !has_length(cross(end.axis, *end.zero), zero, where))
      throw ModelError(where, zero + " lies along the axis", "a direction across the axis");
  }

  void check_ranges(const Joint& joint, const std::string& what, const symbolic::SourceLocation& where) {
    const std::size_t most = traits(joint.kind).ranges;
    if (joint.ranges.size() > most)
      throw ModelError(where, what + " has " + std::to_string(joint.ranges.size()) + " ranges",
                       most == 0   ? "none for this kind of joint"
                       : most == 1 ? "at most one"
                                   : "at most two");
    for (const std::optional<Range>& range : joint.ranges) {
      if (!range) continue;
      const std::string of = "the range of " + what;
      check_range(*range, of, where);
      const bool is_size = joint.kind == JointKind::spherical || is_extensible(joint.kind);
      if (is_size && scope_.sign(range->lower, of, where) == -1)
        throw ModelError(where, of + " begins with " + in_quotes(range->lower.text()) + ", which is negative",
                         joint.kind == JointKind::spherical ? "[half angle]" : "the range of a length");
    }
  }

  void check_range(const Range& range, const std::string& of, const symbolic::SourceLocation& where) {
    scope_.value(range.lower, of, where);
    if (scope_.sign(folded_difference(range.upper, range.lower), of, where) == -1)
      throw ModelError(where,
                       of + " is empty: " + in_quotes(range.lower.text()) + " is above " + in_quotes(range.upper.text()),
                       "[lower, upper]");
  }

  void check_pose(const Pose& pose, const std::string& what, const symbolic::SourceLocation& where) {
    const std::string of = "the pose of " + what;
    check(pose.translation, of, where);
    const auto require_equal = [&](const Expression& a, int b, const std::string& problem) {
      if (is_surely_not_zero(folded_difference(a, b), of, where))
        throw ModelError(where, of + " is not a rotation and translation: " + problem, "a rotation matrix");
    };
    const auto& r = pose.rotation;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string row = "row " + std::to_string(i + 1);
      require_equal(dot(r[i], r[i]), 1, row + " does not have the length 1");
      for (std::size_t j = 0; j < i; ++j)
        require_equal(dot(r[i], r[j]), 0, row + " is not perpendicular to row " + std::to_string(j + 1));
    }
    if (scope_.sign(dot(cross(r[0], r[1]), r[2]), of, where) == -1)
      throw ModelError(where, of + " is not a rotation and translation: the matrix is a reflection", "a determinant of 1");
  }

  const Robot& robot_;
  ConstantScope scope_;
};

}  // namespace

void Robot::validate() const {
  RobotValidator validator(*this);
  validator.check_links();
  for (const Joint& joint : joints) validator.check_joint(joint);
  for (const Output& output : outputs) validator.check_output(output);
  validator.check_couplings();
  validator.check_connections();
  validator.check_shapes();
}

}  // namespace corank::kinematics
