// Lemma 5 of SignCellTest: cells in which a limit is, or may be, critical along the sheet.
#include <array>

#include "corank/certify/sign_cell.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/core/signs.h"

namespace corank::certify {
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
  for (const int k : cell.mixed) mixed.push_back(functions_[static_cast<std::size_t>(k)]);
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
