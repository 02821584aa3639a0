// Rows over boxes: slopes, derivatives and projections hold what they should at the points of the box.
#include "corank/check/rows.h"

#include <gtest/gtest.h>

#include "corank/tests/check/enclosed_rows.h"
#include "corank/tests/system_builder.h"

namespace corank::check {
namespace {

// f(x) − f(c) ∈ s·(x − c).
bool explains(const Row& f, const Sides& s, const Sides& x, const Sides& c) {
  Enclosure difference = f.value(c) - f.value(x);
  for (std::size_t k = 0; k < s.size(); ++k) {
    const auto j = static_cast<std::size_t>(f.columns()[k]);
    difference += s[k] * (x[j] - c[j]);
  }
  return difference.has_zero();
}

// The slopes about the centre, and the derivatives over the hull, at every corner and middle of [from, to]³.
void expect_slopes(const std::vector<Term>& terms, double from, double to, double center) {
  const Row f = row(terms);
  const Sides box(3, Enclosure(from, to)), c(3, Enclosure(center));
  const Sides hull(3, Enclosure(std::min(from, center), std::max(to, center)));
  Sides slopes, derivatives;
  f.slopes(box, c, slopes);
  f.derivatives(hull, derivatives);
  for (int k = 0; k < 27; ++k) {
    const auto at = [&](int i) { return Enclosure(from + (to - from) * 0.5 * i); };
    const Sides x{at(k % 3), at(k / 3 % 3), at(k / 9)};
    EXPECT_TRUE(explains(f, slopes, x, c)) << k;
    EXPECT_TRUE(explains(f, derivatives, x, c)) << k;
  }
}

const std::vector<std::vector<Term>> kRows{
    {{"1", {{0, 2}}}},
    {{"1", {{0, 3}}}},
    {{"1", {{0, 4}}}},
    {{"1", {{0, 1}, {1, 1}}}},
    {{"1", {{0, 1}, {1, 1}, {2, 1}}}},
    {{"1", {{0, 2}, {1, 1}}}, {"-3", {{1, 1}, {2, 1}}}},
    {{"1", {{0, 1, Function::sine}}}},
    {{"1", {{0, 1, Function::cosine}}}},
};

TEST(Rows, HaveSlopesAndDerivativesThatHoldForEveryPoint) {
  for (const auto& terms : kRows) {
    expect_slopes(terms, 0, 2, 0.5);
    expect_slopes(terms, 1, 3, 2);
    expect_slopes(terms, -1, 1, 0);
    expect_slopes(terms, 1, 1.5, 0);  // a centre outside
    expect_slopes(terms, 1, 1, 0);
  }
}

TEST(Rows, DeleteNoBoxThatAnInequalityHoldsInPartOf) {
  Sides x{{-1, 1}, 0.0, 0.0};
  ASSERT_TRUE(row({{"1", {{0, 1}}}}).project(x, false));
  EXPECT_TRUE(holds(x[0], 0) && holds(x[0], 1));
  x[0] = {0, 2};
  ASSERT_TRUE(row({{"1", {}}, {"-1", {{0, 1}}}}).project(x, false));
  EXPECT_TRUE(holds(x[0], 0) && holds(x[0], 1)) << "1 - x is not 0 but at least that";
}

// (x − y)² ≥ 1/4, written out: by its slopes, and no point that satisfies it is lost.
TEST(Rows, ProjectAConditionByItsSlopes) {
  const Row f = row({{"1", {{0, 2}}}, {"-2", {{0, 1}, {1, 1}}}, {"1", {{1, 2}}}, {"-1/4", {}}});
  Sides close{Enclosure(5.0, 5.25), Enclosure(5.0, 5.25), Enclosure(0.0)};
  EXPECT_FALSE(f.project(close, false));
  Sides apart{Enclosure(5.0, 5.25), Enclosure(5.25, 5.625), Enclosure(0.0)};
  ASSERT_TRUE(f.project(apart, false));
  for (const auto& [x, y] : {std::pair{5.0, 5.5}, {5.125, 5.625}, {5.0, 5.625}})
    EXPECT_TRUE(holds(apart[0], x) && holds(apart[1], y)) << x << ' ' << y;
  EXPECT_FALSE(holds(apart[1], 5.25)) << "no x is so far from it";
}

TEST(Rows, ProjectEachVariableWithAllTheOthers) {
  const Row sum = row({{"1", {{0, 1}}}, {"1", {{1, 1}}}, {"1", {{2, 1}}}, {"-6", {}}});
  for (std::size_t j = 0; j < 3; ++j) {
    Sides x{1.0, 2.0, 3.0};
    x[j] = {0, 10};
    ASSERT_TRUE(sum.project(x, true)) << j;
    EXPECT_TRUE(holds(x[j], static_cast<double>(j) + 1)) << j;
    EXPECT_LT(x[j].width(), 1e-9) << j;
  }
  Sides x{{0.1, 10}, {1, 4}, 0.0};
  ASSERT_TRUE(row({{"1", {{0, 1}, {1, 1}}}, {"-1", {}}}).project(x, true));
  EXPECT_TRUE(holds(x[0], 0.25) && holds(x[0], 1)) << "x y = 1";
}

}  // namespace
}  // namespace corank::check
