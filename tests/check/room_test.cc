// Covers whose boxes touch the solutions, or nearly: what is true is verified, in few parts.
#include <gtest/gtest.h>

#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

TEST(CheckerRoom, AVariableThatNoEquationMentionsCostsNothing) {
  // x2 and x3 are in no equation: halving them narrows no box.
  const System system = plain(
      "[SYSTEM VARS]\nx0 : [-1, 1]\nx1 : [-1, 1.3]\nx2 : [-1, 1]\nx3 : [-1, 1.3]\n[SYSTEM EQS]\n"
      "6*x0 - 3*x0*x1 + 17*x0^2 + 3*x1 + 4*x1^2 = 5;\n");
  const Cover cover = solved(system, 0.25);
  EXPECT_GT(cover.boxes.size(), 1000u);
  expect_verified(system, cover);
}

TEST(CheckerRoom, ASideMayBeOneNumber) {
  // x1 = 1, which no linear equation says.
  const System system =
      plain("[SYSTEM VARS]\nx0 : [-11/4, 0]\nx1 : [0, 9/8]\n[SYSTEM EQS]\n3*x1^3 + 1/2*x1^2 + 3*x1 = 13/2;\n");
  expect_verified(system, solved(system, 0.1));
}

TEST(CheckerRoom, SidesMayBeOneNumberWhereSeveralEquationsSaySo) {
  // x0 = 5/8, x1 = ±1, x3 = 1/2, x2 = 0 and x4 free.
  const System system = plain(
      "[SYSTEM VARS]\nx0 : [-1, 1]\nx1 : [-5/4, 5/4]\nx2 : [-1/8, 5/4]\nx3 : [-3/4, 11/4]\nx4 : [-5/4, 2]\n[SYSTEM EQS]\n"
      "x3^2 + x0^2 = 41/64;\n3*x0 - x3^2 = 13/8;\nx0^2 + x1^2 = 89/64;\n1/10*x2 - x3 + 1/2 = 0;\n");
  expect_verified(system, solved(system, 0.25));
}

TEST(CheckerRoom, AnEliminatedVariableMayReachTheEndOfItsDomain) {
  // x3 = −1 where x1 = 1/8: decided by exact numbers, since 239/80 is no double.
  const System system = plain(
      "[SYSTEM VARS]\nx0 : [-13/8, 19/8]\nx1 : [-15/8, 7/8]\nx2 : [-13/8, -5/8]\nx3 : [-9/4, -1]\n[SYSTEM EQS]\n"
      "3*x3 + 1/10*x1 + 239/80 = 0;\n3*x0 - 2*x1 = 11/4;\nx2^2 + x1^2 = 65/64;\n");
  expect_verified(system, solved(system, 0.1));
}

TEST(CheckerRoom, APointWithATolerance) {
  System system = plain(
      "[SYSTEM VARS]\nx0 : [-7/4, 11/4]\nx1 : [3/8, 13/8]\n[SYSTEM EQS]\n"
      "cos(x1) - 13/10*x1^2 + 2*x1 = 95/128 + cos(5/8);\n1/2*x1 - sin(x0) + 2*x0 = 13/16 - sin(1/4);\n");
  system.coefficient_tolerance = 1e-3;
  expect_verified(system, solved(system, 0.25));
}

}  // namespace
}  // namespace corank::check
