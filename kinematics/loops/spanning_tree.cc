#include "corank/kinematics/loops/spanning_tree.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <deque>
#include <limits>
#include <optional>

#include "corank/core/check.h"

namespace corank::kinematics {
namespace {

/// Neither driven nor asked for.
bool is_passive_revolute(const Robot& robot, const BodyJoint& j) {
  return j.kind == JointKind::revolute && !robot.is_asked_for(j.index);
}

}  // namespace

SpanningTree spanning_tree(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const std::vector<int>& order,
                           bool deep) {
  const std::size_t n = bodies.joints.size();
  std::vector<bool> in_forest(n, false), reached(bodies.size(), false);
  boost::disjoint_sets_with_storage<> forest(bodies.size());
  const int last = n == 0 ? 0 : *std::ranges::max_element(order);
  for (int turn = 1; turn <= last; ++turn)
    for (std::size_t j = 0; j < n; ++j)
      if (order[j] == turn) {
        const std::size_t a = bodies.joints[j].ends[0].body, b = bodies.joints[j].ends[1].body;
        in_forest[j] = forest.find_set(a) != forest.find_set(b);
        forest.union_set(a, b);
      }

  SpanningTree tree;
  std::vector<bool> used(n, false);
  std::deque<std::size_t> waiting;
  const auto take = [&](std::size_t j, std::size_t from) {
    used[j] = true;
    tree.edges.push_back({j, from});
    const std::size_t body = bodies.joints[j].ends[1 - from].body;
    reached[body] = true;
    waiting.push_back(body);
  };
  std::vector<std::vector<std::size_t>> joints_of(bodies.size());
  for (std::size_t j = 0; j < n; ++j)
    for (const BodyEnd& end : bodies.joints[j].ends) joints_of[end.body].push_back(j);
  // All that hang on a body by joints of one sort, or the first one.
  const auto extend = [&](std::size_t body, bool one, auto&& wanted) {
    for (const std::size_t j : joints_of[body]) {
      const auto& ends = bodies.joints[j].ends;
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
        if (!used[j] && ends[side].body == body && !reached[ends[1 - side].body] && wanted(j)) {
          take(j, side);
          if (one) return true;
        }
    }
    return false;
  };
  reached[0] = true;
  waiting.push_back(0);
  for (;;) {
    while (!waiting.empty()) {
      // What the forest carries comes along at once, so that no shorter way takes it elsewhere.
      std::deque<std::size_t> whole{deep ? waiting.back() : waiting.front()};
      deep ? waiting.pop_back() : waiting.pop_front();
      std::vector<std::size_t> together;
      while (!whole.empty()) {
        const std::size_t body = whole.front();
        whole.pop_front();
        together.push_back(body);
        const std::size_t before = waiting.size();
        extend(body, false, [&](std::size_t j) { return in_forest[j]; });
        for (std::size_t i = before; i < waiting.size(); ++i) whole.push_back(waiting[i]);
        waiting.resize(before);
      }
      const auto any = [&](std::size_t j) { return order[j] == 0 && !is_rod(bodies.joints[j].kind); };
      if (!deep) {
        for (const std::size_t body : together) extend(body, false, any);
      } else if (std::ranges::any_of(together, [&](std::size_t body) { return extend(body, true, any); })) {
        waiting.insert(waiting.end() - 1, together.begin(), together.end());  // for later: the new body comes next
      }
    }
    std::optional<TreeEdge> shortest;
    double length = 0;
    for (std::size_t j = 0; j < n; ++j)
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const BodyJoint& rod = bodies.joints[j];
        if (used[j] || !is_rod(rod.kind) || !reached[rod.ends[side].body] || reached[rod.ends[1 - side].body]) continue;
        const Joint& of = robot.joints[rod.index];
        const double own = rod.kind == JointKind::distance ? algebra.value(algebra.constant(of.length, of.where))
                                                           : std::numeric_limits<double>::infinity();
        if (shortest && !(own < length)) continue;
        shortest = TreeEdge{j, side};
        length = own;
      }
    if (shortest) take(shortest->joint, shortest->from);
    if (waiting.empty()) break;
  }
  CORANK_CHECK(std::ranges::find(reached, false) == reached.end());  // else Robot::validate() refuses the robot
  for (std::size_t j = 0; j < n; ++j)
    if (!used[j]) tree.chords.push_back(j);
  return tree;
}

std::vector<Dyad> dyads_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra, const SpanningTree& tree,
                           bool reached) {
  std::vector<Dyad> list;
  std::vector<bool> taken(bodies.joints.size(), false);  // each joint is in one dyad
  for (const TreeEdge& edge : tree.edges) {
    const std::size_t link = bodies.joints[edge.joint].ends[1 - edge.from].body;
    std::vector<std::size_t> others;
    for (std::size_t j = 0; j < bodies.joints.size(); ++j)
      if (j != edge.joint && (bodies.joints[j].ends[0].body == link || bodies.joints[j].ends[1].body == link))
        others.push_back(j);
    if (others.size() != 1 || bodies.has_output(robot, link)) continue;
    const std::size_t outer = others[0];
    if (taken[edge.joint] || taken[outer]) continue;
    if (!is_passive_revolute(robot, bodies.joints[edge.joint]) || !is_passive_revolute(robot, bodies.joints[outer]))
      continue;
    const bool closes = std::ranges::find(tree.chords, outer) != tree.chords.end();
    if (!closes && !reached) continue;
    const BodyJoint &inner = bodies.joints[edge.joint], &next = bodies.joints[outer];
    const std::size_t near = next.ends[0].body == link ? 0 : 1;
    const BodyEnd &a = inner.ends[1 - edge.from], &b = next.ends[near];
    if (algebra.are_parallel(a.axis, b.axis) || !algebra.is_zero(algebra.clean(b.point - a.point))) continue;
    taken[edge.joint] = taken[outer] = true;
    list.push_back({link, edge, outer, inner.ends[edge.from].body, next.ends[1 - near].body});
  }
  return list;
}

}  // namespace corank::kinematics
