// Pieces of a set by the points of a grid in it: a count of its own, in doubles, to compare proven ones with.
#pragma once

#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <map>
#include <vector>

namespace corank::analyze {

struct FloodGrid {
  std::array<std::size_t, 3> points;  ///< along each axis
  std::array<bool, 3> closed{};       ///< does the last one have the first as neighbour?
  std::size_t least = 1;              ///< smaller pieces do not count: a grid cuts them off from narrow corners
};

/// Those of the points {i, j, k} for which `inside` is true that are neighbours along an axis hang together.
template <typename Inside>
std::size_t flood_pieces(const FloodGrid& grid, const Inside& inside) {
  using Point = std::array<std::size_t, 3>;
  const auto& n = grid.points;
  const auto at = [&](const Point& p) { return (p[0] * n[1] + p[1]) * n[2] + p[2]; };
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < n[0]; ++i)
      for (std::size_t j = 0; j < n[1]; ++j)
        for (std::size_t k = 0; k < n[2]; ++k) visit(Point{i, j, k});
  };
  std::vector<bool> in(n[0] * n[1] * n[2]);
  each([&](const Point& p) { in[at(p)] = inside(p); });
  boost::disjoint_sets_with_storage<> together(in.size());
  each([&](const Point& p) {
    if (!in[at(p)]) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Point next = p;
      if (++next[axis] == n[axis]) next[axis] = grid.closed[axis] ? 0 : p[axis];
      if (in[at(next)]) together.union_set(at(p), at(next));
    }
  });
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t c = 0; c < in.size(); ++c)
    if (in[c]) ++sizes[together.find_set(c)];
  std::size_t pieces = 0;
  for (const auto& [root, size] : sizes) pieces += size >= grid.least ? 1 : 0;
  return pieces;
}

}  // namespace corank::analyze
