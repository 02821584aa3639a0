// How large a kernel is anywhere in a box, at most.
#include "corank/certify/kernel_bound.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// M(x) = [x 1 0; −1 x 0; 0 0 x + 1]: the block is regular for every x, the entry where x ≠ −1.
class KernelBoundOfABlock : public ::testing::Test {
 protected:
  KernelBoundOfABlock() {
    const int x = builder_.variable("x", "-2", "2");
    int xi[3];
    for (int k = 0; k < 3; ++k) xi[k] = builder_.variable("xi" + std::to_string(k + 1), "-1", "1", VariableKind::kernel);
    builder_.equation({{"1", {{x, 1}, {xi[0], 1}}}, {"1", {{xi[1], 1}}}});
    builder_.equation({{"-1", {{xi[0], 1}}}, {"1", {{x, 1}, {xi[1], 1}}}});
    builder_.equation({{"1", {{x, 1}, {xi[2], 1}}}, {"1", {{xi[2], 1}}}});
  }
  int at_most(double lower, double upper, int halvings) const {
    const Interval unit(-1, 1);
    return KernelBound(builder_.system()).at_most({Interval(lower, upper), unit, unit, unit}, halvings);
  }

  test::SystemBuilder builder_;
  UpwardRounding rounding_;
};

TEST_F(KernelBoundOfABlock, IsTheLargestOfItsHalves) {
  EXPECT_EQ(at_most(-1.5, 1.5, 0), 2) << "too wide for more than one pivot";
  EXPECT_EQ(at_most(-1.5, 1.5, 1), 1) << "the lower half holds -1, the upper one nothing";
  EXPECT_EQ(at_most(-2.5, 0.3, 1), 1) << "the upper half holds -1, the lower one nothing";
  EXPECT_EQ(at_most(-1.5, 0, 0), 1);
  EXPECT_EQ(at_most(0, 1.5, 0), 0);
  EXPECT_EQ(at_most(-1.0, -1.0, 0), 1) << "never less than there is";
}

// The largest kernel of a matrix of the test, x in the interval.
int at_most(const std::vector<std::vector<std::vector<test::SystemBuilder::Term>>>& matrix, Interval x) {
  test::SystemBuilder b;
  b.variable("x", "-2", "2");
  std::vector<Interval> box{x};
  for (std::size_t k = 0; k < matrix[0].size(); ++k) {
    b.variable("xi" + std::to_string(k), "-1", "1", VariableKind::kernel);
    box.emplace_back(-1, 1);
  }
  for (const auto& row : matrix) {
    std::vector<test::SystemBuilder::Term> terms;
    for (std::size_t k = 0; k < row.size(); ++k)
      for (auto [c, factors] : row[k]) {
        factors.push_back({static_cast<int>(k) + 1, 1});
        terms.emplace_back(c, factors);
      }
    b.equation(terms);
  }
  const UpwardRounding rounding;
  return KernelBound(b.system()).at_most(box);
}

TEST(KernelBound, AddsUpTheEntriesOfARow) {
  // [1 + x, x; x, 1 + x] is singular at −1/2; over [−0.6, 0.6] I − M has no entry above 0.6, but rows of 1.2.
  const std::vector<test::SystemBuilder::Term> one_and_x{{"1", {}}, {"1", {{0, 1}}}}, x{{"1", {{0, 1}}}};
  EXPECT_GE(at_most({{one_and_x, x}, {x, one_and_x}}, {-0.6, 0.6}), 1);
  EXPECT_EQ(at_most({{one_and_x, x}, {x, one_and_x}}, {-0.4, 0.4}), 0);
}

TEST(KernelBound, CountsColumns) {
  const std::vector<test::SystemBuilder::Term> one{{"1", {}}}, none, x{{"1", {{0, 1}}}};
  EXPECT_EQ(at_most({{one, none, x}, {none, one, x}}, {-1, 1}), 1) << "two rows of three columns";
  EXPECT_EQ(at_most({{one, none}, {none, one}, {x, x}}, {-1, 1}), 0) << "three of two";
}

TEST(KernelBound, PicksASubmatrixByItsRowsAndColumns) {
  // Regular are the last row and the last column; the rest is 0 at x = 0.
  const std::vector<test::SystemBuilder::Term> five{{"5", {}}}, x{{"1", {{0, 1}}}};
  EXPECT_EQ(at_most({{x, x}, {x, five}}, {-1, 1}), 1);
  const std::vector<test::SystemBuilder::Term> three{{"3", {}}}, none;
  EXPECT_EQ(at_most({{none, three, x}, {x, none, five}, {x, x, none}}, {-0.1, 0.1}), 1);
}

TEST(KernelBound, MultipliesByTheInverseFromTheLeft) {
  const std::vector<test::SystemBuilder::Term> one{{"1", {}}}, ten{{"10", {}}}, none, small{{"1/100", {{0, 1}}}};
  EXPECT_EQ(at_most({{one, ten}, {small, one}}, {-1, 1}), 0);
}

TEST(KernelBound, IsRefusedInAnotherRoundingMode) {
  test::SystemBuilder b;
  b.variable("xi", "-1", "1", VariableKind::kernel);
  b.equation({{"1", {{0, 1}}}});
  const KernelBound bound(b.system());
  EXPECT_THROW(bound.at_most({Interval(-1, 1)}), std::logic_error);
  const UpwardRounding rounding;
  EXPECT_EQ(bound.at_most({Interval(-1, 1)}), 0);
}

}  // namespace
}  // namespace corank::certify
