// A tube on the unit circle, whose "singularities" are where x = 0; and signs of determinants.
#include "corank/certify/tube.h"

#include <gtest/gtest.h>

#include <cmath>

#include "corank/certify/inertia.h"
#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

class TubeOnACircle : public ::testing::Test {
 protected:
  TubeOnACircle() {
    x_ = builder_.variable("x", "-2", "2");
    y_ = builder_.variable("y", "-2", "0.9");
    builder_.equation({{"1", {{x_, 2}}}, {"1", {{y_, 2}}}, {"-1", {}}});
    PolynomialMatrix matrix{1, 1, {test::SystemBuilder::polynomial({{"1", {{x_, 1}}}})}};
    prover_.emplace(builder_.system(), std::vector{matrix}, std::vector{1});
  }
  // At the angle, T the tangent there.
  TubeNode node(double angle) {
    TubeNode node{{-std::sin(angle), std::cos(angle)}, {0.0}, {}};
    node.values[0] = node.rows[0] * std::cos(angle) + node.rows[1] * std::sin(angle);
    node.box = prover_->node(node.rows, node.values, {std::cos(angle), std::sin(angle)}).value();
    return node;
  }

  int x_ = 0, y_ = 0;
  test::SystemBuilder builder_;
  std::optional<TubeProver> prover_;
  UpwardRounding rounding_;
};

TEST_F(TubeOnACircle, HasPiecesThatHoldTheirNodes) {
  const TubeNode a = node(0.1), b = node(0.3);
  const std::optional<Box> piece = prover_->piece(a, b);
  ASSERT_TRUE(piece.has_value());
  for (int j = 0; j < 2; ++j)
    for (const TubeNode* n : {&a, &b}) EXPECT_TRUE((*piece)[j].contains(n->box[j]));
  for (double angle = 0.1; angle <= 0.3; angle += 0.01) {
    EXPECT_TRUE((*piece)[0].contains(std::cos(angle)));
    EXPECT_TRUE((*piece)[1].contains(std::sin(angle)));
  }
}

TEST_F(TubeOnACircle, HasNoPieceThatMissesANodesBox) {
  const TubeNode a = node(0.1), b = node(0.3);
  TubeNode wide = a;
  wide.box[1] = Interval(-0.5, 0.5);
  EXPECT_FALSE(prover_->piece(wide, b).has_value());
  wide = b;
  wide.box[1] = Interval(-0.5, 0.5);
  EXPECT_FALSE(prover_->piece(a, wide).has_value());
}

// Opposite tangents: halfway T vanishes.
TEST_F(TubeOnACircle, HasNoPieceBetweenOppositePoints) {
  EXPECT_FALSE(prover_->piece(node(0), node(std::acos(-1.0))).has_value());
}

TEST_F(TubeOnACircle, IsFreeAsFarAsTheMatrixHasItsRankAndTheDomainReaches) {
  const Box box{Interval(0.75, 0.8), Interval(0.6, 0.65)};
  EXPECT_TRUE(prover_->is_free(box, 0.24, {1, 1}));
  EXPECT_FALSE(prover_->is_free(box, 0.26, {1, 1})) << "y reaches 0.9";
  const Box lower{Interval(0.25, 0.3), Interval(-0.97, -0.95)};
  EXPECT_TRUE(prover_->is_free(lower, 0.24, {1, 1}));
  EXPECT_FALSE(prover_->is_free(lower, 0.25, {1, 1})) << "x reaches 0";
  EXPECT_TRUE(prover_->is_free(lower, 0.024, {10, 1}));
  EXPECT_FALSE(prover_->is_free(lower, 0.025, {10, 1}));
}

TEST_F(TubeOnACircle, IsJoinedToPointsOfTheSamePieceAlone) {
  const Box whole{Interval(-2, 2), Interval(-2, 2)};
  EXPECT_TRUE(prover_->joins(node(0.5).box, node(0.5 + 1e-8).box, whole));
  EXPECT_FALSE(prover_->joins(node(0.5).box, node(-0.5).box, whole));
  const Box elsewhere{Interval(0.9, 1), Interval(-2, 2)};
  EXPECT_FALSE(prover_->joins(node(0.5).box, node(0.5 + 1e-8).box, elsewhere));
}

IntervalMatrix matrix(int n, const std::vector<Interval>& entries) {
  IntervalMatrix a(n, n);
  a.entries = entries;
  return a;
}

TEST(DeterminantSign, CountsTheExchangesOfRowsAndColumns) {
  const UpwardRounding rounding;
  EXPECT_EQ(determinant_sign(matrix(2, {1.0, 0.0, 0.0, 1.0})), 1);
  EXPECT_EQ(determinant_sign(matrix(2, {0.0, 1.0, 1.0, 0.0})), -1);
  EXPECT_EQ(determinant_sign(matrix(2, {1.0, 2.0, 3.0, 4.0})), -1);
  EXPECT_EQ(determinant_sign(matrix(2, {-1.0, 2.0, 3.0, 4.0})), -1);
  EXPECT_EQ(determinant_sign(matrix(2, {-1.0, 0.0, 0.0, -2.0})), 1);
  EXPECT_EQ(determinant_sign(matrix(3, {0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0})), 1);
  EXPECT_EQ(determinant_sign(matrix(3, {2.0, 0.0, 1.0, 0.0, -3.0, 0.0, 1.0, 0.0, 1.0})), -1);
}

TEST(DeterminantSign, IsUnknownWhereAMatrixMayBeSingular) {
  const UpwardRounding rounding;
  EXPECT_EQ(determinant_sign(matrix(1, {Interval(0, 1)})), 0);
  EXPECT_EQ(determinant_sign(matrix(2, {Interval(1, 1), Interval(2, 2), Interval(2, 2), Interval(3.9, 4.1)})), 0);
  EXPECT_EQ(determinant_sign(matrix(2, {Interval(1, 1), Interval(2, 2), Interval(2, 2), Interval(4.1, 4.2)})), 1);
}

}  // namespace
}  // namespace corank::certify
