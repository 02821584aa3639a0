// Shapes that are known: quadrics and tori, linkages whose C-spaces are in the literature.
#include "corank/analyze/topology/topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/topologies.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::ElementsAre;

Topology of_model(const std::string& name) {
  return of(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik").mechanism);
}

const std::string kSpace = "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\n";

TEST(Topology, KnowsASphere) {
  const Topology t = of_text(kSpace + "x^2+y^2+z^2 = 1;\n");
  EXPECT_TRUE(t.smooth);
  EXPECT_TRUE(t.components.exact());
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_THAT(t.genus, ElementsAre(0));
}

TEST(Topology, KnowsATorus) {
  const Topology t = of_text(kSpace + "(x^2+y^2+z^2+15/16)^2 = 4*(x^2+y^2);\n");  // radii 1 and 1/4
  EXPECT_EQ(t.euler_characteristic, 0);
  EXPECT_THAT(t.genus, ElementsAre(1));
}

TEST(Topology, SaysThatThereIsNoSolution) {
  const study::Question none{.model = study::parse_model({kSpace + "x^2+y^2+z^2 = -1;\n", "none.cuik"}).mechanism};
  const std::string text = to_text(none, of(none.model));
  EXPECT_THAT(text, testing::HasSubstr("there is no solution in the search domain"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("components")));
}

// A sphere beside a torus about it.
TEST(Topology, TellsTheComponentsApart) {
  const Topology t = of_text(kSpace + "((x^2+y^2+z^2+15/16)^2 - 4*(x^2+y^2))*(x^2+y^2+z^2-1/16) = 0;\n");
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 2);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_THAT(t.genus, ElementsAre(0, 1));
}

// The critical points' equations have sin x times a multiplier.
TEST(Topology, CountsComponentsWhereNoCriticalPointsCanBeHad) {
  const Topology t =
      of_text("[SYSTEM VARS]\nx : [-2, 8]\ny : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\n2*(1 - cos(x)) + y^2 + z^2 = 1/4;\n");
  EXPECT_TRUE(t.smooth);
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 2);
  EXPECT_FALSE(t.euler_characteristic);
  EXPECT_THAT(t.reason, testing::HasSubstr("the equations of critical points are not polynomials"));
}

TEST(Topology, KnowsASurfaceOfGenusTwo) {
  const Topology t = of_text(kSpace + "(x^2*(1-x^2)-y^2)^2 + z^2 = 1/25;\n");
  EXPECT_EQ(t.euler_characteristic, -2);
  EXPECT_THAT(t.genus, ElementsAre(2));
}

TEST(Topology, CountsTwoLinkedCircles) {
  const Topology t = of_text(
      "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\nw : [-3, 3]\n[SYSTEM EQS]\nw^2 = 1;\n"
      "(1+w)*(x^2+y^2-1) + (1-w)*((x-1)^2+z^2-1) = 0;\n(1+w)*z + (1-w)*y = 0;\n");
  EXPECT_EQ(t.dimension, 1);
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 2);
  EXPECT_EQ(t.euler_characteristic, 0);
}

// Two sheets of a hyperboloid in a cube: the set has an edge there, and is two disks.
TEST(Topology, CountsThePiecesOfASetWithAnEdge) {
  const Topology t = of_text(kSpace + "x^2+y^2-z^2 = -1;\n");
  EXPECT_FALSE(t.smooth);
  EXPECT_EQ(t.euler_characteristic, 2);
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 2);
  EXPECT_FALSE(t.ends.empty());
}

// A circle leaves the rectangle through three of its sides and comes near the fourth: an arc there, two small ones at the
// corners.
TEST(Topology, CountsTheArcsOfACircleInARectangle) {
  const Topology t = of_text("[SYSTEM VARS]\nx : [-3, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2+y^2 = 6;\n");
  EXPECT_FALSE(t.smooth);
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 3);
  EXPECT_THAT(t.ends, testing::UnorderedElementsAre("upper end of x", "lower end of y", "upper end of y"));
}

// The ranges of the end's position are declared or found wider than the arm reaches: they cut nothing off. One joint is
// held.
TEST(Topology, OfAnArmWithAHeldJointIsATorus) {
  const Topology t = of_model("serial/orthogonal_3r");
  EXPECT_TRUE(t.smooth) << t.reason;
  EXPECT_EQ(t.genus, std::vector<int>{1});
}

// Three loops: a critical point has 6 multipliers, whose directions say nothing before the configuration is narrow.
TEST(Topology, OfADoubleButterflyIsTwoClosedCurves) {
  const Topology t = of_model("planar/double_butterfly");
  EXPECT_EQ(t.dimension, 1);
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 2);
  EXPECT_EQ(t.euler_characteristic, 0) << t.reason;
  ASSERT_FALSE(t.heights.empty());
  for (const HeightCount& height : t.heights) {
    ASSERT_EQ(height.by_index.size(), 2u);
    EXPECT_EQ(height.by_index[0], height.by_index[1]);
    EXPECT_GE(height.by_index[0], 2);
  }
}

// By the count of its joints either is a set of points, but a curve runs through boxes that stay undecided: two chairs of
// cyclohexane and its boats are three pieces.
TEST(Topology, ClaimsNoNumberOfPointsWhereBoxesAreUndecided) {
  for (const char* name : {"spatial/cyclohexane", "spatial/bennett"}) {
    const Topology t = of_model(name);
    EXPECT_EQ(t.components.at_most, std::nullopt) << name;
    EXPECT_EQ(t.euler_characteristic, std::nullopt) << name;
    EXPECT_NE(t.reason.find("boxes that are not proven to hold one point"), std::string::npos) << t.reason;
  }
}

// Two circles that cross: no manifold.
TEST(Topology, SaysNothingOfCurvesThatCross) {
  const Topology t = of_text("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\n(x^2+y^2-1)*((x-1)^2+y^2-1) = 0;\n");
  EXPECT_FALSE(t.smooth);
  EXPECT_FALSE(t.euler_characteristic);
}

TEST(Topology, CountsIsolatedPoints) {
  const Topology t = of_text("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2 = 2;\ny^2 = 3;\n");
  EXPECT_EQ(t.dimension, 0);
  ASSERT_TRUE(t.components.exact());
  EXPECT_EQ(t.components.at_least, 4);
}

TEST(Topology, OfDextarIsASurfaceOfGenusFour) {
  const Topology t = of_model("dextar");
  EXPECT_TRUE(t.components.exact());
  EXPECT_EQ(t.euler_characteristic, -6);
  EXPECT_THAT(t.genus, ElementsAre(4));
  ASSERT_EQ(t.heights.size(), 2u);
}

TEST(Topology, OfTheThreeSlidersIsTwoCurvesOrOneThatCrossesItself) {
  const Topology t = of_model("three_slider");
  ASSERT_TRUE(t.components.exact());
  EXPECT_EQ(t.components.at_least, 2);
  symbolic::Mechanism equal = symbolic::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik");
  equal.set_constant("L2", 1);
  EXPECT_FALSE(of(equal).smooth);
}

// Dimensions of the homology of the C-space of a planar pentagon with these sides, by the count of short sets of sides
// that hold the longest one: b_k = a_k + a_(2−k) (Farber, Schütz, "Homology of planar polygon spaces", Geom. Dedicata 125,
// 2007). Its components are b_0.
std::array<int, 3> betti_numbers(const std::vector<int>& sides) {
  const auto longest = std::max_element(sides.begin(), sides.end()) - sides.begin();
  int all = 0;
  for (const int side : sides) all += side;
  std::array<int, 5> a{};
  for (unsigned set = 0; set < 32; ++set) {
    if ((set >> longest & 1U) == 0) continue;
    int sum = 0, size = 0;
    for (unsigned i = 0; i < 5; ++i)
      if ((set >> i & 1U) != 0) sum += sides[i], ++size;
    if (2 * sum < all) ++a[static_cast<std::size_t>(size - 1)];
  }
  return {a[0] + a[2], 2 * a[1], a[2] + a[0]};
}

std::string pentagon(const std::vector<int>& sides) {
  std::string text = "[SYSTEM VARS]\n", x, y;
  for (int i = 0; i < 4; ++i) {
    const std::string angle = "t" + std::to_string(i), side = std::to_string(sides[static_cast<std::size_t>(i)]) + "/100";
    text += angle + " ~ [-pi, pi]\n";
    x += (i ? " + " : "") + side + "*cos(" + angle + ")";
    y += (i ? " + " : "") + side + "*sin(" + angle + ")";
  }
  return text + "[SYSTEM EQS]\n" + x + " = " + std::to_string(sides[4]) + "/100;\n" + y + " = 0;\n";
}

TEST(Topology, OfPentagonsInEveryChamberIsTheKnownOne) {
  // Genus 4, 3, 2, 1, 0 and two tori: all that there are.
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{{100, 101, 102, 103, 104},
                                                                     {100, 101, 102, 103, 210},
                                                                     {100, 101, 202, 303, 404},
                                                                     {100, 103, 202, 307, 317},
                                                                     {100, 101, 102, 103, 304},
                                                                     {300, 301, 302, 103, 104}}) {
    const auto b = betti_numbers(sides);
    const Topology t = of_text(pentagon(sides));
    SCOPED_TRACE(pentagon(sides));
    ASSERT_TRUE(t.components.exact()) << t.components.reason;
    EXPECT_EQ(t.components.at_least, b[0]);
    EXPECT_EQ(t.euler_characteristic, b[0] - b[1] + b[2]);
    EXPECT_EQ(std::accumulate(t.genus.begin(), t.genus.end(), 0), b[1] / 2);
  }
}

// No number may be wrong; bounds may be apart, seldom.
TEST(Topology, OfRandomPentagonsIsTheKnownOne) {
  std::mt19937 random(20261122);
  std::uniform_int_distribution<int> side(50, 300);
  int known = 0;
  const int all = test::long_run() ? 12 : 4;
  for (int k = 0; k < all; ++k) {
    std::vector<int> sides;
    for (int i = 0; i < 5; ++i) sides.push_back(side(random));
    const auto b = betti_numbers(sides);
    SCOPED_TRACE(pentagon(sides));
    const Topology t = of_text(pentagon(sides));
    EXPECT_LE(t.components.at_least, b[0]);
    EXPECT_GE(t.components.at_most.value_or(b[0]), b[0]);
    if (!t.euler_characteristic) continue;
    EXPECT_EQ(t.euler_characteristic, b[0] - b[1] + b[2]);
    known += t.components.exact();
  }
  EXPECT_GE(known, all - 1);
}

}  // namespace
}  // namespace corank::analyze
