#include "corank/kinematics/loops/loop_branches.h"

#include <algorithm>

#include "corank/core/check.h"

namespace corank::kinematics {
namespace {

using Branch = LoopBranches::Branch;

using Sides = BranchFinder::Sides;

PlanePoint point(const Turn& side) {
  PlanePoint p;
  p.add({{1, 0}, side.angle}, side.k);
  return p;
}

/// x ȳ / scale.
Turn ratio(const Turn& x, const Turn& y, const ex& scale) {
  const Turn product = x * inverse(y);
  return {{product.k.re / scale, product.k.im / scale}, product.angle};
}
Turn opposite(const Turn& x) { return {{-x.k.re, -x.k.im}, x.angle}; }

ex square(const Turn& side) { return side.k.re * side.k.re + side.k.im * side.k.im; }

/// Pairs of sides of one length point the same way.
void same_way(const Turn& x, const Turn& y, const ex& square, Branch& branch) {
  const Turn both = ratio(x, y, square);
  branch.zero.push_back(both.sine());
  branch.not_negative.push_back(both.cosine());
}

/// Crosswise, a ≠ b. `a_is_longer`: a > b. Sides A, B, D are known, C where it is no rod.
Branch crosswise(const Sides& sides, const ex& a2, const ex& b2, bool a_is_longer) {
  const Turn &a = *sides[0], &b = *sides[1], &d = *sides[3];
  if (sides[2] && a_is_longer) return crosswise({sides[1], sides[0], sides[3], sides[2]}, b2, a2, false);
  Branch branch;
  if (sides[2]) {
    same_way(a * *sides[2], b * d, a2 * b2, branch);
  } else if (a_is_longer) {
    const Turn squared = ratio(a * a, b * d, a2 * b2);  // e^{2iν}
    branch.zero.push_back(squared.sine() - ratio(a, b, a2).sine() + ratio(a, d, a2).sine());
    branch.not_negative.push_back(squared.cosine() + b2 / a2);
    return branch;
  }
  branch.zero.push_back(ratio(a, b, b2).sine() + ratio(a, d, b2).sine() - ratio(d, b, b2).sine());
  branch.not_negative.push_back(ratio(d, b, b2).cosine() + a2 / b2);
  return branch;
}

/// The sides that a rod is not among, as A, B, D: exchanging A with C and B with D, or the pairs, leaves a loop's equation.
Sides rod_as_third(const Sides& sides, std::size_t rod) {
  switch (rod) {
    case 0: return {sides[2], sides[3], std::nullopt, sides[1]};
    case 1: return {sides[3], sides[2], std::nullopt, sides[0]};
    case 3: return {sides[1], sides[0], std::nullopt, sides[2]};
    default: return sides;
  }
}

std::vector<Branch> list_of(const Sides& sides, const Algebra& algebra) {
  const ex a2 = algebra.clean(square(*sides[0])), b2 = algebra.clean(square(*sides[1]));
  const Turn &a = *sides[0], &b = *sides[1], &d = *sides[3];
  std::vector<Branch> list(1);
  if (sides[2]) same_way(*sides[2], a, a2, list[0]);
  same_way(d, b, b2, list[0]);
  const int longer = algebra.sign(algebra.clean(a2 - b2));
  if (longer != 0) {
    list.push_back(crosswise(sides, a2, b2, longer > 0));
    return list;
  }
  Branch upon, across;
  if (sides[2]) same_way(b, *sides[2], a2, upon);
  same_way(d, a, a2, upon);
  same_way(b, opposite(a), a2, across);
  if (sides[2]) same_way(d, opposite(*sides[2]), a2, across);
  list.insert(list.end(), {upon, across});
  return list;
}

}  // namespace

// The theorem's hypothesis, sides of one length, is asked of the algebra: so it is noted that the equations depend on it.
LoopBranches BranchFinder::branches_of(const Sides& sides, std::size_t number) const {
  for (const ex& difference : parallelograms_[number].differences)
    CORANK_CHECK(algebra_.is_zero(algebra_.clean(difference)));
  return {list_of(sides, algebra_), number};
}

bool BranchFinder::are_equal(const PlanePoint& a, const PlanePoint& b) const {
  const PlanePoint difference = shifted(a, b, -1);
  return std::ranges::all_of(difference.terms, [&](const Turn& term) {
    const ex re = algebra_.clean(term.k.re), im = algebra_.clean(term.k.im);
    return algebra_.is_constant(re) && algebra_.is_constant(im) && algebra_.is_zero(re) && algebra_.is_zero(im);
  });
}

bool BranchFinder::are_opposite_or_equal(const PlanePoint& a, const PlanePoint& b) const {
  return are_equal(a, b) || are_equal(shifted({}, a, -1), b);
}

std::optional<LoopBranches> BranchFinder::of_loop(const PlanePoint& open, const Plane& plane) const {
  for (std::size_t number = 0; enabled_ && number < parallelograms_.size(); ++number) {
    Sides sides;
    for (std::size_t i = 0; i < 4; ++i)
      if (const auto& side = parallelograms_[number].ways[i]; side.body) sides[i] = plane.direction(*side.body, side.way);
    if (!std::ranges::all_of(sides, [](const auto& side) { return side.has_value(); })) continue;
    const PlanePoint there = shifted(point(*sides[0]), point(*sides[1])), back = shifted(point(*sides[2]), point(*sides[3]));
    if (are_opposite_or_equal(open, shifted(there, back, -1))) return branches_of(sides, number);
  }
  return std::nullopt;
}

std::optional<LoopBranches> BranchFinder::of_rod(std::size_t rod, const PlanePoint& gap, const Plane& plane) const {
  for (std::size_t number = 0; enabled_ && number < parallelograms_.size(); ++number) {
    const Parallelogram& one = parallelograms_[number];
    Sides sides;
    std::size_t third = 4;
    for (std::size_t i = 0; i < 4; ++i) {
      if (one.ways[i].body) sides[i] = plane.direction(*one.ways[i].body, one.ways[i].way);
      if (one.ways[i].rod == rod) third = i;
    }
    if (third == 4 || std::ranges::count_if(sides, [](const auto& s) { return s.has_value(); }) != 3) continue;
    const Sides known = rod_as_third(sides, third);
    const PlanePoint along = shifted(shifted(point(*known[0]), point(*known[1])), point(*known[3]), -1);
    if (are_opposite_or_equal(gap, along)) return branches_of(known, number);
  }
  return std::nullopt;
}

}  // namespace corank::kinematics
