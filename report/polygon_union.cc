#include "corank/report/polygon_union.h"

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>

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
