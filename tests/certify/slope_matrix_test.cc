// Products of a real matrix with interval matrices and vectors: exact on integers, outward on all other numbers.
#include "corank/certify/slope_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// m equations, each linear in all n variables: a full sparsity pattern, entry k of row i belonging to variable k.
CompiledSystem full_system(int m, int n) {
  test::SystemBuilder b;
  for (int j = 0; j < n; ++j) b.variable("x" + std::to_string(j), "-1", "1");
  for (int i = 0; i < m; ++i) {
    std::vector<test::SystemBuilder::Term> terms;
    for (int j = 0; j < n; ++j) terms.push_back({"1", {{j, 1}}});
    b.equation(terms);
  }
  return CompiledSystem(b.system());
}

struct Case {
  int r, n;
  std::vector<double> y;
  std::vector<Interval> sparse, offset, sums;
  std::vector<int> equations, dependent;
};

template <class Number>
Case random_case(std::mt19937& random, Number number) {
  Case c;
  c.r = 1 + static_cast<int>(random() % 7);
  c.n = c.r + static_cast<int>(random() % 3);
  const auto side = [&] {
    const double a = number(), b = number();
    return Interval(std::min(a, b), std::max(a, b));
  };
  for (int k = 0; k < c.r * c.r; ++k) c.y.push_back(number());
  for (int k = 0; k < c.r * c.n; ++k) c.sparse.push_back(side());
  for (int j = 0; j < c.n; ++j) c.offset.push_back(side());
  for (int a = 0; a < c.r; ++a) {
    c.equations.push_back(a);
    c.dependent.push_back(c.n - 1 - a);
    c.sums.push_back(side());
  }
  return c;
}

class PanelTest : public ::testing::Test {
 protected:
  const UpwardRounding rounding_;
  std::mt19937 random_{20261121};
};

TEST_F(PanelTest, IsExactOnIntegers) {
  std::uniform_int_distribution<int> digit(-9, 9);
  for (int trial = 0; trial < 300; ++trial) {
    const Case c = random_case(random_, [&] { return static_cast<double>(digit(random_)); });
    const CompiledSystem system = full_system(c.r, c.n);
    SlopeMatrix matrix;
    matrix.set_matrix(c.y, c.r);
    ASSERT_TRUE(matrix.assign_product(system, c.equations, c.sparse));
    for (int a = 0; a < c.r; ++a)
      for (int j = 0; j < c.n; ++j) {
        Interval expected;
        for (int b = 0; b < c.r; ++b) expected += scale(c.y[a * c.r + b], c.sparse[b * c.n + j]);
        ASSERT_EQ(matrix.at(a, j), expected) << trial;
      }
    for (auto diagonal : {SlopeMatrix::Diagonal::zero, SlopeMatrix::Diagonal::minus_one}) {
      std::vector<Interval> sums = c.sums;
      matrix.accumulate(c.offset.data(), c.dependent, diagonal, sums);
      for (int a = 0; a < c.r; ++a) {
        Interval expected = c.sums[a];
        for (int j = 0; j < c.n; ++j) {
          if (j != c.dependent[a])
            expected += matrix.at(a, j) * c.offset[j];
          else if (diagonal == SlopeMatrix::Diagonal::minus_one)
            expected += (matrix.at(a, j) - Interval(1.0)) * c.offset[j];
        }
        ASSERT_EQ(sums[a], expected) << trial << ": the diagonal is back, too";
      }
    }
  }
}

TEST_F(PanelTest, RoundsOutward) {
  std::uniform_real_distribution<double> real(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const Case c = random_case(random_, [&] { return std::ldexp(real(random_), static_cast<int>(random_() % 20)); });
    const CompiledSystem system = full_system(c.r, c.n);
    SlopeMatrix matrix;
    matrix.set_matrix(c.y, c.r);
    ASSERT_TRUE(matrix.assign_product(system, c.equations, c.sparse));
    // Products of doubles by interval operations that are tested against MPFR: the matrix may be no narrower than what one
    // corner needs.
    for (int a = 0; a < c.r; ++a)
      for (int j = 0; j < c.n; ++j) {
        Interval corner;
        for (int b = 0; b < c.r; ++b) corner += scale(c.y[a * c.r + b], Interval(c.sparse[b * c.n + j].hi()));
        ASSERT_TRUE(matrix.at(a, j).overlaps(corner));
        ASSERT_LE(matrix.at(a, j).lo(), corner.hi());
        ASSERT_GE(matrix.at(a, j).hi(), corner.lo());
      }
    std::vector<Interval> product;
    matrix.multiply(c.sums, product);
    for (int a = 0; a < c.r; ++a) {
      Interval expected;
      for (int b = 0; b < c.r; ++b) expected += scale(c.y[a * c.r + b], c.sums[b]);
      ASSERT_EQ(product[a], expected) << "the same roundings in the same order";
    }
  }
}

// Against interval operations, which are tested against MPFR: the same roundings in the same order.
TEST_F(PanelTest, SubtractsItsRowsAndMeasuresItsDistanceFromTheIdentity) {
  std::uniform_real_distribution<double> real(-1, 1);
  SlopeMatrix matrix;
  for (int trial = 0; trial < 300; ++trial) {
    const Case c = random_case(random_, [&] { return std::ldexp(real(random_), static_cast<int>(random_() % 20)); });
    matrix.set_matrix(c.y, c.r);
    ASSERT_TRUE(matrix.assign_product(full_system(c.r, c.n), c.equations, c.sparse));
    std::vector<double> weights;
    for (int j = 0; j < c.n; ++j) weights.push_back(std::ldexp(1.0 + std::fabs(real(random_)), j % 7 - 3));
    double largest = 0;
    for (int a = 0; a < c.r; ++a) {
      double sum = 0;
      for (int b = 0; b < c.r; ++b)
        sum += weights[c.dependent[b]] * (Interval(a == b ? 1.0 : 0.0) - matrix.at(a, c.dependent[b])).mag();
      largest = std::max(largest, sum / weights[c.dependent[a]]);
      for (const double factor : {real(random_), -0.75, 0.75}) {
        std::vector<Interval> row = c.offset;
        matrix.subtract_row(factor, a, row.data());
        for (int j = 0; j < c.n; ++j) ASSERT_EQ(row[j], c.offset[j] - scale(factor, matrix.at(a, j))) << trial;
      }
    }
    ASSERT_EQ(matrix.distance_from_identity(c.dependent, weights), largest) << trial;
  }
}

TEST_F(PanelTest, TakesEachMatrixThatDiffersFromTheLast) {
  SlopeMatrix matrix;
  std::vector<Interval> product;
  const std::vector<Interval> values = {1.0, 10.0};
  EXPECT_TRUE(matrix.set_matrix({1, 2, 3, 4}, 2));
  EXPECT_TRUE(matrix.set_matrix({1, 2, 3, 4}, 2));
  matrix.multiply(values, product);
  EXPECT_EQ(product, (std::vector<Interval>{21.0, 43.0}));
  EXPECT_TRUE(matrix.set_matrix({1, 2, 3, 5}, 2));
  matrix.multiply(values, product);
  EXPECT_EQ(product, (std::vector<Interval>{21.0, 53.0}));
  EXPECT_TRUE(matrix.set_matrix({1}, 1));
  matrix.multiply(values, product);
  EXPECT_EQ(product, (std::vector<Interval>{1.0}));
}

TEST_F(PanelTest, RefusesWhatIsNotFinite) {
  const CompiledSystem system = full_system(1, 1);
  SlopeMatrix matrix;
  matrix.set_matrix({0.0}, 1);
  EXPECT_TRUE(matrix.assign_product(system, {0}, {Interval(1, 2)}));
  EXPECT_FALSE(matrix.assign_product(system, {0}, {Interval::whole()}));
  matrix.set_matrix({1e300}, 1);
  EXPECT_FALSE(matrix.assign_product(system, {0}, {Interval(-1, 1e300)}));
  for (const double y : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    for (int again = 0; again < 2; ++again) EXPECT_FALSE(matrix.set_matrix({y}, 1));
}

TEST_F(PanelTest, AnEntryThatLeavesTheRangeOfDoublesIsWithoutBounds) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  SlopeMatrix matrix;
  matrix.set_matrix({1.0}, 1);
  for (const Interval& entry : {Interval(-kLargest, 1), Interval(-kLargest, kLargest)}) {
    ASSERT_TRUE(matrix.assign_product(full_system(1, 1), {0}, {entry}));
    for (const Interval& offset : {Interval(0, 1), Interval(-1, 0), Interval(0.0), Interval(-1, 1)}) {
      std::vector<Interval> sums{Interval(0.0)};
      matrix.accumulate(&offset, {0}, SlopeMatrix::Diagonal::minus_one, sums);
      EXPECT_FALSE(std::isnan(sums[0].lo()) || std::isnan(sums[0].hi())) << offset;
      for (const double x : {offset.lo(), offset.hi()}) {
        EXPECT_TRUE(x == 0 || sums[0].contains((entry.lo() - 1) * x)) << offset;
        EXPECT_TRUE(sums[0].contains(0.5 * x)) << offset;
      }
    }
  }
}

}  // namespace
}  // namespace corank::certify
