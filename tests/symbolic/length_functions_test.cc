// Sines and cosines of lengths.
#include "corank/tests/symbolic/compiled_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LengthFunctions, StandWhereTheyAreTermsAndBecomeVariablesWhereTheyAreFactors) {
  const System s = compile(
      "[SYSTEM VARS]\nq : [-2, 2]\ny : [-20, 20]\nt : [0, 8*pi]\n[SYSTEM EQS]\nq = 0.5*cos(t);\nt = y^2/4;\ny*sin(t)*3 = "
      "0;");
  EXPECT_THAT(names(s), ElementsAre("q", "y", "t", "s_t"));
  EXPECT_THAT(canonical(s.equations), ElementsAre(" + 1·x0^1 + -1/2·cos(x2)", " + -1/4·x1^2 + 1·x2^1",  //
                                                  " + 3·x1^1·x3^1", " + 1·x3^1 + -1·sin(x2)"));
  EXPECT_EQ(s.configuration_size, 3);
  EXPECT_EQ(s.variables[3].kind, VariableKind::auxiliary);
  EXPECT_EQ(s.variables[3].domain, Interval(-1, 1));
  EXPECT_EQ(s.equations[3].source, "definition of s_t");
  EXPECT_THAT(s.angles, IsEmpty());
}

std::vector<std::string> with_lengths(const std::string& equations) {
  return canonical(
      compile("[SYSTEM VARS]\nx : [-1, 1]\ny : [-2, 3]\ntheta ~ [-pi, pi]\n[SYSTEM EQS]\n" + equations).equations);
}

TEST(LengthFunctions, UseOneVariableEverywhereOnceTheyNeedIt) {
  // x0 = x, x1 = y, x2 = cos theta, x3 = sin theta, x4 the new one
  EXPECT_THAT(
      with_lengths("cos(x) = y;\ncos(x)^2 + sin(y) = 1;"),
      ElementsAre(" + -1·x1^1 + 1·x4^1", " + -1 + 1·x4^2 + 1·sin(x1)", " + -1 + 1·x2^2 + 1·x3^2", " + 1·x4^1 + -1·cos(x0)"));
  EXPECT_THAT(with_lengths("cos(x + theta) = y + sin(-x);"),
              ElementsAre(" + -1·x1^1 + 1·x2^1·x4^1 + -1·x3^1·x5^1 + 1·x5^1", " + -1 + 1·x2^2 + 1·x3^2",
                          " + 1·x4^1 + -1·cos(x0)", " + 1·x5^1 + -1·sin(x0)"));
}

TEST(LengthFunctions, TakeAnyLinearArgument) {
  EXPECT_EQ(with_lengths("cos(x + pi/3) = y;")[0], " + -1·x1^1 + -1/2*sqrt(3)·sin(x0) + 1/2·cos(x0)");
  EXPECT_EQ(with_lengths("sin(x - x) = y;")[0], " + -1·x1^1");
  const System s = compile(
      "[SYSTEM VARS]\nx : [-1, 1]\ny : [-2, 3]\n[SYSTEM EQS]\nsin(2*x - pi*y) + cos(pi*y - 2*x) = sin(y/2 + x/2 - y/2 + "
      "x/2);");
  EXPECT_THAT(names(s), ElementsAre("x", "y", "u_x_y"));
  EXPECT_THAT(canonical(s.equations), ElementsAre(" + -1·sin(x0) + 1·sin(x2) + 1·cos(x2)", " + -2·x0^1 + pi·x1^1 + 1·x2^1"));
  EXPECT_EQ(s.variables[2].lower.text(), "-2 - 3*pi");
  EXPECT_EQ(s.variables[2].upper.text(), "2 + 2*pi");
}

TEST(LengthFunctions, MayStandInInequalities) {
  const System s = compile(with_equation("x = cos(theta);\ncos(x) >= 1/2;\nx*sin(x) <= 1;"));
  EXPECT_THAT(canonical(s.inequalities), ElementsAre(" + -1/2 + 1·cos(x0)", " + 1 + -1·x0^1·x5^1"));
  EXPECT_EQ(canonical(s.equations.back()), " + 1·x5^1 + -1·sin(x0)");
}

TEST(LengthFunctions, AreDifferentiatedInKernelEquations) {
  // A point on a helix: turning about z by t lifts it by t/10.
  const Mechanism m = parse_model(
      "[SYSTEM VARS]\nt : [0, 20]\nx : [-2, 2]\nz : [0, 2]\n[SYSTEM EQS]\nx = cos(t);\nz = t/10;\n[INPUTS] x\n[OUTPUTS] z",
      "m.cuik");
  const System s = algebrize(singularity_system(m, SingularitySet::forward));
  EXPECT_THAT(names(s), ElementsAre("t", "x", "z", "xi1", "xi2", "s_t"));
  EXPECT_THAT(canonical(s.equations),
              ElementsAre(" + 1·x1^1 + -1·cos(x0)", " + -1/10·x0^1 + 1·x2^1", " + 1·x3^1·x5^1", " + -1/10·x3^1 + 1·x4^1",
                          " + -1 + 1·x3^2 + 1·x4^2", " + 1·x5^1 + -1·sin(x0)"));
}

TEST(LengthFunctions, TakeNamesThatAreFree) {
  const System s =
      compile("[SYSTEM VARS]\nt : [0, 1]\ns_t : [0, 1]\nu_t : [0, 1]\n[SYSTEM EQS]\nt*sin(t) = s_t*sin(2*t) + u_t;");
  EXPECT_THAT(names(s), ElementsAre("t", "s_t", "u_t", "u_t_", "s_t_", "s_u_t_"));
}

}  // namespace
}  // namespace corank::symbolic
