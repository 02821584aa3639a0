#include "corank/analyze/aspects/aspect_images.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
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

// A solution over a point of X_F: its variables and the functions there.
struct Corner {
  std::vector<double> x, g;
};

class Drawer {
 public:
  Drawer(SignCells& cells, const std::vector<std::string>& names, const solve::Control& control)
      : cells_(cells), control_(control) {
    const System& system = cells.system();
    for (const std::string& name : names) {
      Coordinate c;
      for (const Angle& a : system.angles)
        if (a.name == name) c = {a.cosine, a.sine};
      if (c.x < 0) c.x = system.find(name);
      known_ = known_ && c.x >= 0;
      coordinates_.push_back(c);
    }
  }

  bool known() const { return known_; }
  bool is_angle(std::size_t k) const { return coordinates_[k].y >= 0; }

  void draw(const SignCell& cell, const Box& sides, const std::vector<int>& signs, int depth,
            std::vector<PieceDrawing::Polygon>& out) {
    if (control_.ended()) return;
    const SignCell here = cells_.cell_over(cell, sides);
    const int all = certify::SignCellTest::holds(here, signs);
    if (all < 0) return;
    const int a = cell.free[0], b = cell.free[1];
    if (all == 0 && depth > 0) {
      for (const int quarter : {0, 1, 2, 3}) {
        Box part = here.sides;
        part[a] = half(part[a], quarter % 2);
        part[b] = half(part[b], quarter / 2);
        draw(here, part, signs, depth - 1, out);
      }
      return;
    }
    std::vector<Corner> polygon;
    for (const auto& [p, q] : {std::pair(0, 0), {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}) {
      Box at = here.sides;
      at[a] = Interval(point(at[a], p));
      at[b] = Interval(point(at[b], q));
      polygon.push_back(corner(here, cells_.solution_over(here, std::move(at))));
    }
    for (const int k : here.mixed) clip(polygon, k, signs[k]);
    if (polygon.size() > 2) out.push_back(values(polygon));
  }

 private:
  struct Coordinate {
    int x = -1, y = -1;  // a length, or a cosine and its sine
  };

  static Interval half(const Interval& side, int upper) {
    return upper != 0 ? Interval(side.mid(), side.hi()) : Interval(side.lo(), side.mid());
  }
  static double point(const Interval& side, int k) { return k == 0 ? side.lo() : k == 1 ? side.mid() : side.hi(); }

  Corner corner(const SignCell& cell, const Box& box) {
    Corner result;
    result.x = midpoint(box);
    for (const Interval& g : cells_.cell_over(cell, box).range) result.g.push_back(g.mid());
    return result;
  }

  // Keeps where s·g > 0 (Sutherland and Hodgman).
  static void clip(std::vector<Corner>& polygon, int k, int sign) {
    std::vector<Corner> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double u = sign * p.g[k], v = sign * q.g[k];
      if (u > 0) result.push_back(p);
      if ((u > 0) == (v > 0)) continue;
      const double share = u / (u - v);
      Corner cut = p;
      for (std::size_t j = 0; j < cut.x.size(); ++j) cut.x[j] += share * (q.x[j] - p.x[j]);
      for (std::size_t j = 0; j < cut.g.size(); ++j) cut.g[j] += share * (q.g[j] - p.g[j]);
      result.push_back(std::move(cut));
    }
    polygon = std::move(result);
  }

  PieceDrawing::Polygon values(const std::vector<Corner>& polygon) const {
    PieceDrawing::Polygon result;
    for (const Corner& corner : polygon) {
      std::vector<double>& point = result.emplace_back();
      for (std::size_t c = 0; c < coordinates_.size(); ++c) {
        const std::size_t x = coordinates_[c].x;
        double value = corner.x[x];
        if (is_angle(c)) {
          value = std::atan2(corner.x[coordinates_[c].y], value);
          const double first = result.size() == 1 ? value : result.front()[c];
          value -= 2 * std::numbers::pi * std::round((value - first) / (2 * std::numbers::pi));
        }
        point.push_back(value);
      }
    }
    return result;
  }

  SignCells& cells_;
  const solve::Control& control_;
  std::vector<Coordinate> coordinates_;
  bool known_ = true;
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
  for (const Pieces::CellPart& part : pieces.parts) {
    if (control.ended()) return {};
    const SignCell& cell = cells.cells()[part.cell];
    const std::size_t p = part.piece;
    imager.add(cell, cell.sides, part.signs, kDepth, touched[p], covered[p]);
  }
  const auto both = [](const std::vector<bool>& a, const std::vector<bool>& b) {
    return std::ranges::find(a, true) != a.end() &&
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

std::optional<PieceDrawing> draw(SignCells& cells, const Pieces& pieces, const std::vector<std::string>& coordinates,
                                 const solve::Control& control) {
  constexpr int kDepth = 2;
  PieceDrawing result;
  Drawer drawer(cells, coordinates, control);
  if (cells.cover().dimension != 2 || !drawer.known()) return result;
  result.coordinates = coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) result.is_angle.push_back(drawer.is_angle(k));
  result.pieces.resize(pieces.representatives.size());
  const UpwardRounding rounding;
  for (const Pieces::CellPart& part : pieces.parts) {
    const SignCell& cell = cells.cells()[part.cell];
    drawer.draw(cell, cell.sides, part.signs, kDepth, result.pieces[part.piece]);
  }
  if (control.ended()) return std::nullopt;
  return result;
}

}  // namespace corank::analyze
