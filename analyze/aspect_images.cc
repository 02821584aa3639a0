#include "corank/analyze/aspect_images.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "corank/core/box.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

class SquareGrid {
 public:
  SquareGrid(Interval x, Interval y, int rows) : x_(x), y_(y), rows_(rows) {}

  struct Square {
    int i, j;
  };
  std::size_t index(const Square& s) const { return s.i * rows_ + s.j; }
  Interval side_x(int i) const { return Interval(line(x_, i), line(x_, i + 1)); }
  Interval side_y(int j) const { return Interval(line(y_, j), line(y_, j + 1)); }

  template <class Visit>
  void for_each_touching(const Interval& x, const Interval& y, const Visit& visit) const {
    const auto [i0, i1] = lines(x_, x);
    const auto [j0, j1] = lines(y_, y);
    for (int i = i0; i <= i1; ++i)
      for (int j = j0; j <= j1; ++j)
        if (side_x(i).overlaps(x) && side_y(j).overlaps(y)) visit(Square{i, j});
  }

  /// Of the squares in a list of marks. Requires UpwardRounding::active().
  Interval area(const std::vector<bool>& marks) const {
    Interval sum(0);
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < rows_; ++j)
        if (marks[index({i, j})])
          sum += (Interval(line(x_, i + 1)) - Interval(line(x_, i))) * (Interval(line(y_, j + 1)) - Interval(line(y_, j)));
    return sum;
  }

 private:
  // The same number wherever it is asked for; the first and the last are the range's ends.
  double line(const Interval& range, int k) const {
    if (k == 0) return range.lo();
    if (k == rows_) return range.hi();
    return std::clamp(range.lo() + k * ((range.hi() - range.lo()) / rows_), range.lo(), range.hi());
  }
  // Squares about a range, one more on each side.
  std::pair<int, int> lines(const Interval& range, const Interval& part) const {
    const double step = (range.hi() - range.lo()) / rows_;
    const auto at = [&](double v) {
      return static_cast<int>(std::floor(std::clamp((v - range.lo()) / step, 0.0, 1.0 * rows_)));
    };
    return {std::max(0, at(part.lo()) - 1), std::min(rows_ - 1, at(part.hi()) + 1)};
  }

  Interval x_, y_;
  int rows_;
};

class Imager {
 public:
  Imager(SignCells& cells, int x, int y, const SquareGrid& grid) : cells_(cells), x_(x), y_(y), grid_(grid) {}

  // Marks the squares that a part may touch, and those that it is proven to cover.
  void add(const SignCell& cell, const Box& sides, const std::vector<int>& signs, int depth, std::vector<bool>& touched,
           std::vector<bool>& covered) {
    const SignCell here = cells_.cell_over(cell, sides);
    const int all = certify::SignCellTest::holds(here, signs);
    if (all < 0) return;
    if (all == 0 && depth > 0) {
      const int f = cell.free[depth % 2];
      for (const bool upper : {false, true}) {
        Box half = here.sides;
        half[f] = upper ? Interval(half[f].mid(), half[f].hi()) : Interval(half[f].lo(), half[f].mid());
        add(here, half, signs, depth - 1, touched, covered);
      }
      return;
    }
    grid_.for_each_touching(here.sides[x_], here.sides[y_], [&](const SquareGrid::Square& s) {
      touched[grid_.index(s)] = true;
      if (all > 0 && !covered[grid_.index(s)] && covers(here, signs, s)) covered[grid_.index(s)] = true;
    });
  }

 private:
  bool covers(const SignCell& cell, const std::vector<int>& signs, const SquareGrid::Square& s) {
    const Interval gx = grid_.side_x(s.i), gy = grid_.side_y(s.j);
    Box at = cell.sides;
    at[x_] = Interval(gx.mid()), at[y_] = Interval(gy.mid());
    if (!cell.sides[x_].contains(at[x_]) || !cell.sides[y_].contains(at[y_])) return false;
    // Of the cell's one part: a solution in its sheet's region over its X_F.
    return cells_.has_graph_over(at, {static_cast<int>(x_), static_cast<int>(y_)}, {gx, gy}, signs);
  }

  SignCells& cells_;
  std::size_t x_, y_;
  const SquareGrid& grid_;
};

}  // namespace

PieceImages images(SignCells& cells, const Pieces& pieces, int x, int y, int rows, solve::Control& control) {
  constexpr int kDepth = 5;
  const UpwardRounding rounding;
  const std::size_t n = pieces.representatives.size();
  PieceImages result;
  if (cells.cells().empty()) return result;
  Box hull = cells.cells().front().sides;
  for (const SignCell& cell : cells.cells()) include(hull, cell.sides);
  const SquareGrid grid(hull[x], hull[y], rows);
  Imager imager(cells, x, y, grid);
  const std::vector<bool> none(rows * rows, false);
  std::vector<std::vector<bool>> touched(n, none), covered(n, none);
  for (const Pieces::Part& part : pieces.parts) {
    if (control.ended()) return {};
    const SignCell& cell = cells.cells()[part.cell];
    const std::size_t p = part.piece;
    imager.add(cell, cell.sides, part.signs, kDepth, touched[p], covered[p]);
  }
  const auto both = [](const std::vector<bool>& a, const std::vector<bool>& b) {
    return std::find(a.begin(), a.end(), true) != a.end() &&
           std::inner_product(a.begin(), a.end(), b.begin(), false, std::logical_or<>(), std::logical_and<>());
  };
  for (std::size_t p = 0; p < n; ++p) {
    result.areas.emplace_back(grid.area(covered[p]).lo(), grid.area(touched[p]).hi());
    auto& row = result.share.emplace_back(n);
    for (std::size_t q = 0; q < n; ++q) {
      if (both(covered[p], covered[q])) row[q] = true;
      if (!both(touched[p], touched[q])) row[q] = false;
    }
  }
  return result;
}

}  // namespace corank::analyze
