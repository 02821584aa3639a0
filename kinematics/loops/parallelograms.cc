#include "corank/kinematics/loops/parallelograms.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>

namespace corank::kinematics {
namespace {

constexpr double kMayBeEqual = 1e-9;     // relative: what is further apart needs no exact comparison
constexpr std::size_t kMostSides = 400;  // of one direction: loops are looked for among pairs of them

/// What turns about axes of one direction: bodies, their hinges, and what keeps two hinges at a distance.
class ParallelAxes {
 public:
  ParallelAxes(const Robot& robot, const Bodies& bodies, const Algebra& algebra, std::size_t seed)
      : robot_(robot), bodies_(bodies), algebra_(algebra) {
    reach(seed);
    for (std::size_t j = 0; j < bodies.joints.size(); ++j) {
      const BodyJoint& joint = bodies.joints[j];
      if (!is_ours(joint)) continue;
      const std::size_t a = mark(joint.ends[0]), b = mark(joint.ends[1]);
      if (joint.kind == JointKind::revolute) {
        join(a, b);
      } else {
        rods_.push_back({j, a, b});
      }
    }
    for (std::size_t a = 0; a < marks_.size(); ++a)
      for (std::size_t b = a + 1; b < marks_.size(); ++b)
        if (marks_[a].body == marks_[b].body && algebra_.is_zero(across(a, b))) join(a, b);
    add_sides();
  }

  /// Is the joint one of this direction?
  bool is_ours(const BodyJoint& j) const {
    const bool here = has(j.ends[0].body) && has(j.ends[1].body);
    if (j.kind == JointKind::distance) return here;
    return j.kind == JointKind::revolute && here && algebra_.are_parallel(normals_.at(j.ends[0].body), j.ends[0].axis);
  }

  std::vector<Parallelogram> parallelograms() const {
    std::vector<Parallelogram> found;
    if (sides_.size() > kMostSides) return found;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> between;  // two hinges: sides
    for (std::size_t s = 0; s < sides_.size(); ++s) between[{sides_[s].from, sides_[s].to}].push_back(s);
    const auto sides_between = [&](std::size_t p, std::size_t q) {
      const auto at = between.find(std::minmax(p, q));
      return at == between.end() ? std::vector<std::size_t>{} : at->second;
    };
    std::set<std::set<std::size_t>> seen;  // by their four sides
    for (std::size_t a = 0; a < sides_.size(); ++a)
      for (std::size_t c = a + 1; c < sides_.size(); ++c) {
        if (sides_[a].carrier == sides_[c].carrier || !same_length(a, c)) continue;
        const std::size_t p1 = sides_[a].from, p2 = sides_[a].to;
        for (const bool turned : {false, true}) {
          const std::size_t p4 = turned ? sides_[c].to : sides_[c].from, p3 = turned ? sides_[c].from : sides_[c].to;
          if (p1 == p4 || p1 == p3 || p2 == p3 || p2 == p4) continue;
          for (const std::size_t b : sides_between(p2, p3))
            for (const std::size_t d : sides_between(p1, p4)) {
              const std::set<std::size_t> carriers{sides_[a].carrier, sides_[b].carrier, sides_[c].carrier,
                                                   sides_[d].carrier};
              if (carriers.size() < 4 || !same_length(b, d) || !seen.insert({a, b, c, d}).second) continue;
              Parallelogram one{{name(a), name(b), name(c), name(d)},
                                {way(a, p1, p2), way(b, p2, p3), way(c, p4, p3), way(d, p1, p4)},
                                {sides_[a].square - sides_[c].square, sides_[b].square - sides_[d].square},
                                {}};
              keep(one, a, p1, p2, c, p4, p3);
              keep(one, b, p2, p3, d, p1, p4);
              if (!one.opposite.empty()) found.push_back(std::move(one));
            }
        }
      }
    return found;
  }

 private:
  struct Mark {
    std::size_t body;
    Vec point;
  };
  struct Rod {
    std::size_t joint, from, to;  ///< marks
  };
  /// Two hinges at a constant distance.
  struct Side {
    std::size_t carrier;   ///< a body; or, from bodies.size() on, a rod
    std::size_t from, to;  ///< hinges, from < to
    ex square;             ///< of its length
    double value;
  };

  // All bodies that revolute joints about the direction connect, with its unit vector and their heights along it.
  void reach(std::size_t seed) {
    const BodyEnd& first = bodies_.joints[seed].ends[0];
    normals_[first.body] = first.axis;
    heights_[first.body] = 0;
    std::vector<std::size_t> hinges;
    for (std::size_t j = 0; j < bodies_.joints.size(); ++j)
      if (bodies_.joints[j].kind == JointKind::revolute) hinges.push_back(j);
    walk(bodies_, hinges, first.body, [&](std::size_t, const BodyEnd& near, const BodyEnd& far) {
      if (normals_.contains(far.body)) return false;
      const auto normal = carried_over(normals_.at(near.body), near, far, algebra_);
      if (!normal) return false;
      normals_[far.body] = *normal;
      heights_[far.body] =
          algebra_.clean(dot(normals_.at(near.body), near.point) + heights_.at(near.body) - dot(*normal, far.point));
      return true;
    });
  }

  bool has(std::size_t body) const { return normals_.contains(body); }

  std::size_t mark(const BodyEnd& end) {
    marks_.push_back({end.body, end.point});
    hinge_.push_back(hinge_.size());
    return marks_.size() - 1;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t old = hinge_[b], now = hinge_[a];
    std::ranges::replace(hinge_, old, now);
  }

  // From mark a to mark b of one body, across the axes.
  Vec across(std::size_t a, std::size_t b) const {
    const Vec way = marks_[b].point - marks_[a].point;
    const Vec& n = normals_.at(marks_[a].body);
    return algebra_.clean(way - dot(way, n) * n);
  }

  void add_sides() {
    const auto add = [&](std::size_t carrier, std::size_t a, std::size_t b, const ex& square) {
      const std::size_t p = hinge_[a], q = hinge_[b];
      const auto [from, to] = std::minmax(p, q);
      const bool known = std::ranges::any_of(
          sides_, [&, from = from, to = to](const Side& s) { return s.carrier == carrier && s.from == from && s.to == to; });
      if (p != q && !known) sides_.push_back({carrier, from, to, square, algebra_.value(square)});
    };
    for (std::size_t a = 0; a < marks_.size(); ++a)
      for (std::size_t b = a + 1; b < marks_.size(); ++b)
        if (marks_[a].body == marks_[b].body) {
          const Vec way = across(a, b);
          add(marks_[a].body, a, b, algebra_.clean(dot(way, way)));
        }
    for (const Rod& rod : rods_) {
      const Joint& joint = robot_.joints[bodies_.joints[rod.joint].index];
      const auto height = [&](std::size_t m) {
        return dot(normals_.at(marks_[m].body), marks_[m].point) + heights_.at(marks_[m].body);
      };
      const ex length = algebra_.constant(joint.length, joint.where), rise = height(rod.to) - height(rod.from);
      add(bodies_.size() + rod.joint, rod.from, rod.to, algebra_.clean(length * length - rise * rise));
    }
  }

  bool same_length(std::size_t a, std::size_t b) const {
    const Side &s = sides_[a], &t = sides_[b];
    const bool may_be = std::abs(s.value - t.value) <= kMayBeEqual * std::max(s.value, t.value);
    // The algebra notes what equations depend on; those of robots that keep their parallelograms do on all such pairs.
    return (may_be || robot_.keeps_parallelograms) && algebra_.is_zero(algebra_.clean(s.square - t.square));
  }

  std::string name(std::size_t side) const {
    const std::size_t carrier = sides_[side].carrier;
    if (carrier >= bodies_.size()) return robot_.joints[bodies_.joints[carrier - bodies_.size()].index].name;
    return robot_.links[bodies_.link_of(carrier)].name;
  }

  std::size_t mark_at(std::size_t body, std::size_t hinge) const {
    std::size_t m = 0;
    while (marks_[m].body != body || hinge_[m] != hinge) ++m;
    return m;
  }
  SideWay way(std::size_t side, std::size_t p, std::size_t q) const {
    const std::size_t carrier = sides_[side].carrier;
    if (carrier >= bodies_.size()) return {{}, carrier - bodies_.size(), {}};
    return {carrier, {}, across(mark_at(carrier, p), mark_at(carrier, q))};
  }

  // The unit vector from hinge p to hinge q in a body's frame, the axes' direction and their cross product, as rows.
  Mat frame(std::size_t body, std::size_t p, std::size_t q) const {
    const Vec along = algebra_.unit(across(mark_at(body, p), mark_at(body, q))), &n = normals_.at(body);
    return {n, along, algebra_.clean(cross(n, along))};
  }

  // Sides a, from p to q, and c, from r to s, point the same way.
  void keep(Parallelogram& one, std::size_t a, std::size_t p, std::size_t q, std::size_t c, std::size_t r,
            std::size_t s) const {
    const std::size_t first = sides_[a].carrier, second = sides_[c].carrier;
    if (first >= bodies_.size() || second >= bodies_.size()) return;
    const std::size_t i = bodies_.link_of(first), k = bodies_.link_of(second);
    const Mat bodies = transpose(frame(first, p, q)) * frame(second, r, s);
    Mat links = transpose(bodies_.placement[i].rotation) * bodies * bodies_.placement[k].rotation;
    for (Vec& row : links) row = algebra_.clean(row);
    one.opposite.push_back({i, k, links});
  }

  const Robot& robot_;
  const Bodies& bodies_;
  const Algebra& algebra_;
  std::map<std::size_t, Vec> normals_;
  std::map<std::size_t, ex> heights_;
  std::vector<Mark> marks_;
  std::vector<std::size_t> hinge_;  // of each mark
  std::vector<Rod> rods_;
  std::vector<Side> sides_;
};

}  // namespace

std::vector<Parallelogram> parallelograms_of(const Robot& robot, const Bodies& bodies, const Algebra& algebra) {
  std::vector<Parallelogram> found;
  std::deque<ParallelAxes> directions;
  for (std::size_t seed = 0; seed < bodies.joints.size(); ++seed) {
    const BodyJoint& joint = bodies.joints[seed];
    if (joint.kind != JointKind::revolute ||
        std::ranges::any_of(directions, [&](const ParallelAxes& d) { return d.is_ours(joint); }))
      continue;
    for (Parallelogram& one : directions.emplace_back(robot, bodies, algebra, seed).parallelograms())
      found.push_back(std::move(one));
  }
  return found;
}

}  // namespace corank::kinematics
