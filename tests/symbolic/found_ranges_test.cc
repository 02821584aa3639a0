// Ranges that are left out: found where the equations give them, asked for where they do not.
#include "corank/symbolic/sets/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::symbolic {
namespace {

using ::testing::HasSubstr;

TrigonometricSystem system_of(const std::string& variables, const std::string& equations, const std::string& rest = "") {
  return plain_system(parse_model(
      "[CONSTANTS]\nl := 2\n[SYSTEM VARS]\n" + variables + "\n[SYSTEM EQS]\n" + equations + "\n" + rest, "m.cuik"));
}

std::string range_of(const TrigonometricSystem& s, const std::string& name) {
  for (const Coordinate& c : s.coordinates)
    if (c.name == name) return "[" + c.lower.text() + ", " + c.upper.text() + "]";
  return "none";
}

TEST(FoundRange, IsThatOfSinesAndCosines) {
  const auto s = system_of("x :\nt ~", "x = l*cos(t) + 1/2;");
  EXPECT_EQ(range_of(s, "x"), "[-1.51, 2.51]");
  EXPECT_EQ(range_of(s, "t"), "[-pi, pi]");
}

TEST(FoundRange, IsThatOfASumOfSquares) {
  EXPECT_EQ(range_of(system_of("x :\ny :", "x^2 + 4*y^2 = 1;"), "y"), "[-0.501, 0.501]");
}

TEST(FoundRange, GoesAlongAChainOfLinks) {
  const auto s = system_of("x :\ny :\nu :\nv :", "x^2 + y^2 = l^2;\n(u - x)^2 + (v - y)^2 = 1;");
  EXPECT_EQ(range_of(s, "x"), "[-2.01, 2.01]");
  // 2 + √(1 + 2² + 2²): the theorem takes x and y each in its own range.
  EXPECT_EQ(range_of(s, "u"), "[-5.01, 5.01]");
}

TEST(FoundRange, IsThatOfAnInequality) {
  EXPECT_EQ(range_of(system_of("x :\ny : [0, 9]", "x^2 <= y;\nx = y;"), "x"), "[-0.01, 1.01]");
}

TEST(FoundRange, KeepsItsDigitsForSmallAndLargeUnits) {
  EXPECT_EQ(range_of(system_of("x :\ny :", "x^2 + y^2 = 1e-12;"), "x"), "[-0.00000101, 0.00000101]");
  EXPECT_EQ(range_of(system_of("x :\ny :", "x^2 + y^2 = 1e12;"), "x"), "[-1010000, 1010000]");
}

TEST(FoundRange, LeavesAWidthAroundASingleValue) {
  EXPECT_EQ(range_of(system_of("x :\ny : [0, 1]", "x = 0*y;\ny = 1/2;"), "x"), "[-0.001, 0.001]");
}

TEST(FoundRange, HoldsForLengthsInsideSines) {
  const auto s = system_of("t : [0, 20]\nx :\nz :", "x = t*sin(t);\nz = cos(t + x);");
  EXPECT_EQ(range_of(s, "x"), "[-20.1, 20.1]");
  EXPECT_EQ(range_of(s, "z"), "[-1.01, 1.01]");
}

TEST(FoundRange, IsAskedForWhereTheEquationsGiveNone) {
  for (const char* equations : {"x*y = 1;", "x = y + z;\nz = 1;", "x^2 - y^2 = z;\nz = 1;"}) {
    try {
      system_of("z : [0, 1]\nx :\ny :", equations);
      FAIL() << equations;
    } catch (const ModelError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("m.cuik:5:1: corank finds no bounds in the equations for 'x', which has no range; expected a "
                            "range [lower, upper] where it is declared"));
    }
  }
}

TEST(FoundRange, OfASystemWithoutSolutionsIsAnyRange) {
  EXPECT_NO_THROW(algebrize(system_of("x :\ny :", "x^2 + y^2 = -1;")));
}

TEST(FoundRange, ServesEverySetAlike) {
  const Mechanism m = parse_model(
      "[SYSTEM VARS]\nx :\ny :\nz : [-9, 9]\n[SYSTEM EQS]\nx^2 + z^2 = 4;\ny^2 + z^2 = 1;\n[INPUTS] x\n[OUTPUTS] y",
      "m.cuik");
  for (const SingularitySet set : {SingularitySet::cspace, SingularitySet::forward, SingularitySet::inverse})
    EXPECT_EQ(range_of(singularity_system(m, set), "x"), "[-2.01, 2.01]");
}

}  // namespace
}  // namespace corank::symbolic
