// Lemmas 4 and 5 of SignCellTest: the parts of a cell about a crossing of two functions' zeros; cells in which a limit is,
// or may be, critical along the sheet.
#include <algorithm>
#include <array>
#include <utility>

#include "corank/certify/sign_cell.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

// Counts the intervals of a part on an arc, segment after segment.
struct SignCellTest::Arc {
  int intervals = 0;
  bool open = false;  // the last point is in the part

  void add(bool begin, bool holds, bool end) {
    if (holds && !(open || begin)) ++intervals;
    if (holds && intervals == 0) ++intervals;
    open = holds && end;
  }
};

SheetCell SignCellTest::over(const SheetCell& cell, Box sides) {
  SheetCell result{cell.free, std::move(sides)};
  bound(result, 1);
  return result;
}

bool SignCellTest::add_segment(const SheetCell& cell, const std::vector<int>& signs, int along, bool upwards, int depth,
                               Arc& arc) {
  const SheetCell here = over(cell, cell.sides);
  if (const int all = holds(here, signs); all != 0) {
    arc.add(all > 0, all > 0, all > 0);
    return true;
  }
  const std::size_t j = along;
  const auto at = [&](double x) {
    Box point = here.sides;
    point[j] = Interval(x);
    return holds(over(here, std::move(point)), signs);
  };
  const Interval side = here.sides[j];
  const int begin = at(upwards ? side.lo() : side.hi()), end = at(upwards ? side.hi() : side.lo());
  Slopes s;
  const std::vector<int>& frees = cell.free;
  const std::size_t f = std::ranges::find(frees, along) - frees.begin();
  // Each function's part of the segment is an interval where it is monotone, and so is what they have in common. Of one
  // function alone it is there where an end is in it.
  if (begin != 0 && end != 0 && (begin > 0 || end > 0 || here.mixed.size() == 1) && slopes(here, s) &&
      std::ranges::all_of(s, [&](const auto& slope) { return sign_of(slope[f]) != 0; })) {
    arc.add(begin > 0, begin > 0 || end > 0, end > 0);
    return true;
  }
  const double cut = side.lo() + 0.53 * (side.hi() - side.lo());
  if (depth == 0 || !(side.lo() < cut && cut < side.hi())) return false;
  SheetCell first = here, second = here;
  (upwards ? first : second).sides[j] = Interval(side.lo(), cut);
  (upwards ? second : first).sides[j] = Interval(cut, side.hi());
  return add_segment(first, signs, along, upwards, depth - 1, arc) &&
         add_segment(second, signs, along, upwards, depth - 1, arc);
}

int SignCellTest::part_by_outflow(const SheetCell& cell, const std::vector<int>& signs,
                                  const std::vector<std::vector<double>>& directions) {
  CORANK_CHECK(UpwardRounding::active());
  constexpr int kHalvingsOfArc = 10;
  const std::vector<int>& frees = cell.free;
  if (frees.size() != 2 || cell.mixed.empty() || cell.mixed.size() > 2) return 0;
  Slopes s;
  if (!slopes(cell, s)) return 0;
  int tries = 3;
  for (std::vector<double> d : directions) {
    const int out = growth(cell, s, d, signs);
    if (out == 0) continue;
    for (double& x : d) x *= out;
    // The sides through which d leaves X_F, as one arc: first that of the one free variable, then that of the other.
    Arc arc;
    bool known = true;
    for (std::size_t f = 0; f < 2 && known; ++f) {
      const std::size_t fixed = frees[f];
      const int along = frees[1 - f];
      if (d[f] == 0) continue;
      SheetCell side = cell;
      side.sides[fixed] = Interval(d[f] > 0 ? cell.sides[fixed].hi() : cell.sides[fixed].lo());
      // The first ends at the arc's corner, the second begins there.
      const bool upwards = (d[1 - f] >= 0) == (f == 0);
      known = add_segment(side, signs, along, upwards, kHalvingsOfArc, arc);
    }
    if (known && arc.intervals <= 1) return arc.intervals == 1 ? 1 : -1;
    if (--tries == 0) return 0;
  }
  return 0;
}

namespace {

using Plane = std::array<Interval, 2>;

Interval dot(const Plane& a, const std::vector<Interval>& b) { return a[0] * b[0] + a[1] * b[1]; }
Plane times(const IntervalMatrix& h, const Plane& v) {
  return {h(0, 0) * v[0] + h(0, 1) * v[1], h(1, 0) * v[0] + h(1, 1) * v[1]};
}
Interval form(const IntervalMatrix& h, const Plane& v) {
  const Plane by = times(h, v);
  return v[0] * by[0] + v[1] * by[1];
}

}  // namespace

std::optional<std::vector<SheetDerivatives>> SignCellTest::second_order(const SheetCell& cell) const {
  std::vector<Polynomial> mixed;
  for (const int k : cell.mixed) mixed.push_back(functions_[k]);
  return sheet_derivatives(system_, cell.free, cell.sides, mixed);
}

bool SignCellTest::convex_on_levels(const SheetDerivatives& e, const SheetDerivatives& h) {
  CORANK_CHECK(e.first.size() == 2 && h.first.size() == 2 && UpwardRounding::active());
  const Plane t{h.first[1], -h.first[0]};
  // T(T e) = D²e(T, T) + De·(DT T), where DT T = ((D²h T)_2, −(D²h T)_1).
  const Plane bent = times(h.second, t);
  return sign_of(form(e.second, t) + dot({bent[1], -bent[0]}, e.first)) > 0;
}

bool SignCellTest::convex_on_lines(const SheetDerivatives& e, const std::vector<double>& direction) {
  CORANK_CHECK(e.first.size() == 2 && direction.size() == 2 && UpwardRounding::active());
  return sign_of(form(e.second, {Interval(direction[0]), Interval(direction[1])})) > 0;
}

}  // namespace corank::certify
