#include "corank/kinematics/equations/six_joints.h"

#include <algorithm>

#include "corank/kinematics/loops/bodies.h"
#include "corank/symbolic/algebra/ginac_lock.h"

namespace corank::kinematics {
namespace {

constexpr std::size_t kJoints = 6;

// A joint of the chain, from the near body to the far one, which is farther from the ground.
struct Step {
  const BodyJoint* joint;
  std::size_t near;  // which of its ends is on the near body
  const BodyEnd& end(bool far) const { return joint->ends[far ? 1 - near : near]; }
  int sign() const { return near == 0 ? 1 : -1; }  // of the joint's angle, by which the far body is turned
};

// From the ground to the body; empty where it is no such chain.
std::vector<Step> chain_to(const Robot& robot, const Bodies& bodies, std::size_t body) {
  std::vector<Step> chain;
  if (bodies.joints.size() != kJoints || bodies.size() != kJoints + 1 || !bodies.idle_rods.empty()) return chain;
  std::size_t at = 0;
  for (std::size_t k = 0; k < kJoints; ++k) {
    const auto is_next = [&](const BodyJoint& j, std::size_t side) {
      return j.ends[side].body == at && std::ranges::none_of(chain, [&](const Step& step) { return step.joint == &j; });
    };
    const BodyJoint* next = nullptr;
    std::size_t side = 0, found = 0;
    for (const BodyJoint& j : bodies.joints)
      for (const std::size_t s : {std::size_t{0}, std::size_t{1}})
        if (is_next(j, s)) next = &j, side = s, ++found;
    if (found != 1 || next->kind != JointKind::revolute || robot.is_coupled(next->index)) return {};
    chain.push_back({next, side});
    at = next->ends[1 - side].body;
  }
  return at == body ? chain : std::vector<Step>{};
}

// Of the zero direction, the one that is 90° ahead of it about the axis, and the axis, as rows.
Mat basis(const BodyEnd& end) { return {end.zero, cross(end.axis, end.zero), end.axis}; }

// Of a vector that is fixed in one of a joint's two bodies, in the other.
struct Turning {
  Mat from, to;  // bases
  ex cosine, sine;

  Vec operator()(const Vec& v) const {
    const Vec w = from * v;
    return transpose(to) * Vec{cosine * w[0] - sine * w[1], sine * w[0] + cosine * w[1], w[2]};
  }
};

// A link between two joints whose axes are not parallel: vectors in it as sums of the axes and their cross product.
class SkewLink {
 public:
  SkewLink(const BodyEnd& first, const BodyEnd& second)
      : first_(first.axis), second_(second.axis), between_(coefficients(second.point - first.point)) {}
  ex cosine() const { return dot(first_, second_); }
  Vec coefficients(const Vec& v) const {
    const ex k = cosine(), s = 1 - k * k, a = dot(v, first_), b = dot(v, second_);
    return {(a - k * b) / s, (b - k * a) / s, dot(v, cross(first_, second_)) / s};
  }
  const Vec& between() const { return between_; }  // the second joint's point from the first one's

 private:
  Vec first_, second_, between_;
};

Vec combined(const Vec& coefficients, const Vec& a, const Vec& b) {
  return coefficients[0] * a + coefficients[1] * b + coefficients[2] * cross(a, b);
}

// The loop's joints in order, those of the ground's body twice: the far end of the last one is on the hand, which is held.
class Loop {
 public:
  Loop(const Robot& robot, std::size_t hand, const Bodies& bodies, std::vector<Step> chain, Algebra& algebra)
      : robot_(robot), chain_(std::move(chain)), algebra_(algebra), mechanism_(robot.name) {
    const Placement& placed = bodies.placement[hand];
    // Symbols without a value: what is decided while equations are written is decided by the links alone.
    std::array<ex, kHandPose.size()> pose;
    for (std::size_t k = 0; k < pose.size(); ++k) pose[k] = algebra.coordinate(kHandPose[k]);
    const Mat rotation{{{pose[0], pose[1], pose[2]}, {pose[3], pose[4], pose[5]}, {pose[6], pose[7], pose[8]}}};
    const Mat in_hand = transpose(placed.rotation);
    const BodyEnd& own = chain_.back().end(true);
    held_ = {0, rotation * (in_hand * (own.point - placed.translation)) + Vec{pose[9], pose[10], pose[11]},
             rotation * (in_hand * own.axis), rotation * (in_hand * own.zero)};
  }

  /// Of the three that begin with the k-th: has each of the links between them two axes that are not parallel?
  bool has_skew_links(std::size_t k) const {
    return !algebra_.are_parallel(far(k).axis, near(k + 1).axis) &&
           !algebra_.are_parallel(far(k + 1).axis, near(k + 2).axis);
  }
  /// How many of the links' coefficients are not 0: the fewer, the simpler its equations.
  int weight(std::size_t k) const {
    int weight = 0;
    for (const std::size_t j : {k, k + 1}) {
      const SkewLink link(far(j), near(j + 1));
      for (const ex& c : link.between()) weight += algebra_.is_zero(c) ? 0 : 1;
      weight += algebra_.is_zero(link.cosine()) ? 0 : 1;
    }
    return weight;
  }

  SixJoints write(std::size_t k);

 private:
  const Step& step(std::size_t k) const { return chain_[k % kJoints]; }
  const Joint& joint(std::size_t k) const { return robot_.joints[step(k).joint->index]; }
  const BodyEnd& near(std::size_t k) const { return step(k).end(false); }
  const BodyEnd& far(std::size_t k) const { return k % kJoints == kJoints - 1 ? held_ : step(k).end(true); }

  // The joint's angle becomes a coordinate.
  Turning turn(std::size_t k, bool to_far);
  Vec direction(std::size_t k, const Vec& value);
  void equals(const ex& left, const ex& right, std::size_t k) { equations_.push_back({algebra_.clean(left - right), k}); }
  // Of the angle by which the far body's zero is turned from the near one's: both directions are given in one frame.
  void angle_between(std::size_t k, const Vec& axis, const Vec& zero, const Vec& turned);
  std::string free_name(std::string wanted) const {
    while (mechanism_.has(wanted) || robot_.find_joint(wanted) >= 0) wanted += "_";
    return wanted;
  }
  ex length(const std::string& wanted) {
    const std::string name = free_name(wanted);
    mechanism_.length(name, Expression(-11) / 10, Expression(11) / 10);
    return algebra_.coordinate(name);
  }

  const Robot& robot_;
  const std::vector<Step> chain_;
  Algebra& algebra_;
  BodyEnd held_;
  symbolic::Mechanism mechanism_;
  std::vector<std::pair<ex, std::size_t>> equations_;
  std::vector<SixJoints::Angle> angles_{kJoints};
};

Turning Loop::turn(std::size_t k, bool to_far) {
  const Joint& j = joint(k);
  SixJoints::Angle& angle = angles_[k % kJoints];
  angle.joint = angle.coordinate = j.name;
  angle.range = j.range();
  const Range range = angle.range.value_or(Range{-symbolic::pi(), symbolic::pi()});
  mechanism_.angle(j.name, range.lower, range.upper, j.where);
  const ex theta = algebra_.coordinate(j.name);
  // A vector that is fixed in the near body turns backwards, as the far one sees it.
  const int sign = step(k).sign() * (to_far ? -1 : 1);
  const BodyEnd &from = to_far ? near(k) : far(k), &to = to_far ? far(k) : near(k);
  return {basis(from), basis(to), GiNaC::cos(theta), sign * GiNaC::sin(theta)};
}

Vec Loop::direction(std::size_t k, const Vec& value) {
  Vec v;
  for (std::size_t i = 0; i < 3; ++i) {
    const ex cleaned = algebra_.clean(value[i]);
    if (algebra_.is_constant(cleaned)) {
      v[i] = cleaned;
      continue;
    }
    v[i] = length("axis_" + joint(k).name + "_" + "xyz"[i]);
    equals(v[i], cleaned, k);
  }
  return v;
}

void Loop::angle_between(std::size_t k, const Vec& axis, const Vec& zero, const Vec& turned) {
  const Joint& j = joint(k);
  SixJoints::Angle& angle = angles_[k % kJoints];
  angle.joint = j.name;
  angle.range = j.range();
  angle.cosine = free_name("cos_" + j.name);
  const ex cosine = length(angle.cosine);
  angle.sine = free_name("sin_" + j.name);
  const ex sine = length(angle.sine);
  equals(cosine, dot(zero, turned), k);
  equals(sine, step(k).sign() * dot(axis, cross(zero, turned)), k);
}

SixJoints Loop::write(std::size_t k) {
  for (const symbolic::Constant& c : robot_.constants) mechanism_.constant(c.name, c.value, c.where);
  for (const char* name : kHandPose) mechanism_.constant(name, 1);
  const std::size_t a = k, b = k + 1, c = k + 2, d = k + 3, e = k + 4, f = k + 5;
  // All in the frame of the body between d and e.
  const Turning by_d = turn(d, true), by_e = turn(e, false), by_f = turn(f, false);
  const auto in_d = [&](const Vec& v) { return by_d(v); };
  const auto in_e = [&](const Vec& v) { return by_e(algebra_.clean(by_f(v))); };
  const Vec z_c = direction(c, in_d(far(c).axis)), z_a = direction(a, in_e(near(a).axis));
  const Vec o_c = far(d).point + in_d(far(c).point - near(d).point),
            o_a = near(e).point + by_e(near(f).point - far(e).point) + in_e(near(a).point - far(f).point);
  Vec z_b;
  for (std::size_t i = 0; i < 3; ++i) z_b[i] = length("axis_" + joint(b).name + "_" + "xyz"[i]);
  const SkewLink first(far(a), near(b)), second(far(b), near(c));
  const Vec closing = o_a + combined(first.between(), z_a, z_b) + combined(second.between(), z_b, z_c);
  for (std::size_t i = 0; i < 3; ++i) equals(o_c[i], closing[i], b);
  equals(dot(z_b, z_b), 1, b);
  equals(dot(z_a, z_b), first.cosine(), a);
  equals(dot(z_b, z_c), second.cosine(), c);
  angle_between(a, z_a, in_e(near(a).zero), combined(first.coefficients(far(a).zero), z_a, z_b));
  angle_between(b, z_b, combined(first.coefficients(near(b).zero), z_a, z_b),
                combined(second.coefficients(far(b).zero), z_b, z_c));
  angle_between(c, z_c, combined(second.coefficients(near(c).zero), z_b, z_c), in_d(far(c).zero));

  const Algebra::Translation text(algebra_);
  for (const symbolic::Constant& constant : algebra_.named_constants()) mechanism_.constant(constant.name, constant.value);
  for (const auto& [equation, of] : equations_)
    mechanism_.constrain(text(equation) == Expression(0), joint(of).where, joint(of).name);
  for (const SixJoints::Angle& angle : angles_) {
    if (angle.cosine.empty() || !angle.range) continue;
    const Expression middle = (angle.range->lower + angle.range->upper) / 2,
                     half = (angle.range->upper - angle.range->lower) / 2;
    if (algebra_.sign(algebra_.constant(half - symbolic::pi(), {})) >= 0) continue;
    mechanism_.constrain(
        Expression::symbol(angle.cosine) * cos(middle) + Expression::symbol(angle.sine) * sin(middle) >= cos(half), {},
        "range of " + angle.joint);
  }
  return {std::move(mechanism_), std::move(angles_)};
}

}  // namespace

std::optional<SixJoints> six_joints(const Robot& robot, std::size_t hand) {
  robot.validate();
  if (!robot.equations.empty()) return std::nullopt;
  for (const Output& o : robot.outputs)  // a slice of the robot's motion
    if (o.kept || o.turn || std::ranges::any_of(o.ranges, [](const auto& r) { return r.has_value(); })) return std::nullopt;
  const symbolic::GinacLock lock;
  for (const char* name : kHandPose) {
    const auto is_name = [&](const symbolic::Constant& c) { return c.name == name; };
    if (std::ranges::any_of(robot.constants, is_name) || robot.find_joint(name) >= 0) return std::nullopt;
  }
  Algebra algebra(robot);
  const Bodies bodies = bodies_of(robot, algebra);
  std::vector<Step> chain = chain_to(robot, bodies, bodies.of_link[hand]);
  if (chain.empty()) return std::nullopt;
  for (const Step& step : chain)
    if (const auto range = robot.joints[step.joint->index].range())
      if (algebra.is_zero(algebra.constant(range->upper - range->lower, {}))) return std::nullopt;
  Loop loop(robot, hand, bodies, std::move(chain), algebra);
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k + 2 < kJoints; ++k)  // both links are the arm's
    if (loop.has_skew_links(k) && (!best || loop.weight(k) < loop.weight(*best))) best = k;
  if (!best) return std::nullopt;
  return loop.write(*best);
}

std::optional<SignedArm> signed_arm(const Robot& robot, std::size_t hand) {
  robot.validate();
  const symbolic::GinacLock lock;
  Algebra algebra(robot);
  const Bodies bodies = bodies_of(robot, algebra);
  const std::vector<Step> chain = chain_to(robot, bodies, bodies.of_link[hand]);
  if (chain.empty()) return std::nullopt;
  // Of the two axes in the link behind joint k, from 1.
  const auto near = [&](std::size_t k) { return chain[k - 1].end(true); };
  const auto far = [&](std::size_t k) { return chain[k].end(false); };
  const auto parallel = [&](std::size_t k) { return algebra.are_parallel(near(k).axis, far(k).axis); };
  const auto perpendicular = [&](std::size_t k) { return algebra.is_zero(dot(near(k).axis, far(k).axis)); };
  const auto meet = [&](std::size_t k) { return !parallel(k) && algebra.is_zero(SkewLink(near(k), far(k)).between()[2]); };
  if (!perpendicular(1) || !parallel(2) || !meet(5)) return std::nullopt;
  if (parallel(3) && perpendicular(4)) return SignedArm::three_parallel_axes;
  if (parallel(3) || !meet(4)) return std::nullopt;
  // Where axis 4 meets axis 5, and where axis 6 does, from the joint's point.
  const ex gap = SkewLink(near(4), far(4)).between()[1] + SkewLink(near(5), far(5)).between()[0];
  return algebra.is_zero(gap) ? std::optional(SignedArm::spherical_wrist) : std::nullopt;
}

}  // namespace corank::kinematics
