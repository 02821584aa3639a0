// Lemma 4 of SignCells: the parts of a cell about a crossing of two functions' zeros.
#include <algorithm>

#include "corank/analyze/sign_cells.h"
#include "corank/analyze/signs.h"
#include "corank/certify/preconditioning.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
// Counts the intervals of a part on an arc, segment after segment.
struct SignCells::Arc {
  int intervals = 0;
  bool open = false;  // the last point is in the part

  void add(bool begin, bool holds, bool end) {
    if (holds && !(open || begin)) ++intervals;
    if (holds && intervals == 0) ++intervals;
    open = holds && end;
  }
};

SignCell SignCells::cell_over(const SignCell& cell, Box sides) const {
  SignCell result{cell.box, std::move(sides), {}, {}, false, {}, {}};
  certify::NewtonWorkspace workspace;
  const certify::NewtonStep step =
      certify::tighten_sheet(compiled_, preconditioner(result, result.sides), result.sides, workspace);
  for (int k = 0; k < functions(); ++k) {
    Interval value = step.value_at_zeros(compiled_.value_row(k), result.sides);
    CORANK_CHECK(value.intersect(compiled_.evaluate(compiled_.value_row(k), result.sides)));
    if (sign_of(value) == 0) result.mixed.push_back(k);
    result.range.push_back(value);
  }
  return result;
}

int SignCells::holds(const SignCell& cell, const std::vector<int>& signs) {
  bool all = true;
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const int sign = sign_of(cell.range[k]);
    if (sign == -signs[k]) return -1;
    all = all && sign != 0;
  }
  return all ? 1 : 0;
}

bool SignCells::add_segment(const SignCell& cell, const std::vector<int>& signs, int along, bool upwards, int depth,
                            Arc& arc) {
  const SignCell here = cell_over(cell, cell.sides);
  if (const int all = holds(here, signs); all != 0) {
    arc.add(all > 0, all > 0, all > 0);
    return true;
  }
  const auto j = static_cast<std::size_t>(along);
  const auto at = [&](double x) {
    Box point = here.sides;
    point[j] = Interval(x);
    return holds(cell_over(here, std::move(point)), signs);
  };
  const Interval side = here.sides[j];
  const int begin = at(upwards ? side.lo() : side.hi()), end = at(upwards ? side.hi() : side.lo());
  Slopes s;
  const std::vector<int>& frees = free(cell);
  const auto f = static_cast<std::size_t>(std::find(frees.begin(), frees.end(), along) - frees.begin());
  // Each function's part of the segment is an interval where it is monotone, and so is what they have in common. Of one
  // function alone it is there where an end is in it.
  if (begin != 0 && end != 0 && (begin > 0 || end > 0 || here.mixed.size() == 1) && slopes(here, s) &&
      std::all_of(s.of.begin(), s.of.end(), [&](const auto& slope) { return sign_of(slope[f]) != 0; })) {
    arc.add(begin > 0, begin > 0 || end > 0, end > 0);
    return true;
  }
  const double cut = side.lo() + 0.53 * (side.hi() - side.lo());
  if (depth == 0 || !(side.lo() < cut && cut < side.hi())) return false;
  SignCell first = here, second = here;
  (upwards ? first : second).sides[j] = Interval(side.lo(), cut);
  (upwards ? second : first).sides[j] = Interval(cut, side.hi());
  return add_segment(first, signs, along, upwards, depth - 1, arc) &&
         add_segment(second, signs, along, upwards, depth - 1, arc);
}

int SignCells::part_by_outflow(const SignCell& cell, const std::vector<int>& signs) {
  CORANK_CHECK(UpwardRounding::active());
  constexpr int kHalvings = 10;
  const std::vector<int>& frees = free(cell);
  if (frees.size() != 2 || cell.mixed.empty() || cell.mixed.size() > 2) return 0;
  Slopes s;
  if (!slopes(cell, s)) return 0;
  const auto sign = [&](std::size_t k) { return signs[static_cast<std::size_t>(cell.mixed[k])]; };
  int tries = 3;
  for (std::vector<double> d : directions(cell)) {
    std::vector<int> growth;
    for (std::size_t k = 0; k < s.of.size(); ++k)
      growth.push_back(sign(k) * sign_of(Interval(d[0]) * s.of[k][0] + Interval(d[1]) * s.of[k][1]));
    if (growth.front() == 0 || growth.front() != growth.back()) continue;
    for (double& x : d) x *= growth.front();
    // The sides through which d leaves X_F, as one arc: first that of the one free variable, then that of the other.
    Arc arc;
    bool known = true;
    for (std::size_t f = 0; f < 2 && known; ++f) {
      const auto fixed = static_cast<std::size_t>(frees[f]);
      const int along = frees[1 - f];
      if (d[f] == 0) continue;
      SignCell side = cell;
      side.sides[fixed] = Interval(d[f] > 0 ? cell.sides[fixed].hi() : cell.sides[fixed].lo());
      // The first ends at the arc's corner, the second begins there.
      const bool upwards = (d[1 - f] >= 0) == (f == 0);
      known = add_segment(side, signs, along, upwards, kHalvings, arc);
    }
    if (known && arc.intervals <= 1) return arc.intervals == 1 ? 1 : -1;
    if (--tries == 0) return 0;
  }
  return 0;
}

bool SignCells::has_graph_over(const Box& at, const std::vector<int>& free, const std::vector<Interval>& over,
                               const std::vector<int>& wanted) {
  const std::optional<Box> point = test_.solution_in(at, at);
  if (!point) return false;
  const std::vector<int> dependent = dependent_of(free);
  std::vector<double> c;
  Box around = *point;
  for (const Interval& side : *point) c.push_back(side.mid());
  for (std::size_t k = 0; k < free.size(); ++k) around[static_cast<std::size_t>(free[k])] = over[k];
  const certify::Preconditioner p = certify::midpoint_preconditioner(compiled_, c, dependent);
  const certify::Sheet sheet = certify::newton_prove(compiled_, p, around, workspace_);
  if (!sheet.proven) return false;
  for (std::size_t j = 0; j < point->size(); ++j)
    if (!sheet.region[j].contains((*point)[j])) return false;
  return signs(sheet.image) == wanted;
}

}  // namespace corank::analyze
