#include "corank/analyze/aspect_images.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

// A solution over a point of X_F: its variables and the functions there.
struct Corner {
  std::vector<double> x, g;
};

class Drawer {
 public:
  Drawer(SignCells& cells, const std::vector<std::string>& names, const Ended& ended) : cells_(cells), ended_(ended) {
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
    if (ended_()) return;
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
    for (const Interval& side : box) result.x.push_back(side.mid());
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
  const Ended& ended_;
  std::vector<Coordinate> coordinates_;
  bool known_ = true;
};

}  // namespace

std::optional<PieceDrawing> draw(SignCells& cells, const Pieces& pieces, const std::vector<std::string>& coordinates,
                                 const Ended& ended) {
  constexpr int kDepth = 2;
  PieceDrawing result;
  Drawer drawer(cells, coordinates, ended);
  if (cells.cover().dimension != 2 || !drawer.known()) return result;
  result.coordinates = coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) result.is_angle.push_back(drawer.is_angle(k));
  result.pieces.resize(pieces.representatives.size());
  const UpwardRounding rounding;
  for (const Pieces::Part& part : pieces.parts) {
    const SignCell& cell = cells.cells()[part.cell];
    drawer.draw(cell, cell.sides, part.signs, kDepth, result.pieces[part.piece]);
  }
  if (ended()) return std::nullopt;
  return result;
}

}  // namespace corank::analyze
