#include "corank/kinematics/loops/plane_loops.h"

#include <algorithm>
#include <numeric>

namespace corank::kinematics {
namespace {

bool turns(JointKind kind) { return kind == JointKind::revolute || kind == JointKind::parallelogram; }

using Joints = std::vector<std::size_t>;  // in Bodies::joints

/// All joints about one direction, or across it, that hang together.
class Direction {
 public:
  Direction(const Bodies& bodies, const Algebra& algebra, std::size_t seed) : bodies_(bodies), algebra_(algebra) {
    const BodyEnd& end = bodies.joints[seed].ends[0];
    normals[bodies.group[end.body]] = end.axis;
    std::vector<bool> taken(bodies.joints.size(), false);
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t j = 0; j < taken.size(); ++j)
        if (!taken[j] && take(bodies.joints[j])) {
          taken[j] = grew = true;
          joints.push_back(j);
        }
    }
    // A rod between bodies that move in the plane, or parallel to it, is one of the plane, unless it asks for more than a
    // length.
    for (std::size_t j = 0; j < taken.size(); ++j) {
      const auto& [index, kind, ends] = bodies.joints[j];
      if (is_rod(kind) && kind != JointKind::universal_rod && normals.contains(bodies.group[ends[0].body]) &&
          normals.contains(bodies.group[ends[1].body]))
        joints.push_back(j);
    }
  }

  Joints joints;
  std::map<std::size_t, Vec> normals;  // of each group, in its frame

 private:
  bool take(const BodyJoint& j) {
    const std::size_t g0 = bodies_.group[j.ends[0].body], g1 = bodies_.group[j.ends[1].body];
    const auto n0 = normals.find(g0), n1 = normals.find(g1);
    if (n0 == normals.end() && n1 == normals.end()) return false;
    if (j.kind == JointKind::prismatic) return algebra_.is_zero(algebra_.clean(dot(normals.at(g0), j.ends[0].axis)));
    if (!turns(j.kind)) return false;
    const std::size_t near = n0 != normals.end() ? 0 : 1;
    const auto other = carried_over(near == 0 ? n0->second : n1->second, j.ends[near], j.ends[1 - near], algebra_);
    if (!other) return false;
    const auto [far, is_new] = normals.emplace(near == 0 ? g1 : g0, *other);
    return is_new ||
           (algebra_.are_parallel(far->second, *other) && algebra_.sign(algebra_.clean(dot(far->second, *other))) > 0);
  }

  const Bodies& bodies_;
  const Algebra& algebra_;
};

/// Of these joints those in loops, in sets that share bodies.
std::vector<Joints> loops_of(const Bodies& bodies, const Joints& joints) {
  std::vector<std::optional<Joints>> way(bodies.size());  // from a first body to each other
  std::vector<bool> in_tree(bodies.joints.size(), false);
  for (const std::size_t start : joints) {
    if (way[bodies.joints[start].ends[0].body]) continue;
    const std::size_t first = bodies.joints[start].ends[0].body;
    way[first] = Joints{};
    walk(bodies, joints, first, [&](std::size_t j, const BodyEnd& near, const BodyEnd& far) {
      if (way[far.body]) return false;
      way[far.body] = way[near.body];
      way[far.body]->push_back(j);
      in_tree[j] = true;
      return true;
    });
  }
  std::vector<bool> in_loop(bodies.joints.size(), false);
  for (const std::size_t chord : joints) {
    if (in_tree[chord]) continue;
    const auto& ends = bodies.joints[chord].ends;
    const Joints &a = *way[ends[0].body], &b = *way[ends[1].body];
    const auto fork = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    in_loop[chord] = true;
    std::for_each(fork.first, a.end(), [&](std::size_t j) { in_loop[j] = true; });
    std::for_each(fork.second, b.end(), [&](std::size_t j) { in_loop[j] = true; });
  }
  std::vector<std::size_t> set_of(bodies.size());
  std::iota(set_of.begin(), set_of.end(), std::size_t{0});
  for (const std::size_t j : joints) {
    if (!in_loop[j]) continue;
    const auto& ends = bodies.joints[j].ends;
    const std::size_t old = set_of[ends[1].body], now = set_of[ends[0].body];
    std::ranges::replace(set_of, old, now);
  }
  std::map<std::size_t, Joints> sets;
  for (const std::size_t j : joints)
    if (in_loop[j]) sets[set_of[bodies.joints[j].ends[0].body]].push_back(j);
  std::vector<Joints> list;
  for (auto& [number, set] : sets) list.push_back(std::move(set));
  return list;
}

}  // namespace

PlaneLoops::PlaneLoops(const Bodies& bodies, const Algebra& algebra) : bodies_(bodies), part_of_(bodies.joints.size()) {
  for (std::size_t seed = 0; seed < bodies.joints.size(); ++seed) {
    if (has(seed) || bodies.joints[seed].kind != JointKind::revolute) continue;
    const Direction direction(bodies, algebra, seed);
    for (const Joints& joints : loops_of(bodies, direction.joints)) {
      if (std::ranges::any_of(joints, [&](std::size_t j) { return has(j); })) continue;
      PlanePart part{{bodies, algebra}};
      for (const std::size_t j : joints) {
        part_of_[j] = parts_.size();
        for (const BodyEnd& end : bodies.joints[j].ends) {
          const std::size_t g = bodies.group[end.body];
          part.basis.emplace(g, basis_of(direction.normals.at(g), algebra));
        }
      }
      parts_.push_back(std::move(part));
    }
  }
}

PlanePart* PlaneLoops::closing(std::size_t joint) {
  PlanePart* const part = of(joint);
  if (part == nullptr) return nullptr;
  for (const BodyEnd& end : bodies_.joints[joint].ends)
    if (!part->reached.contains(end.body) || !part->turns.contains(bodies_.group[end.body])) return nullptr;
  return part;
}

}  // namespace corank::kinematics
