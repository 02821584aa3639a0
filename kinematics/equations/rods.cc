#include "corank/kinematics/equations/rods.h"

#include <algorithm>
#include <map>
#include <set>

namespace corank::kinematics {
namespace {

const GiNaC::numeric kHalf(1, 2);

}  // namespace

Rods::Rods(const Drafter& drafter, const PlaneLoops& loops, Positions& positions)
    : Drafter(drafter), positions_(positions), other_(bodies_.joints.size()), said_(bodies_.joints.size(), false) {
  std::vector<std::size_t> held;  // joints that are looked at in one position
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> between;  // two bodies
  for (std::size_t j = 0; j < bodies_.joints.size(); ++j) {
    const auto& [index, kind, ends] = bodies_.joints[j];
    if (moves_one_way(kind) && is_held(joint(j))) held.push_back(j);
    if (is_rod(kind) && !loops.has(j)) between[std::minmax(ends[0].body, ends[1].body)].push_back(j);
  }
  std::set<std::size_t> at_rest{0};
  walk(bodies_, held, 0, [&](std::size_t, const BodyEnd&, const BodyEnd& far) { return at_rest.insert(far.body).second; });
  const auto is_fixed = [&](std::size_t j) { return bodies_.joints[j].kind == JointKind::distance; };
  for (const auto& [two, rods] : between)
    if (rods.size() == 2 && std::ranges::all_of(rods, is_fixed) && !at_rest.contains(two.first) &&
        !at_rest.contains(two.second)) {
      other_[rods[0]] = rods[1];
      other_[rods[1]] = rods[0];
    }
}

bool Rods::has_two() const {
  return std::ranges::any_of(other_, [](const auto& other) { return other.has_value(); });
}

bool Rods::is_held(const Joint& of) const {
  if (!of.range()) return false;
  const auto value = [&](const Expression& e) { return algebra_.value(algebra_.constant(e, of.where)); };
  return value(of.ranges[0]->lower) == value(of.ranges[0]->upper);
}

ex Rods::length(const BodyJoint& rod) {
  const Joint& of = joint(rod);
  if (rod.kind == JointKind::distance) return algebra_.constant(of.length, of.where);
  return *(positions_.coordinates[rod.index] = draft_.joint_way(rod.index, of.name).value());
}

Rods::Leg Rods::leg_of(std::size_t joint) {
  const BodyJoint& first = bodies_.joints[joint];
  Leg leg{joint, other_[joint], first.ends, length(first)};
  if (!leg.second) return leg;
  const auto& second = bodies_.joints[*leg.second].ends;
  const std::size_t same = second[0].body == leg.ends[0].body ? 0 : 1;
  std::array<Vec, 2> apart, image;
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    const Vec &one = leg.ends[end].point, &two = second[end == 0 ? same : 1 - same].point;
    apart[end] = algebra_.clean(kHalf * (one - two));
    image[end] = positions_.image(leg.ends[end].body, apart[end]);
    leg.ends[end].point = algebra_.clean(kHalf * (one + two));
  }
  leg.delta = algebra_.clean(image[1] - image[0]);
  leg.delta_squared = dot(apart[0], apart[0]) + dot(apart[1], apart[1]) - 2 * dot(image[0], image[1]);
  return leg;
}

// A component is no longer than the rod, and half a sum than half the lengths'; the range is a little wider, so that the set
// reaches no end of it.
std::optional<Range> Rods::range(const Leg& leg) const {
  const Expression wider("11/10");
  const Joint& of = joint(leg.first);
  if (bodies_.joints[leg.first].kind != JointKind::distance) {
    if (!of.range()) return std::nullopt;
    return Range{-(wider * of.ranges[0]->upper), wider * of.ranges[0]->upper};
  }
  const Expression longest = wider * (leg.second ? (of.length + joint(*leg.second).length) / 2 : of.length);
  return Range{-longest, longest};
}

Vec Rods::vector(const Leg& leg, bool auxiliary) {
  const Joint& of = joint(leg.first);
  Vec p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = draft_.length("P_" + of.name + "_" + "xyz"[i], range(leg), of.where, auxiliary);
  return p;
}

ex Rods::keep_length(const Leg& leg, const Vec& p) {
  const Joint& of = joint(leg.first);
  ex square =
      is_extensible(bodies_.joints[leg.first].kind) ? ex(leg.length * leg.length) : algebra_.clean(leg.length * leg.length);
  if (leg.second) {
    said_[*leg.second] = true;
    const ex other = length(bodies_.joints[*leg.second]), other_square = algebra_.clean(other * other);
    draft_.equation(4 * dot(p, leg.delta) - algebra_.clean(square - other_square), "two rods", joint(*leg.second).where,
                    "the rods '" + of.name + "' and '" + joint(*leg.second).name + "'");
    square = algebra_.clean(kHalf * (square + other_square)) - leg.delta_squared;
  }
  draft_.equation(dot(p, p) - square, "rod", of.where, "the rod '" + of.name + "'");
  return square;
}

Vec Rods::hang(const TreeEdge& edge) {
  const Leg leg = leg_of(edge.joint);
  const std::size_t far = 1 - edge.from;
  const Vec p = vector(leg, false);
  const ex sense = far == 1 ? 1 : -1;  // of p, from end 0 to end 1
  const ex square = keep_length(leg, sense * p);
  keep_in_plane(leg, p);
  hung_.push_back({leg, far, p, square});
  return leg.second ? algebra_.clean(p + sense * leg.delta) : p;
}

// |p + R b − a|² = |p|² + |b|² + |a|² + 2 p·R b − 2 p·a − 2 a·R b, where |p|² is known and q = Rᵀp are coordinates: so the
// difference of two legs' equations is linear in them.
ex Rods::squared_distance(Hung& hung, const Vec& b, const Vec& a) {
  const std::size_t g = group(hung.leg.ends[hung.far].body);
  const Vec c = positions_.frames.coefficients(g, b);
  ex along = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (algebra_.is_zero(c[i])) continue;
    if (!hung.seen[i]) {
      const Joint& of = joint(hung.leg.first);
      const ex q = draft_.length("q_" + of.name + "_" + std::to_string(i + 1), range(hung.leg), of.where, true);
      draft_.equation(q - dot(hung.p, positions_.frames.direction(g, i)), "q", of.where);
      hung.seen[i] = q;
    }
    along += c[i] * *hung.seen[i];
  }
  return hung.square + dot(b, b) + dot(a, a) + 2 * along - 2 * dot(hung.p, a) - 2 * dot(a, positions_.frames.image(g, b));
}

// The axes at a leg's universal joints and the leg, along p, are perpendicular to its inner axes: det(a, p, b) = 0.
void Rods::keep_in_plane(const Leg& leg, const Vec& p) {
  if (bodies_.joints[leg.first].kind != JointKind::universal_rod) return;
  const auto axis = [&](std::size_t end) { return positions_.image(leg.ends[end].body, leg.ends[end].axis); };
  draft_.equation(dot(p, cross(axis(1), axis(0))), "universal joints", joint(leg.first).where,
                  "the leg '" + joint(leg.first).name + "'");
}

void Rods::close(std::size_t j) {
  if (said_[j]) return;
  const Joint& of = joint(j);
  const std::string what = "the rod '" + of.name + "'";
  const Leg leg = leg_of(j);
  // First of all, for every rod: the places of its ends may make coordinates.
  const Vec p = algebra_.clean(positions_.place(leg.ends[1]) - positions_.place(leg.ends[0]));
  keep_in_plane(leg, p);
  if (leg.second) {
    const Vec own = vector(leg, true);
    for (std::size_t i = 0; i < 3; ++i) draft_.equation(own[i] - p[i], "two rods", of.where, what);
    keep_length(leg, own);
    return;
  }
  for (Hung& hung : hung_)
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      if (leg.ends[end].body != hung.leg.ends[hung.far].body) continue;
      const Vec b = algebra_.clean(leg.ends[end].point - hung.leg.ends[hung.far].point);
      const Vec a = algebra_.clean(positions_.place(leg.ends[1 - end]) - positions_.place(hung.leg.ends[1 - hung.far]));
      if (depends_on(a, hung)) continue;
      draft_.equation(squared_distance(hung, b, a) - leg.length * leg.length, "rod", of.where, what);
      return;
    }
  keep_length(leg, p);
}

// Does a hang on the same rod?
bool Rods::depends_on(const Vec& a, const Hung& hung) const {
  for (const ex& component : a)
    for (const ex& p : hung.p)
      if (component.has(p)) return true;
  return false;
}

}  // namespace corank::kinematics
