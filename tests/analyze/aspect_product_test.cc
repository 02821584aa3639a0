// Aspects where free coordinates give all others: of arms, and of robots whose inputs are functions of their pose.
#include "corank/analyze/aspects/aspects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "corank/result/values/claim_files.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/free_coordinates.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Names = std::vector<std::string>;

symbolic::Mechanism product_model(const std::string& name) {
  return study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik").mechanism;
}

// Three angles, and three lengths that are functions of them; `functions`: "sin(a + b)".
symbolic::Mechanism planted_arm(const std::array<std::string, 3>& functions, const std::string& range_of_x = "[-9, 9]") {
  std::string text = "[SYSTEM VARS]\na ~ [-pi, pi]\nb ~ [-pi, pi]\nc ~ [-pi, pi]\nx : " + range_of_x +
                     "\ny : [-9, 9]\nz : [-9, 9]\n[SYSTEM EQS]\n";
  for (std::size_t k = 0; k < 3; ++k) text += std::string(1, "xyz"[k]) + " = " + functions.at(k) + ";\n";
  return symbolic::parse_model(text + "[INPUTS] a, b, c\n[OUTPUTS] x, y, z\n", "arm.cuik");
}

Aspects counted(const symbolic::Mechanism& mechanism, bool certificate = false) {
  solve::Control control;
  AspectsOptions options;
  options.certificate = certificate;
  return aspects({.model = mechanism}, options, control);
}

Names coordinates_of(const AspectsPart& part) { return part.coordinates; }

void expect_product_verified(const symbolic::Mechanism& mechanism, const Aspects& a) {
  const result::PiecesFile file = to_file({.model = mechanism}, a);
  const check::PiecesReport report = result::verify(file);
  EXPECT_TRUE(report.covered()) << result::to_table(report, file);
  EXPECT_EQ(report.complete(), a.aspects.at_most.has_value()) << result::to_table(report, file);
  ASSERT_EQ(report.lists.size(), 3U);
  EXPECT_EQ(report.lists[0].at_least, a.aspects.at_least);
  EXPECT_EQ(report.lists[0].at_most, a.aspects.at_most);
}

// Both bounds are right; the upper one may be larger than the number.
void expect_number(const Aspects& a, int number, const std::string& of) {
  EXPECT_EQ(a.aspects.at_least, number) << of;
  EXPECT_GE(a.aspects.at_most.value_or(number), number) << of;
}

// Shoulder and elbow divide the torus of joints 2 and 3 into 4 pieces, the wrist the circle of joint 5 into 2.
TEST(AspectProduct, OfAPumaAreEight) {
  const symbolic::Mechanism puma = product_model("serial/puma_560");
  const Aspects a = counted(puma, true);
  EXPECT_EQ(a.aspects.at_least, 8);
  EXPECT_EQ(a.aspects.at_most, 8);
  EXPECT_EQ(a.working_modes.at_most, 8);
  EXPECT_EQ(a.assembly_modes.at_most, 1);
  ASSERT_EQ(a.product_of.size(), 2U);
  EXPECT_THAT(coordinates_of(a.product_of[0]), ElementsAre("theta2", "theta3"));
  EXPECT_THAT(coordinates_of(a.product_of[1]), ElementsAre("theta5"));
  ASSERT_EQ(a.determinant_signs.size(), 8U);
  for (const auto& [y, z] : a.determinant_signs) {
    EXPECT_NE(y, 0);
    EXPECT_NE(z, 0);
  }
  EXPECT_THAT(to_text({.model = puma}, a), HasSubstr("a product of    theta2, theta3: 4"));
  expect_product_verified(puma, a);
}

// All three of its parallel axes take part in the shoulder's singularity: a crossing of two loci along closed curves.
TEST(AspectProduct, OfAUr5AreEight) {
  const symbolic::Mechanism ur5 = product_model("serial/ur5");
  const Aspects a = counted(ur5, true);
  EXPECT_EQ(a.aspects.at_least, 8);
  EXPECT_EQ(a.aspects.at_most, 8);
  ASSERT_EQ(a.product_of.size(), 2U);
  EXPECT_THAT(coordinates_of(a.product_of[0]), ElementsAre("theta2", "theta3", "theta4"));
  expect_product_verified(ur5, a);
}

// Husty 2009, Coste 2012.
TEST(AspectProduct, OfAPlanarPlatformInAllItsPosesAreTwo) {
  const Aspects a = counted(product_model("planar/3rpr_pose"));
  EXPECT_EQ(a.aspects.at_least, 2);
  EXPECT_EQ(a.aspects.at_most, 2);
  EXPECT_EQ(a.limits.size(), 4U);
}

TEST(AspectProduct, IsNotTakenOfClosureEquations) {
  EXPECT_FALSE(symbolic::free_coordinates(product_model("dextar")));
  EXPECT_TRUE(counted(product_model("dextar")).product_of.empty());
}

// cos(a + k b) = 0, cos(b − m c) = 0 and cos(n c) = 0 are closed surfaces. In the angles u = a + k b, v = b − m c and c,
// which are angles of the same torus, they are two planes, two, and 2n: 2·2·2n boxes.
TEST(AspectProduct, OfPlantedPlanesAreTheirBoxes) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> multiple(0, 1), harmonic(1, 2);
  for (unsigned trial = 0; trial < test::seeds(3); ++trial) {
    const std::string k = std::to_string(multiple(random)), m = std::to_string(multiple(random));
    const int n = harmonic(random);
    const symbolic::Mechanism planted =
        planted_arm({"sin(a + " + k + "*b + 1/3)", "sin(b - " + m + "*c + 1/5)", "sin(" + std::to_string(n) + "*c + 1/7)"});
    const Aspects a = counted(planted);
    expect_number(a, 8 * n, k + " " + m + " " + std::to_string(n));
    EXPECT_TRUE(a.aspects.exact() || a.product_of.size() == 1);
  }
}

// x = a³/3 + a (b² + c² − r²) has ∂x/∂a = a² + b² + c² − r²: a sphere in a cube of edge 2. Of radius r < √2 it leaves
// what is in it and what is outside, which hangs together along the cube's edges; above, eight corners.
TEST(AspectProduct, OfAPlantedSphereInACubeAreKnown) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> percent(40, 165);
  for (unsigned trial = 0; trial < test::seeds(4); ++trial) {
    const int r = percent(random);
    if (std::abs(r - 100) < 5 || std::abs(r - 141) < 5) continue;  // next to where the number changes
    const std::string square = std::to_string(r * r) + "/10000";
    const symbolic::Mechanism planted = symbolic::parse_model(
        "[SYSTEM VARS]\na : [-1, 1]\nb : [-1, 1]\nc : [-1, 1]\nx : [-9, 9]\ny : [-9, 9]\nz : [-9, 9]\n[SYSTEM EQS]\n"
        "x = a^3/3 + a*(b^2 + c^2 - " +
            square + ");\ny = b;\nz = c;\n[INPUTS] a, b, c\n[OUTPUTS] x, y, z\n",
        "sphere.cuik");
    const Aspects a = counted(planted);
    expect_number(a, r < 141 ? 2 : 9, std::to_string(r));
    EXPECT_TRUE(a.aspects.exact() || (r > 100 && r < 141)) << r << ": " << a.aspects.reason;
  }
}

// What is claimed of one factor is not claimed of another.
TEST(AspectProduct, IsNotVerifiedWithOtherFactors) {
  const symbolic::Mechanism puma = product_model("serial/puma_560");
  const result::PiecesFile file = to_file({.model = puma}, counted(puma, true));
  const std::string path = ::testing::TempDir() + "aspect_product_test.h5";
  result::write_pieces(path, file);
  EXPECT_TRUE(result::verify(result::read_pieces(path)).complete());

  result::PiecesFile fewer = file;
  fewer.further.clear();
  EXPECT_ANY_THROW(result::write_pieces(path, fewer));
  result::PiecesFile more = file;
  more.further.push_back(file.further.front());
  EXPECT_ANY_THROW(result::write_pieces(path, more));
  result::PiecesFile wrong = file;
  ++wrong.further.front().lists[0].at_least;
  EXPECT_FALSE(result::verify(wrong).verified());
  wrong = file;
  --*wrong.further.front().lists[0].at_most;
  EXPECT_FALSE(result::verify(wrong).complete());
}

// A range of a length that cuts something off is a limit of the free coordinates.
TEST(FreeCoordinates, KeepTheRangesThatCutSomethingOff) {
  const auto wide = symbolic::free_coordinates(planted_arm({"sin(a)", "cos(b)", "sin(c)"}));
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->system.coordinates.size(), 3U);
  EXPECT_TRUE(wide->system.inequalities.empty());
  const auto narrow = symbolic::free_coordinates(planted_arm({"sin(a)", "cos(b)", "sin(c)"}, "[-9, 1/2]"));
  ASSERT_TRUE(narrow);
  EXPECT_EQ(narrow->system.inequalities.size(), 2U);
}

// A limit is kept whatever else is known of the coordinate's range, and it is its own.
TEST(FreeCoordinates, KeepTheLimitsOfGivenCoordinates) {
  const auto free = symbolic::free_coordinates(symbolic::parse_model(
      "[SYSTEM VARS]\na ~ [-pi, pi]\nx : [-3, 3]\n[DUMMY VARS]\nu_x : [-11/10, 11/10]\nu_y : [-11/10, 11/10]\n[SYSTEM EQS]\n"
      "u_x = cos(a);\nu_y = sin(a);\nx = 2*u_x*u_x;\n[INPUTS] a\n[OUTPUTS] x\n[LIMITS]\nu_x : [-1/2, 1/4]\na : [-pi/3, "
      "pi/2]\n",
      "limits.cuik"));
  ASSERT_TRUE(free);
  ASSERT_EQ(free->system.coordinates.size(), 1U);
  EXPECT_EQ(free->system.coordinates.front().upper.text(), "pi/2");
  ASSERT_GE(free->system.inequalities.size(), 2U);
  EXPECT_EQ(free->system.inequalities[0].relation.rhs.text(), "-1/2");
  EXPECT_EQ(free->system.inequalities[1].relation.rhs.text(), "1/4");
}

// x − 2 cos x + 3/2 = z does not give x.
TEST(FreeCoordinates, AreNotSaidToGiveWhatStandsInASine) {
  const std::string begin = "[SYSTEM VARS]\nz : [-5, 5]\nx : [-9, 9]\nw : [-9, 9]\n[SYSTEM EQS]\n",
                    end = "[INPUTS] w\n[OUTPUTS] x\n";
  const auto of = [&](const std::string& equations) {
    return symbolic::free_coordinates(symbolic::parse_model(begin + equations + end, "sine.cuik"));
  };
  EXPECT_FALSE(of("x = 2*cos(x) + z - 3/2;\nw = x;\n"));
  EXPECT_FALSE(of("w = cos(x) + z;\nx = w + 1;\n"));
  EXPECT_TRUE(of("x = z - 3/2;\nw = x;\n"));
}

TEST(AspectProduct, OfManyFactorsHasNoBoundThatDoesNotFit) {
  result::SpacePieces many;
  many.lists[0].at_least = many.lists[0].at_most.emplace(65'536);
  PieceClaims all = many.lists[0];
  result::multiply(all, many.lists[0]);
  EXPECT_EQ(all.at_least, std::numeric_limits<int>::max());
  EXPECT_FALSE(all.at_most);
}

}  // namespace
}  // namespace corank::analyze
