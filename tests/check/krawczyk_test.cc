// The operator that proves existence and uniqueness, and what it says of other rows.
#include "corank/check/krawczyk.h"

#include <gtest/gtest.h>

#include "corank/tests/check/enclosed_rows.h"
#include "corank/tests/system_builder.h"

namespace corank::check {
namespace {

using Center = Krawczyk::Center;

TEST(Contraction, IsStrictInEveryRow) {
  EXPECT_TRUE(is_contraction(Eigen::MatrixXd{{0.9}}));
  EXPECT_FALSE(is_contraction(Eigen::MatrixXd{{1}}));
  EXPECT_FALSE(is_contraction(Eigen::MatrixXd{{2, 0}, {0, 0.1}}));
  EXPECT_FALSE(is_contraction(Eigen::MatrixXd{{0.1, 0}, {0, 2}}));
}

TEST(Contraction, DoesNotDependOnTheUnitsOfTheRows) {
  EXPECT_TRUE(is_contraction(Eigen::MatrixXd{{0.5, 1e5}, {1e-6, 0.5}})) << "spectral radius 0.82";
  EXPECT_TRUE(is_contraction(Eigen::MatrixXd{{0.5, 1e-6}, {1e5, 0.5}}));
  EXPECT_FALSE(is_contraction(Eigen::MatrixXd{{0.5, 1e5}, {1e-5, 0.5}})) << "spectral radius 1.5";
}

TEST(KrawczyksOperator, DoesNotShowThatASquareIsInjectiveByItsSlopes) {
  const std::vector<Row> square{row({{"1", {{0, 2}}}, {"-1", {}}})};
  Krawczyk newton(square, 1);
  const Sides both{{-0.5, 2}};  // 2 x has a zero in it, the slopes about its middle have none
  ASSERT_TRUE(newton.set({0}, both, Center::middle));
  EXPECT_FALSE(newton.is_injective(both));
  const Sides one{{0.5, 2}};
  ASSERT_TRUE(newton.set({0}, one, Center::middle));
  EXPECT_TRUE(newton.is_injective(one));
}

TEST(KrawczyksOperator, HoldsTheZerosForEveryValueOfTheFreeVariables) {
  const std::vector<Row> line{row({{"1", {{0, 1}}}, {"1", {{1, 1}}}, {"-1", {}}})};  // x + y = 1
  Krawczyk newton(line, 2);
  for (const Sides& x : {Sides{{-1, 4}, {0, 1}}, Sides{{-2, 2}, {0, 1}}}) {
    ASSERT_TRUE(newton.set({0}, x, Center::middle));
    const Enclosure image = newton.image(x)[0];
    EXPECT_TRUE(holds(image, 0) && holds(image, 1));
    EXPECT_LT(image.width(), 1.1);
  }
}

TEST(KrawczyksOperator, ShowsExistenceWhereEachDependentSideHasTheImageInItsInterior) {
  const std::vector<Row> rows{row({{"1", {{0, 1}}}}), row({{"1", {{1, 1}}}, {"-1", {{2, 1}}}})};
  Krawczyk newton(rows, 3);
  const Sides x(3, Enclosure(-1, 1)), narrow(2, Enclosure(-0.5, 0.5));
  ASSERT_TRUE(newton.set({0, 1}, x, Center::middle));
  EXPECT_TRUE(newton.is_inside(narrow, x));
  EXPECT_FALSE(newton.is_inside({narrow[0], x[1]}, x)) << "on the border of the second one";
  EXPECT_FALSE(newton.is_inside({x[0], narrow[1]}, x));
}

TEST(KrawczyksOperator, HoldsTheZerosForEveryChoiceWithinTheTolerance) {
  const std::vector<Row> third{row({{"1", {{0, 1}}}, {"-1/3", {}}}, 0.1)};
  Krawczyk newton(third, 1);
  const Sides x{{0, 1}};
  ASSERT_TRUE(newton.set({0}, x, Center::middle));
  const Enclosure image = newton.image(x)[0];
  EXPECT_TRUE(holds(image, 0.31) && holds(image, 0.36));
}

TEST(KrawczyksOperator, KnowsARowAtTheZeros) {
  const std::vector<Row> equal{row({{"1", {{0, 1}}}, {"-1", {{1, 1}}}})};  // x = y
  Krawczyk newton(equal, 2);
  const Row sum = row({{"1", {{0, 1}}}, {"1", {{1, 1}}}}), own = row({{"1", {{0, 1}}}});
  Sides x{{0, 2}, {0, 1}};
  ASSERT_TRUE(newton.set({0}, x, Center::middle));
  newton.image(x);
  const Enclosure value = newton.value_at_zeros(own, x);
  EXPECT_TRUE(holds(value, 0) && holds(value, 1));
  x[0] = {0.9, 1};  // the zeros at y ∈ [0.9, 1]
  ASSERT_TRUE(newton.set({0}, x, Center::middle));
  newton.image(x);
  EXPECT_TRUE(holds(newton.value_at_zeros(sum, x), 1.8) && holds(newton.value_at_zeros(sum, x), 2));
}

TEST(KrawczyksOperator, HasACentreThatSolvesOnlyWhereItDoesForEveryFreeValue) {
  const std::vector<Row> rows{row({{"1", {{0, 1}}}}), row({{"1", {{1, 1}}}, {"-1", {{2, 1}}}})};  // x = 0, y = z
  Krawczyk newton(rows, 3);
  const Sides x(3, Enclosure(-1, 1));
  ASSERT_TRUE(newton.set({0, 1}, x, Center::middle));
  EXPECT_FALSE(newton.center_solves(x));
  const std::vector<Row> fixed{rows[0], row({{"1", {{1, 1}}}, {"1", {{0, 1}, {2, 1}}}})};
  Krawczyk other(fixed, 3);
  ASSERT_TRUE(other.set({0, 1}, x, Center::middle));
  EXPECT_TRUE(other.center_solves(x)) << "x = y = 0, whatever z is";
}

}  // namespace
}  // namespace corank::check
