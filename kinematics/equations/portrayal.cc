#include <algorithm>
#include <cmath>

#include "corank/kinematics/equations/drafting.h"

namespace corank::kinematics {
namespace {

using Part = symbolic::DrawingPart::Kind;

class Portrayal : Drafter {
 public:
  Portrayal(const Drafter& drafter, Space space, const std::function<Motion(std::size_t, const Vec&)>& place)
      : Drafter(drafter), space_(space), place_(place), corners_(bodies_.size()) {}

  void run() {
    // Joints that turn name the points that others share with them.
    for (const BodyJoint& j : bodies_.joints)
      if (turns_about_point(j.kind)) add_corners(j);
    for (const BodyJoint& j : bodies_.joints)
      if (!turns_about_point(j.kind)) add_corners(j);
    for (const BodyJoint& j : bodies_.idle_rods) add_corners(j);
    for (const Output& output : robot_.outputs)
      if (output.kind == Output::Kind::position || output.kind == Output::Kind::pose) {
        const Placement& at = bodies_.placement[output.link];
        const std::string effector =
            corner(bodies_.of_link[output.link], at.translation + at.rotation * algebra_.vector(output.point, output.where),
                   output.name);
        if (std::ranges::find(effectors_, effector) == effectors_.end()) effectors_.push_back(effector);
      }
    const bool solid = add_shapes();
    for (std::size_t body = 1; body < bodies_.size(); ++body)
      if (!solid || !bodies_.has_shapes(robot_, body)) add_body(body);
    for (const BodyJoint& j : bodies_.joints) add_joint(j);
    for (const BodyJoint& j : bodies_.idle_rods) add_joint(j);
    if (!effectors_.empty()) draft_.part(Part::effector, effectors_);
  }

 private:
  struct Corner {
    Vec local;
    std::string name;
  };

  void add_corners(const BodyJoint& j) {
    if (is_on_rail(j)) {
      const std::size_t block = block_of(j);
      corner(j.ends[block].body, local(j.ends[block]), label(j, block));
      return;
    }
    const std::string at = corner(j.ends[0].body, local(j.ends[0]), label(j, 0));
    if (!turns_about_point(j.kind)) {
      corner(j.ends[1].body, local(j.ends[1]), label(j, 1));
    } else if (!known(j.ends[1].body, local(j.ends[1]))) {
      corners_[j.ends[1].body].push_back({local(j.ends[1]), at});
    }
  }

  /// A block that slides along the ground.
  bool is_on_rail(const BodyJoint& j) const {
    if (space_ != Space::planar) return false;
    return (j.kind == JointKind::slot && j.ends[0].body == 0) ||
           (j.kind == JointKind::prismatic && (j.ends[0].body == 0 || j.ends[1].body == 0));
  }
  static std::size_t block_of(const BodyJoint& j) { return j.ends[0].body == 0 ? 1 : 0; }

  /// As the point is called, of an end or of the other one, or as the joint is.
  std::string label(const BodyJoint& j, std::size_t end) const {
    const Joint& of = joint(j);
    if (turns_about_point(j.kind) && of.ends[end].label.empty()) end = 1 - end;
    return of.ends[end].label.empty() ? of.name : of.ends[end].label;
  }

  /// Where a joint is drawn: of a spherical robot, whose axes meet, on a sphere.
  Vec local(const BodyEnd& end) const { return space_ == Space::spherical ? end.point + end.axis : end.point; }

  const Corner* known(std::size_t body, const Vec& local) const {
    for (const Corner& c : corners_[body])
      if (algebra_.is_zero(algebra_.clean(c.local - local))) return &c;
    return nullptr;
  }

  std::string corner(std::size_t body, const Vec& local, const std::string& wanted = "P") {
    if (const Corner* same = known(body, local)) return same->name;
    const Motion motion = place_(body, local);
    const std::string name = draft_.point(wanted, motion.at, motion.velocity, space_ == Space::planar ? 2 : 3);
    corners_[body].push_back({local, name});
    return name;
  }

  std::array<double, 3> value(const Vec& v) const {
    return {algebra_.value(v[0]), algebra_.value(v[1]), algebra_.value(v[2])};
  }

  /// Around their middle, as seen along the direction in which they are flattest.
  std::vector<std::string> in_order(const std::vector<Corner>& corners) const {
    std::vector<std::array<double, 3>> at;
    std::array<double, 3> middle{0, 0, 0}, normal{0, 0, 0};
    for (const Corner& c : corners) at.push_back(value(c.local));
    for (const auto& p : at)
      for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i] / static_cast<double>(at.size());
    const auto product = [&](const auto& a, const auto& b) {
      return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto from_middle = [&](std::size_t k) {
      return std::array<double, 3>{at[k][0] - middle[0], at[k][1] - middle[1], at[k][2] - middle[2]};
    };
    const auto length = [](const auto& v) { return std::hypot(v[0], v[1], v[2]); };
    for (std::size_t a = 0; a < at.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (const auto n = product(from_middle(a), from_middle(b)); length(n) > length(normal)) normal = n;
    const auto first = from_middle(0), across = product(normal, first);
    const auto dot_of = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    std::vector<std::pair<double, std::string>> sorted;
    for (std::size_t k = 0; k < at.size(); ++k)
      sorted.emplace_back(
          std::atan2(dot_of(from_middle(k), across) / (length(normal) + 1e-300), dot_of(from_middle(k), first)),
          corners[k].name);
    std::ranges::sort(sorted);
    std::vector<std::string> names;
    for (const auto& [angle, name] : sorted) names.push_back(name);
    return names;
  }

  /// Without those next to the middle of four or more, such as a platform's centre, which are no corners of a solid.
  std::vector<Corner> outer(const std::vector<Corner>& corners) const {
    if (corners.size() < 4) return corners;
    std::array<double, 3> middle{0, 0, 0};
    for (const Corner& c : corners)
      for (std::size_t i = 0; i < 3; ++i) middle[i] += value(c.local)[i] / static_cast<double>(corners.size());
    const auto distance = [&](const Corner& c) {
      const std::array<double, 3> p = value(c.local);
      return std::hypot(p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]);
    };
    double farthest = 0;
    for (const Corner& c : corners) farthest = std::max(farthest, distance(c));
    std::vector<Corner> list;
    for (const Corner& c : corners)
      if (distance(c) > 0.2 * farthest) list.push_back(c);
    return list.size() < 3 ? corners : list;
  }

  /// The solids of the robot's file, unless they are too many to move smoothly.
  bool add_shapes() {
    constexpr std::size_t kMostShapes = 150;
    std::size_t count = 0;
    for (const Link& link : robot_.links) count += link.shapes.size();
    if (count == 0 || count > kMostShapes) return false;
    for (std::size_t l = 0; l < robot_.links.size(); ++l)
      for (const Shape& shape : robot_.links[l].shapes) {
        const std::string& name = robot_.links[l].name;
        std::vector<std::string> names;
        for (const Vector& p : shape.points) {
          const Placement& at = bodies_.placement[l];
          const Motion motion = place_(bodies_.of_link[l], at.translation + at.rotation * algebra_.vector(p, shape.where));
          names.push_back(draft_.point("s", motion.at, {}, space_ == Space::planar ? 2 : 3));
        }
        switch (shape.kind) {
          case Shape::Kind::sphere: draft_.part(Part::sphere, names, name, shape.radius, shape.colour); break;
          case Shape::Kind::cylinder: draft_.part(Part::cylinder, names, name, shape.radius, shape.colour); break;
          case Shape::Kind::polygon:
            draft_.part(names.size() < 3 ? Part::link : Part::platform, names, name, {}, shape.colour);
        }
      }
    return true;
  }

  void add_body(std::size_t body) {
    std::vector<Corner> corners;
    for (const Corner& c : corners_[body])
      if (std::ranges::none_of(corners, [&](const Corner& other) { return other.name == c.name; })) corners.push_back(c);
    if (corners.size() < 2) return;
    const std::string body_name =
        bodies_.has_shapes(robot_, body) ? "" : name_of(body);  // what is drawn in their place is not the body
    if (corners.size() == 2) {
      draft_.part(Part::link, {corners[0].name, corners[1].name}, body_name);
    } else {
      draft_.part(Part::platform, in_order(outer(corners)), body_name);
    }
  }

  /// The largest length from one place to another on a body, or of a rod; 1 where there is none. Sizes a rail without end.
  double size() const {
    double largest = 0;
    for (const auto& corners : corners_)
      for (const Corner& a : corners)
        for (const Corner& b : corners) {
          const std::array<double, 3> p = value(a.local), q = value(b.local);
          largest = std::max(largest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
    for (const Joint& joint : robot_.joints)
      if (joint.kind == JointKind::distance || joint.kind == JointKind::parallelogram)
        largest = std::max(largest, algebra_.value(algebra_.constant(joint.length, joint.where)));
    return largest > 0 ? largest : 1;
  }

  /// A rail as long as the joint's range and the block; about the ground's point where the joint has no range.
  void add_block(const BodyJoint& j) {
    const Joint& of = joint(j);
    const std::size_t block = block_of(j);
    const BodyEnd& ground = j.ends[1 - block];
    const int side = block == 1 ? 1 : -1;
    const double typical = size();
    double low = -typical, high = typical;
    if (const auto range = of.range()) {
      low = algebra_.value(algebra_.constant(range->lower, of.where));
      high = algebra_.value(algebra_.constant(range->upper, of.where));
    }
    const double over = 0.1 * std::max(high - low, typical);  // beyond the block's last places
    const double step =
        std::pow(10, std::floor(std::log10(typical)) - 2);  // a round one: a picture's point is a short number
    const auto end = [&](double way) {
      const ex rounded = side * GiNaC::numeric(std::lround(way / step)) *
                         GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(std::lround(std::log10(step))));
      return draft_.point(of.name + "_rail", place_(0, ground.point + rounded * ground.axis).at, {}, 2);
    };
    const std::string from = end(low - over), to = end(high + over);
    draft_.part(Part::slider, {corner(j.ends[block].body, local(j.ends[block])), from, to});
  }

  void add_joint(const BodyJoint& j) {
    if (is_on_rail(j)) return add_block(j);
    const BodyEnd& e = j.ends[0];
    const std::string at = corner(e.body, local(e)), far = corner(j.ends[1].body, local(j.ends[1]));
    const bool grounded = e.body == 0 || j.ends[1].body == 0;
    switch (j.kind) {
      case JointKind::parallelogram:
      case JointKind::distance:
      case JointKind::distance_variable:
      case JointKind::universal_rod:
        draft_.part(Part::link, {at, far}, joint(j).name);
        for (const BodyEnd& end : j.ends)
          draft_.part(end.body == 0 ? Part::ground : Part::joint, {corner(end.body, local(end))});
        break;
      case JointKind::prismatic: draft_.part(Part::link, {at, far}); break;
      case JointKind::slot:
        draft_.part(Part::link, {at, far});
        draft_.part(space_ == Space::planar ? Part::joint : Part::ball, {far});
        break;
      case JointKind::spherical: draft_.part(Part::ball, {at}); break;
      case JointKind::revolute:
        if (space_ == Space::spatial) {
          const Motion along = place_(e.body, e.point + e.axis);
          draft_.part(Part::hinge, {at, draft_.point(joint(j).name + "_axis", along.at, {}, 3)});
          break;
        }
        [[fallthrough]];
      default: draft_.part(grounded ? Part::ground : Part::joint, {at});
    }
  }

  Space space_;
  const std::function<Motion(std::size_t, const Vec&)>& place_;
  std::vector<std::vector<Corner>> corners_;  // of each body
  std::vector<std::string> effectors_;
};

}  // namespace

void draw(const Drafter& drafter, Space space, const std::function<Motion(std::size_t, const Vec&)>& place) {
  Portrayal(drafter, space, place).run();
}

}  // namespace corank::kinematics
