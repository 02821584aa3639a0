// Which coordinates have no say in where the outputs are.
#include "corank/symbolic/sets/idle_coordinates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// An arm of two joints with a wheel t3 at its tip, whose rim is at (a, b).
Mechanism arm_with_wheel(const std::string& rim, const std::string& more = "", const std::string& outputs = "x, y") {
  return parse_model(
      "[SYSTEM VARS]\nt1 ~\nt2 ~\nt3 ~\nx : [-9, 9]\ny : [-9, 9]\n" + rim +
          "[SYSTEM EQS]\nx = cos(t1) + cos(t2);\ny = sin(t1) + sin(t2);\na = x + cos(t3);\nb = a*y + sin(t3);\n" + more +
          "[INPUTS] t1, t2\n[OUTPUTS] " + outputs + "\n",
      "m.cuik");
}
constexpr const char* kFound = "a :\nb :\n";

TEST(IdleCoordinates, AreThoseThatOnlyGiveOthers) {
  const Mechanism m = arm_with_wheel(kFound);
  const IdleCoordinates idle = idle_coordinates(m);
  EXPECT_THAT(idle.free, ElementsAre("t3"));
  EXPECT_THAT(idle.given, ElementsAre("b", "a")) << "a is in the equation of b";
  const Mechanism rest = without_idle(m, idle);
  EXPECT_THAT(names_of(rest.coordinates()), ElementsAre("t1", "t2", "x", "y"));
  EXPECT_EQ(rest.equations().size(), 2u);
  EXPECT_EQ(rest.find_coordinate("y"), 3);
  EXPECT_EQ(rest.find_coordinate("a"), -1);
  EXPECT_FALSE(rest.has("b"));
  rest.validate();
}

TEST(IdleCoordinates, AreNoneThatAnOutputAnInequalityARangeOrALimitDependsOn) {
  EXPECT_THAT(idle_coordinates(arm_with_wheel(kFound, "", "x, b")).free, IsEmpty());
  EXPECT_THAT(idle_coordinates(arm_with_wheel(kFound), {"a"}).free, IsEmpty()) << "kept";
  EXPECT_THAT(idle_coordinates(arm_with_wheel(kFound, "a <= 1;\n")).free, IsEmpty());
  EXPECT_THAT(idle_coordinates(arm_with_wheel("a : [-9, 9]\nb : [-99, 99]\n")).free, IsEmpty()) << "|x| may be 9";
  EXPECT_THAT(idle_coordinates(arm_with_wheel("a : [-11, 11]\nb : [-110, 110]\n")).free, ElementsAre("t3"));
  EXPECT_THAT(idle_coordinates(arm_with_wheel("a : [-11, 11]\nb : [-99, 110]\n")).free, IsEmpty());
  EXPECT_THAT(idle_coordinates(arm_with_wheel(kFound, "[LIMITS]\na : [-11, 11]\n")).free, IsEmpty());
  EXPECT_THAT(idle_coordinates(arm_with_wheel(kFound, "[LIMITS]\nt3 : [-1, 1]\n")).free, ElementsAre("t3"));
}

TEST(IdleCoordinates, LeaveTheMechanismAsItIsWhereThereAreNone) {
  const Mechanism m =
      parse_model("[SYSTEM VARS]\nt ~\nx : [-2, 2]\nz :\n[SYSTEM EQS]\nx = cos(t);\nz = x + 1;\n[OUTPUTS] x\n", "m.cuik");
  const IdleCoordinates idle = idle_coordinates(m);
  EXPECT_THAT(idle.free, IsEmpty());
  EXPECT_EQ(without_idle(m, idle).coordinates().size(), 3u);
}

}  // namespace
}  // namespace corank::symbolic
