// Loops that turn about one point.
#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "corank/kinematics/loops/spanning_tree.h"

namespace corank::kinematics {
namespace {

using Joints = std::vector<std::size_t>;  // in Bodies::joints

// The joints of each set of loops that share joints: a spanning tree's ways around its chords, joined where they overlap.
std::vector<Joints> blocks(const Robot& robot, const Bodies& bodies, const Algebra& algebra) {
  const std::size_t n = bodies.joints.size();
  const SpanningTree tree = spanning_tree(robot, bodies, algebra, std::vector<int>(n, 0));
  std::vector<Joints> way(bodies.size());  // from the ground to each body
  for (const TreeEdge& edge : tree.edges) {
    const auto& ends = bodies.joints[edge.joint].ends;
    Joints& child = way[ends[1 - edge.from].body];
    child = way[ends[edge.from].body];
    child.push_back(edge.joint);
  }
  std::vector<std::size_t> block(n);
  std::iota(block.begin(), block.end(), 0);
  for (const std::size_t chord : tree.chords) {
    const auto& ends = bodies.joints[chord].ends;
    const Joints &a = way[ends[0].body], &b = way[ends[1].body];
    const auto fork = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    Joints loop(fork.first, a.end());
    loop.insert(loop.end(), fork.second, b.end());
    for (const std::size_t j : loop) {
      const std::size_t old = block[j];
      std::ranges::replace(block, old, block[chord]);
    }
  }
  std::map<std::size_t, Joints> sorted;
  for (std::size_t j = 0; j < n; ++j) sorted[block[j]].push_back(j);
  std::vector<Joints> list;
  for (const auto& [number, joints] : sorted)
    if (joints.size() > 1) list.push_back(joints);  // a joint of its own is in no loop
  return list;
}

class Block {
 public:
  Block(const Bodies& bodies, const Joints& joints, const Algebra& algebra)
      : bodies_(bodies), joints_(joints), algebra_(algebra), centre_(bodies.size()) {}

  /// The point about which all turns, in each body's frame; false where there is none.
  bool find_centres() {
    const bool all_turn =
        std::ranges::all_of(joints_, [&](std::size_t j) { return turns_about_point(bodies_.joints[j].kind); });
    return all_turn && start() && spread();
  }
  const Vec& centre(std::size_t body) const { return *centre_[body]; }
  bool is_at_centre(const BodyEnd& end) const { return is_zero(end.point - centre(end.body)); }

 private:
  /// In the one body where it can be told: a joint's point that cannot be moved, or where two of a body's axes meet. Where
  /// each body's axes are parallel, any point of one does if all lie on one line.
  bool start() {
    std::map<std::size_t, std::vector<const BodyEnd*>> ends;
    for (const std::size_t j : joints_)
      for (const BodyEnd& end : bodies_.joints[j].ends) {
        if (bodies_.joints[j].kind != JointKind::revolute) {
          centre_[end.body] = end.point;
          first_ = end.body;
          return true;
        }
        ends[end.body].push_back(&end);
      }
    for (const auto& [body, list] : ends)
      for (const BodyEnd* other : list) {
        if (algebra_.are_parallel(list.front()->axis, other->axis)) continue;
        first_ = body;
        centre_[body] = meeting_point(*list.front(), *other);
        return centre_[body].has_value();
      }
    first_ = ends.begin()->first;
    centre_[first_] = ends.begin()->second.front()->point;
    return true;
  }

  std::optional<Vec> meeting_point(const BodyEnd& a, const BodyEnd& b) const {
    const Vec normal = cross(a.axis, b.axis), way = b.point - a.point;
    if (!is_zero(dot(way, normal))) return std::nullopt;
    const ex along = algebra_.clean(dot(cross(way, b.axis), normal)) / algebra_.clean(dot(normal, normal));
    return algebra_.clean(a.point + along * a.axis);
  }

  /// From body to body. Whether all joints agree.
  bool spread() {
    bool agree = true;
    walk(bodies_, joints_, first_, [&](std::size_t j, const BodyEnd& near, const BodyEnd& far) {
      if (!agree) return false;
      const Vec away = *centre_[near.body] - near.point;
      const ex along = dot(away, near.axis);  // 0 · away for joints without axis
      const bool can_move = bodies_.joints[j].kind == JointKind::revolute;
      agree = is_zero(can_move ? away - along * near.axis : away);
      if (!agree) return false;
      const Vec there = can_move ? algebra_.clean(far.point + along * far.axis) : far.point;
      const bool is_new = !centre_[far.body];
      if (is_new) centre_[far.body] = there;
      agree = is_new || is_zero(there - *centre_[far.body]);
      return is_new;
    });
    return agree;
  }

  bool is_zero(const ex& e) const { return algebra_.is_zero(algebra_.clean(e)); }
  bool is_zero(const Vec& v) const { return is_zero(v[0]) && is_zero(v[1]) && is_zero(v[2]); }

  const Bodies& bodies_;
  const Joints& joints_;
  const Algebra& algebra_;
  std::vector<std::optional<Vec>> centre_;
  std::size_t first_ = 0;
};

}  // namespace

Bodies about_centres(const Robot& robot, const Bodies& bodies, Algebra& algebra) {
  std::vector<ex> known;
  const auto short_form = [&](const ex& e) {
    const auto same = std::ranges::find_if(known, [&](const ex& k) { return algebra.is_zero(k - e); });
    return same != known.end() ? *same : known.emplace_back(algebra.named(e));
  };
  Bodies moved = bodies;
  for (const Joints& joints : blocks(robot, bodies, algebra)) {
    Block block(bodies, joints, algebra);
    if (!block.find_centres()) continue;
    for (const std::size_t j : joints)
      for (BodyEnd& end : moved.joints[j].ends)
        if (!block.is_at_centre(end)) {
          const Vec& c = block.centre(end.body);
          end.point = {short_form(c[0]), short_form(c[1]), short_form(c[2])};
        }
  }
  return moved;
}

}  // namespace corank::kinematics
