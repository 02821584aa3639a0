// The checker's view of tubes, on the unit circle, whose "singularities" are where x = 0.
#include "corank/check/tube.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corank/tests/system_builder.h"

namespace corank::check {
namespace {

using ::testing::HasSubstr;

class TubeCheckOnACircle : public ::testing::Test {
 protected:
  TubeCheckOnACircle() {
    x_ = builder_.variable("x", "-2", "2");
    y_ = builder_.variable("y", "-2", "0.9");
    builder_.equation({{"1", {{x_, 2}}}, {"1", {{y_, 2}}}, {"-1", {}}});
    matrix_ = {1, 1, {test::SystemBuilder::polynomial({{"1", {{x_, 1}}}})}};
    tube_.nodes = {node(0), node(0.2), node(0.4)};
    tube_.pieces = {piece(0, 0.2), piece(0.2, 0.4)};
    tube_.radii = {0.1, 0.1};
    tube_.sizes = {1, 1};
  }
  static Interval about(double x, double r) { return {x - r, x + r}; }
  static TubeNode node(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {{-s, c}, {-s * c + c * s}, {about(c, 1e-9), about(s, 1e-9)}};
  }
  static Box piece(double from, double to) {
    return {{std::cos(to) - 0.02, std::cos(from) + 0.02}, {std::sin(from) - 0.02, std::sin(to) + 0.02}};
  }
  std::string problem() const {
    const TubeReport report = check_tube(builder_.system(), {matrix_}, tube_);
    EXPECT_EQ(report.verified(), report.failures.empty());
    return report.failures.empty() ? "" : report.failures.front();
  }

  int x_ = 0, y_ = 0;
  test::SystemBuilder builder_;
  PolynomialMatrix matrix_;
  Tube tube_;
};

TEST_F(TubeCheckOnACircle, ConfirmsWhatIsTrue) {
  EXPECT_EQ(problem(), "");
  const TubeReport report = check_tube(builder_.system(), {matrix_}, tube_);
  EXPECT_EQ(report.nodes, 3U);
  EXPECT_EQ(report.pieces, 2U);
}

TEST_F(TubeCheckOnACircle, RefusesANodeThatIsNotInItsBox) {
  tube_.nodes[1].box[1] = Interval(std::sin(0.2) + 1e-10, std::sin(0.2) + 1e-9);
  EXPECT_THAT(problem(), HasSubstr("node 2: no solution"));
}

TEST_F(TubeCheckOnACircle, RefusesANodeThatIsNotInItsPiece) {
  const std::vector<TubeNode> nodes = tube_.nodes;
  const Interval narrow(std::sin(0.2) - 0.02, std::sin(0.4) + 1e-10);
  tube_.pieces[1][1] = narrow;
  EXPECT_THAT(problem(), HasSubstr("piece 2: a node's box"));
  tube_.pieces[1] = piece(0.2, 0.4);
  tube_.pieces[1][1] = Interval(std::sin(0.2) - 1e-10, narrow.hi() + 0.02);
  EXPECT_THAT(problem(), HasSubstr("piece 2: a node's box"));
}

TEST_F(TubeCheckOnACircle, RefusesAPieceThatItsLiftLeaves) {
  tube_.nodes = {node(-0.4), node(0.4)};  // between them x reaches 1
  tube_.pieces = {{{std::cos(0.4) - 0.02, 0.99}, {-0.42, 0.42}}};
  tube_.radii = {0};
  EXPECT_THAT(problem(), HasSubstr("piece 1: no lift"));
}

TEST_F(TubeCheckOnACircle, RefusesAPieceWithAnotherLift) {
  tube_.nodes = {node(0), node(0.1)};
  tube_.pieces = {{{-1.1, 1.1}, {-0.1, 0.2}}};  // (−1, 0), too
  tube_.radii = {0};
  EXPECT_THAT(problem(), HasSubstr("piece 1: "));
}

TEST_F(TubeCheckOnACircle, RefusesARadiusThatReachesASingularity) {
  tube_.radii[1] = std::cos(0.4) - 0.02;
  EXPECT_NE(problem(), "");
  tube_.pieces = {piece(0, 0.2), piece(0.2, 0.4)};
  builder_ = {};
  x_ = builder_.variable("x", "-2", "2");
  y_ = builder_.variable("y", "-2", "2");
  builder_.equation({{"1", {{x_, 2}}}, {"1", {{y_, 2}}}, {"-1", {}}});
  EXPECT_THAT(problem(), HasSubstr("piece 2: a singularity"));
  tube_.radii[1] = 0.9 * (std::cos(0.4) - 0.02);
  EXPECT_EQ(problem(), "");
}

TEST_F(TubeCheckOnACircle, RefusesARadiusThatLeavesTheDomain) {
  tube_.radii[1] = 0.9 - std::sin(0.4) - 0.02 + 1e-6;
  EXPECT_THAT(problem(), HasSubstr("piece 2: a range"));
  tube_.radii[1] -= 2e-6;
  EXPECT_EQ(problem(), "");
}

TEST_F(TubeCheckOnACircle, RefusesAnInequalityThatDoesNotHold) {
  builder_.at_least_zero({{"1", {{x_, 1}}}, {"-0.95", {}}});
  EXPECT_THAT(problem(), HasSubstr("an inequality"));
}

// In y the radius reaches as far as its size says.
TEST_F(TubeCheckOnACircle, TakesTheRadiusTimesTheSizeOfEachVariable) {
  const double room = 0.9 - std::sin(0.4) - 0.02;  // to the end of the domain, for the piece's y
  tube_.radii = {0, room / 8};
  tube_.sizes = {1e-3, 8 - 1e-6};
  EXPECT_EQ(problem(), "");
  tube_.sizes[1] = 8 + 1e-6;
  EXPECT_THAT(problem(), HasSubstr("a range"));
}

// A row of zeros, such as ties leave, asks for no rank.
TEST_F(TubeCheckOnACircle, AsksForNoMoreRankThanThereAreRows) {
  matrix_ = {2, 2, {}};
  matrix_.entries = {
      test::SystemBuilder::polynomial({{"1", {{x_, 1}}}}), test::SystemBuilder::polynomial({{"1", {}}}), {}, {}};
  EXPECT_EQ(problem(), "");
}

TEST_F(TubeCheckOnACircle, RefusesWhatHasNotTheSizes) {
  const Tube right = tube_;
  const auto refused = [&](const char* words) {
    EXPECT_THAT(problem(), HasSubstr(words));
    tube_ = right;
  };
  tube_.pieces.pop_back();
  refused("one piece");
  tube_.radii.push_back(0);
  refused("one radius");
  tube_.radii[0] = -1e-300;
  refused("not a length");
  tube_.radii[0] = HUGE_VAL;
  refused("not a length");
  tube_.sizes.pop_back();
  refused("one size for each variable");
  tube_.sizes[1] = 0;
  refused("a variable's size");
  tube_.nodes[0].values.push_back(0);
  refused("a node");
  tube_.nodes[0].rows.pop_back();
  refused("a node");
  tube_.nodes[0].rows[0] = NAN;
  refused("a node");
  tube_.nodes[0].values[0] = HUGE_VAL;
  refused("a node");
  tube_.nodes[0].box.pop_back();
  refused("a node");
  tube_.pieces[0].pop_back();
  refused("a piece");
  tube_.pieces[0][0] = Interval::whole();
  refused("a piece");
  tube_ = {};
  refused("a tube has at least two nodes");
  tube_.nodes.resize(1);
  tube_.pieces.clear();
  tube_.radii.clear();
  refused("a tube has at least two nodes");
}

}  // namespace
}  // namespace corank::check
