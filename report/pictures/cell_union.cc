#include "corank/report/pictures/cell_union.h"

#include <algorithm>
#include <bit>
#include <boost/polygon/polygon.hpp>
#include <cmath>
#include <numeric>
#include <tuple>

namespace corank::report {
namespace {

namespace bp = boost::polygon;
using Point = bp::point_data<int>;

double distance_to_line(const GridPoint& p, const GridPoint& a, const GridPoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
  return std::fabs(dx * (p.y - a.y) - dy * (p.x - a.x)) / length;
}

// Douglas and Peucker's: the points from `from` to `to`, the last left out, that are needed.
void add_needed(const GridPolygon& ring, std::size_t from, std::size_t to, double tolerance, GridPolygon& out) {
  std::size_t farthest = from;
  double most = tolerance;
  const GridPoint &a = ring[from], &b = ring[to % ring.size()];
  for (std::size_t k = from + 1; k < to; ++k)
    if (const double far = distance_to_line(ring[k], a, b); far > most) most = far, farthest = k;
  if (farthest == from) {
    out.push_back(a);
    return;
  }
  add_needed(ring, from, farthest, tolerance, out);
  add_needed(ring, farthest, to, tolerance, out);
}

double area(const GridPolygon& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const GridPoint &p = ring[i], &q = ring[(i + 1) % ring.size()];
    twice += static_cast<double>(p.x) * q.y - static_cast<double>(q.x) * p.y;
  }
  return std::fabs(twice) / 2;
}

template <class Ring>
void add_ring(const Ring& points, double tolerance, std::vector<GridPolygon>& out) {
  GridPolygon ring;
  for (const Point& p : points) ring.push_back({p.x(), p.y()});
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  constexpr double kLeastWidth = 3;  // in tolerances
  if (ring.size() < 3 || area(ring) < kLeastWidth * kLeastWidth * tolerance * tolerance) return;
  // The point farthest from the first divides the ring into two lines.
  std::size_t other = 0;
  const auto far = [&](std::size_t k) { return std::hypot(ring[k].x - ring[0].x, ring[k].y - ring[0].y); };
  for (std::size_t k = 1; k < ring.size(); ++k)
    if (far(k) > far(other)) other = k;
  GridPolygon needed;
  add_needed(ring, 0, other, tolerance, needed);
  add_needed(ring, other, ring.size(), tolerance, needed);
  if (needed.size() > 2) out.push_back(std::move(needed));
}

}  // namespace

CellUnion::CellUnion(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      words_(columns / 64 + 1),  // the last bit is never a cell: every run ends in its row
      cells_(words_ * rows, 0) {}

void CellUnion::add(int x0, int y0, int x1, int y1) {
  x0 = std::max(x0, 0), y0 = std::max(y0, 0), x1 = std::min(x1, columns_), y1 = std::min(y1, rows_);
  if (x0 >= x1) return;
  const std::size_t first = x0 / 64, last = (x1 - 1) / 64;
  const std::uint64_t head = ~std::uint64_t{0} << (x0 % 64), tail = ~std::uint64_t{0} >> (63 - (x1 - 1) % 64);
  for (int y = y0; y < y1; ++y) {
    std::uint64_t* const row = cells_.data() + y * words_;
    for (std::size_t k = first; k <= last; ++k)
      row[k] |= (k == first ? head : ~std::uint64_t{0}) & (k == last ? tail : ~std::uint64_t{0});
  }
}

bool CellUnion::holds(int x, int y) const {
  if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return false;
  return (word(y, x / 64) >> (x % 64) & 1) != 0;
}

std::uint64_t CellUnion::word(int row, std::size_t k) const {
  return row < 0 || row >= rows_ ? 0 : cells_[row * words_ + k];
}

std::vector<GridPolygon> CellUnion::outlines() const {
  // A unit edge belongs to the outline where one of its two cells is in the union. About a vertex their number is even:
  // where there are two in line, or four, edges run straight on (even-odd rule); else one horizontal and one vertical edge
  // end there. So the ends of the horizontal runs are the corners, in pairs, and, sorted by columns, the ends of the
  // vertical runs in pairs, too.
  std::vector<GridPoint> corners;
  for (int y = 0; y <= rows_; ++y) {
    std::uint64_t carry = 0;  // is the cell before the word's first one on a run?
    for (std::size_t k = 0; k < words_; ++k) {
      const std::uint64_t runs = word(y - 1, k) ^ word(y, k);
      for (std::uint64_t ends = runs ^ (runs << 1 | carry); ends != 0; ends &= ends - 1)
        corners.push_back({static_cast<int>(k * 64) + std::countr_zero(ends), y});
      carry = runs >> 63;
    }
  }
  std::vector<std::size_t> by_column(corners.size()), vertical_partner(corners.size());
  std::iota(by_column.begin(), by_column.end(), std::size_t{0});
  std::ranges::sort(by_column, [&](std::size_t a, std::size_t b) {
    return std::tie(corners[a].x, corners[a].y) < std::tie(corners[b].x, corners[b].y);
  });
  for (std::size_t k = 0; k + 1 < by_column.size(); k += 2) {
    vertical_partner[by_column[k]] = by_column[k + 1];
    vertical_partner[by_column[k + 1]] = by_column[k];
  }
  std::vector<GridPolygon> polygons;
  std::vector<bool> seen(corners.size(), false);
  for (std::size_t start = 0; start < corners.size(); ++start) {
    if (seen[start]) continue;
    GridPolygon& polygon = polygons.emplace_back();
    for (std::size_t at = start; !seen[at]; at = vertical_partner[at ^ 1]) {
      seen[at] = seen[at ^ 1] = true;
      polygon.push_back(corners[at]);
      polygon.push_back(corners[at ^ 1]);
    }
  }
  return polygons;
}

std::vector<GridPolygon> outlines_of_union(const std::vector<GridPolygon>& polygons, double tolerance) {
  bp::polygon_set_data<int> set;
  for (const GridPolygon& polygon : polygons) {
    std::vector<Point> points;
    for (const GridPoint& p : polygon) points.emplace_back(p.x, p.y);
    set.insert(bp::polygon_data<int>(points.begin(), points.end()));
  }
  std::vector<bp::polygon_with_holes_data<int>> united;
  set.get(united);
  std::vector<GridPolygon> rings;
  for (const auto& polygon : united) {
    add_ring(polygon, tolerance, rings);
    for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole) add_ring(*hole, tolerance, rings);
  }
  return rings;
}

}  // namespace corank::report
