// Unions of polygons on a grid, as few polygons: how boxes that cannot be told apart at a picture's resolution, and the
// parts of a region, become one shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace corank::report {

struct GridPoint {
  int x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};
/// A closed polygon whose edges are horizontal and vertical in turns, the first one horizontal.
using GridPolygon = std::vector<GridPoint>;

/// The union of many rectangles on a grid of unit cells.
class CellUnion {
 public:
  /// The grid [0, columns] × [0, rows].
  CellUnion(int columns, int rows);

  /// Adds the cells of [x0, x1] × [y0, y1], cut to the grid.
  void add(int x0, int y0, int x1, int y1);
  /// The cell [x, x + 1] × [y, y + 1]; false outside the grid.
  bool holds(int x, int y) const;
  /// Polygons whose interior by the even-odd rule is the union, with no vertex that could be left out. Lexicographic order.
  std::vector<GridPolygon> outlines() const;

 private:
  // Bits of 64 cells; row −1 and row `rows` are empty.
  std::uint64_t word(int row, std::size_t k) const;

  int columns_, rows_;
  std::size_t words_;  // of a row
  std::vector<std::uint64_t> cells_;
};

/// Rings whose interior by the even-odd rule is the union of the polygons', of either sense, but for what is nearer than
/// `tolerance` to its border; holes and pieces that are hardly larger than that are left out.
std::vector<GridPolygon> outlines_of_union(const std::vector<GridPolygon>& polygons, double tolerance);

}  // namespace corank::report
