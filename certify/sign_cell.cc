#include "corank/certify/sign_cell.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/certify/inertia.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

SignCellTest::SignCellTest(const System& system, const std::vector<Polynomial>& functions)
    : system_(system), functions_(functions), compiled_(system, functions) {}

Preconditioner SignCellTest::preconditioner(const std::vector<int>& free, const Box& sides) const {
  return midpoint_preconditioner(compiled_, midpoint(sides), all_but(free, compiled_.variables()));
}

// Shrinks the dependent sides and bounds the function over the sheet's solutions there.
Interval SignCellTest::range(const SheetCell& cell, int function, Box& sides) {
  const NewtonStep step = tighten_sheet(compiled_, preconditioner(cell.free, sides), sides, workspace_);
  Interval value = step.value_at_zeros(compiled_.value_row(function), sides);
  CORANK_CHECK(value.intersect(compiled_.evaluate(compiled_.value_row(function), sides)));
  return value;
}

void SignCellTest::bound(SheetCell& cell, int steps) {
  CORANK_CHECK(steps > 0 && UpwardRounding::active());
  for (int k = 1; k < steps; ++k) tighten_sheet(compiled_, preconditioner(cell.free, cell.sides), cell.sides, workspace_);
  const NewtonStep step = tighten_sheet(compiled_, preconditioner(cell.free, cell.sides), cell.sides, workspace_);
  cell.range.clear();
  cell.mixed.clear();
  for (int k = 0; k < functions(); ++k) {
    Interval value = step.value_at_zeros(compiled_.value_row(k), cell.sides);
    CORANK_CHECK(value.intersect(compiled_.evaluate(compiled_.value_row(k), cell.sides)));
    if (sign_of(value) == 0) cell.mixed.push_back(k);
    cell.range.push_back(value);
  }
}

int SignCellTest::holds(const SheetCell& cell, const std::vector<int>& signs) {
  bool all = true;
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const Interval& value = cell.range[k];
    if (signs[k] > 0 ? value.hi() <= 0 : value.lo() >= 0) return -1;  // also where it is 0 all over, as on an end
    all = all && sign_of(value) != 0;
  }
  return all ? 1 : 0;
}

bool SignCellTest::slopes(const SheetCell& cell, Slopes& result) const {
  CORANK_CHECK(UpwardRounding::active());
  const int m = compiled_.equations(), n = compiled_.variables();
  const auto dense = [&](int row, auto&& set) {
    std::vector<Interval> entries(compiled_.entries());
    compiled_.jacobian(row, cell.sides, entries);
    for (int k = compiled_.row_begin(row); k < compiled_.row_begin(row + 1); ++k) set(compiled_.column(k), entries[k]);
  };
  IntervalMatrix jacobian(m, n);
  for (int i = 0; i < m; ++i) dense(i, [&](int j, const Interval& e) { jacobian(i, j) += e; });
  const auto basis = kernel_basis(jacobian, all_but(cell.free, n), compiled_.scales());
  if (!basis) return false;
  result.clear();
  for (const int g : cell.mixed) {
    std::vector<Interval>& by_free = result.emplace_back(basis->columns);
    dense(compiled_.value_row(g), [&](int j, const Interval& e) {
      for (int f = 0; f < basis->columns; ++f) by_free[f] += e * (*basis)(j, f);
    });
  }
  return true;
}

int SignCellTest::growth(const SheetCell& cell, const Slopes& slopes, const std::vector<double>& direction,
                         const std::vector<int>& signs) {
  CORANK_CHECK(UpwardRounding::active() && slopes.size() == cell.mixed.size());
  bool grow = true, shrink = true;
  for (std::size_t k = 0; k < cell.mixed.size(); ++k) {
    Interval along;
    for (std::size_t f = 0; f < direction.size(); ++f) along += Interval(direction[f]) * slopes[k][f];
    const int growth = sign_of(along) * signs[cell.mixed[k]];
    grow = grow && growth > 0;
    shrink = shrink && growth < 0;
  }
  return grow ? 1 : shrink ? -1 : 0;
}

int SignCellTest::connected(const SheetCell& cell, int function, int sign, const std::vector<Interval>& slope, Box sides,
                            std::vector<int> open) {
  const Interval value = range(cell, function, sides);
  if (sign_of(value) == sign) return 1;
  if (sign > 0 ? value.hi() <= 0 : value.lo() >= 0) return -1;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::size_t f = std::ranges::find(cell.free, open[i]) - cell.free.begin();
    const int growth = sign * sign_of(slope[f]);
    if (growth == 0) continue;
    Interval& side = sides[open[i]];
    side = Interval(growth > 0 ? side.hi() : side.lo());
    open.erase(open.begin() + i);
    return connected(cell, function, sign, slope, std::move(sides), std::move(open));
  }
  return 0;
}

int SignCellTest::part_of_one(const SheetCell& cell, int sign) {
  CORANK_CHECK(cell.mixed.size() == 1 && UpwardRounding::active());
  Slopes s;
  if (!slopes(cell, s)) return 0;
  return connected(cell, cell.mixed.front(), sign, s.front(), cell.sides, cell.free);
}

bool SignCellTest::chord_steps(const Preconditioner& p, std::vector<double>& point) const {
  constexpr int kSteps = 5;
  constexpr double kEnough = 1e-12;  // of a variable's size
  const int r = p.rank();
  std::vector<double> value(r);
  for (int step = 0; step < kSteps; ++step) {
    for (int b = 0; b < r; ++b) value[b] = compiled_.evaluate_at(p.equations[b], point.data()).mid();
    double longest = 0;
    for (int a = 0; a < r; ++a) {
      double shift = 0;
      for (int b = 0; b < r; ++b) shift += p.y[a * r + b] * value[b];
      point[p.dependent[a]] -= shift;
      longest = std::max(longest, std::fabs(shift) / compiled_.scales()[p.dependent[a]]);
    }
    if (longest < kEnough) return true;
  }
  return false;
}

Box SignCellTest::solution_over(const SheetCell& cell, const Box& region, Box sides) {
  constexpr int kTries = 3;
  constexpr double kNarrow = 1e-11;
  const std::vector<int> dependent = all_but(cell.free, compiled_.variables());
  std::vector<double> point = midpoint(sides);
  for (int k = 0; k < kTries; ++k) {
    const Preconditioner p = midpoint_preconditioner(compiled_, point, dependent);
    if (!chord_steps(p, point)) continue;
    Box about = sides;
    for (const int d : dependent) about[d] = Interval(point[d]);
    Sheet sheet = newton_prove(compiled_, p, about, workspace_);
    if (sheet.proven && contains(region, sheet.image)) return std::move(sheet.image);
    break;
  }
  for (int step = 0; step < 5; ++step) {
    tighten_sheet(compiled_, preconditioner(cell.free, sides), sides, workspace_);
    double widest = 0;
    for (std::size_t j = 0; j < sides.size(); ++j) widest = std::max(widest, sides[j].width() / compiled_.scales()[j]);
    if (widest < kNarrow) break;
  }
  return sides;
}

bool SignCellTest::narrow(SheetCell& cell, const Box& region) {
  Box middle = cell.sides;
  std::vector<Interval> over;
  for (const int f : cell.free) {
    over.push_back(cell.sides[f]);
    middle[f] = Interval(middle[f].mid());
  }
  const Sheet sheet = graph_over(solution_over(cell, region, std::move(middle)), cell.free, over);
  if (!sheet.proven || !contains(region, sheet.image)) return false;
  CORANK_CHECK(intersect(cell.sides, sheet.image));
  return true;
}

Sheet SignCellTest::sheet_over(const SheetCell& cell) {
  return newton_prove(compiled_, preconditioner(cell.free, cell.sides), cell.sides, workspace_);
}

std::vector<int> SignCellTest::signs(const Box& box) const {
  std::vector<int> result;
  for (int k = 0; k < functions(); ++k) result.push_back(sign_of(compiled_.evaluate(compiled_.value_row(k), box)));
  return result;
}

Sheet SignCellTest::graph_over(const Box& point, const std::vector<int>& free, const std::vector<Interval>& over) {
  Box around = point;
  for (std::size_t k = 0; k < free.size(); ++k) around[free[k]] = over[k];
  Sheet sheet = newton_prove(compiled_, preconditioner(free, point), around, workspace_);
  sheet.proven = sheet.proven && contains(sheet.region, point);
  return sheet;
}

}  // namespace corank::certify
