// Unions of rectangles on a grid: what the polygons hold is what was added.
#include "corank/report/pictures/cell_union.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace corank::report {
namespace {

// Is the middle of the cell (x, y) inside, by the even-odd rule?
bool inside(const std::vector<GridPolygon>& polygons, int x, int y) {
  int crossings = 0;
  for (const GridPolygon& p : polygons)
    for (std::size_t k = 0; k < p.size(); ++k) {
      const GridPoint &a = p[k], &b = p[(k + 1) % p.size()];
      if (a.x == b.x && a.x <= x && std::min(a.y, b.y) <= y && y < std::max(a.y, b.y)) ++crossings;
    }
  return crossings % 2 == 1;
}

void expect_alternating(const std::vector<GridPolygon>& polygons) {
  for (const GridPolygon& p : polygons) {
    ASSERT_EQ(p.size() % 2, 0u);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const GridPoint &a = p[k], &b = p[(k + 1) % p.size()];
      ASSERT_TRUE(k % 2 == 0 ? a.y == b.y && a.x != b.x : a.x == b.x && a.y != b.y) << "horizontal and vertical in turns";
    }
  }
}

TEST(CellUnion, OfARectangleIsItsFourCorners) {
  CellUnion cells(100, 50);
  cells.add(3, 4, 90, 7);
  EXPECT_EQ(cells.outlines(), (std::vector<GridPolygon>{{{3, 4}, {90, 4}, {90, 7}, {3, 7}}}));
}

TEST(CellUnion, MakesOneShapeOfWhatTouches) {
  CellUnion cells(200, 200);
  for (int k = 0; k < 100; ++k) cells.add(2 * k, 0, 2 * k + 2, 200);
  EXPECT_EQ(cells.outlines(), (std::vector<GridPolygon>{{{0, 0}, {200, 0}, {200, 200}, {0, 200}}}));
}

TEST(CellUnion, KeepsHolesAndCornersThatTouch) {
  CellUnion cells(64, 64);
  cells.add(0, 0, 10, 10);
  cells.add(10, 10, 64, 64);
  const auto polygons = cells.outlines();
  expect_alternating(polygons);
  EXPECT_TRUE(inside(polygons, 9, 9) && inside(polygons, 10, 10));
  EXPECT_FALSE(inside(polygons, 10, 9) || inside(polygons, 9, 10));
}

TEST(CellUnion, OfRandomRectanglesHoldsTheirCellsAndNoOthers) {
  std::mt19937 random(6);
  RecordProperty("seed", 6);
  for (int trial = 0; trial < 60; ++trial) {
    const int columns = 1 + static_cast<int>(random() % 150), rows = 1 + static_cast<int>(random() % 70);
    const auto upto = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n + 20)) - 10; };
    CellUnion cells(columns, rows);
    std::vector<std::vector<bool>> expected(static_cast<std::size_t>(rows),
                                            std::vector<bool>(static_cast<std::size_t>(columns)));
    for (int k = static_cast<int>(random() % 30); k >= 0; --k) {
      const int x0 = upto(columns), y0 = upto(rows), x1 = x0 + upto(trial % 2 == 0 ? 5 : columns), y1 = y0 + upto(5);
      cells.add(x0, y0, x1, y1);
      for (int y = std::max(0, y0); y < std::min(rows, y1); ++y)
        for (int x = std::max(0, x0); x < std::min(columns, x1); ++x)
          expected[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = true;
    }
    const auto polygons = cells.outlines();
    expect_alternating(polygons);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const bool held = expected[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
        ASSERT_EQ(cells.holds(x, y), held) << trial;
        ASSERT_EQ(inside(polygons, x, y), held) << trial << ": " << x << ' ' << y;
      }
  }
}

}  // namespace
}  // namespace corank::report
