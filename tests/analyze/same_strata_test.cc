#include "corank/analyze/robots/same_strata.h"

#include <gtest/gtest.h>

#include "corank/tests/system_builder.h"

namespace corank::analyze {
namespace {

// A tolerance of a few units of the last digit, whose end is no double, and a function whose zeros are smooth for no robot.
TEST(SameStrata, AToleranceIsHalvedUntilDoublesDivideItNoFurther) {
  test::SystemBuilder builder;
  const int x = builder.variable("x", "-1", "1"), y = builder.variable("y", "-1", "1"),
            p = builder.variable("p", "1", "3000000000000001/3000000000000000", VariableKind::parameter);
  builder.equation({{"1", {{y, 1}}}, {"-1", {{x, 1}, {p, 1}}}});
  const std::vector<Polynomial> functions{test::SystemBuilder::polynomial({{"1", {{x, 2}}}})};
  solve::Control control;
  EXPECT_NE(obstacle_to_same_strata(builder.system(), functions, {}, {.parts = 1000}, control), "");
}

}  // namespace
}  // namespace corank::analyze
