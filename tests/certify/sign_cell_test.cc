// Solutions of sheets over points of their free variables: those of the sheet, never of one beside it.
#include "corank/certify/sign_cell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// x² + y² = 1, for each x two sheets.
System unit_circle() {
  System s;
  for (const char* name : {"x", "y"}) s.variables.emplace_back(name, VariableKind::length, -2, 2);
  s.equations.push_back({{Monomial(1, {Factor{0, 2}}), Monomial(1, {Factor{1, 2}}), Monomial(-1, {})}, "circle"});
  return s;
}

Box solution(double x, const Interval& y) {
  SignCellTest test(unit_circle(), {});
  const SheetCell cell{{0}, {Interval(-0.95, 0.95), y}};
  return test.solution_over(cell, cell.sides, {Interval(x), y});
}

TEST(SignCell, EnclosesTheSolutionOfItsOwnSheet) {
  const UpwardRounding rounding;
  std::mt19937 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const double x = std::uniform_real_distribution(-0.95, 0.95)(random), truth = std::sqrt(1 - x * x);
    const double side = trial % 2 == 0 ? 1 : -1;
    const Interval y = side > 0 ? Interval(0.3, 1.2) : Interval(-1.2, -0.3);
    const Box found = solution(x, y);
    EXPECT_TRUE(found[1].overlaps(Interval(side * truth - 1e-15, side * truth + 1e-15))) << x;
    EXPECT_LT(found[1].width(), 1e-11) << x;
    EXPECT_EQ(found[0], Interval(x));
  }
}

// Rounded bounds of the solution leave the region here, which proves nothing.
TEST(SignCell, StaysInTheRegionWhereTheSolutionIsOnItsBorder) {
  const UpwardRounding rounding;
  const Box found = solution(0, {1, 1.2});
  EXPECT_TRUE(found[1].contains(1.0));
  EXPECT_GE(found[1].lo(), 1.0);
  EXPECT_LT(found[1].width(), 1e-11);
}

// Chord steps from the middle of the sides end at the other sheet, whose solution is not meant.
TEST(SignCell, LeavesASolutionBesideItsRegion) {
  const UpwardRounding rounding;
  SignCellTest test(unit_circle(), {});
  const SheetCell cell{{0}, {Interval(-0.1, 0.1), Interval(0.9, 1.1)}};
  const Box found = test.solution_over(cell, cell.sides, {Interval(0), Interval(-4.1, 1.1)});
  EXPECT_TRUE(found[1].contains(1.0));
}

}  // namespace
}  // namespace corank::certify
