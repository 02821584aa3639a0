#include "corank/symbolic/sets/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::symbolic {
namespace {

using ::testing::HasSubstr;

Mechanism model(const std::string& text) { return parse_model(text, "test.cuik"); }

const char* const kArm = R"([CONSTANTS]
a := 1
b := 2*a
c := b/4
[SYSTEM VARS]
x : [-b, b]
t ~ [-pi, pi]
[SYSTEM EQS]
x = b*cos(t) + c;
x^2 <= c;)";

TEST(Parameters, AreUnknownsBehindTheCoordinatesAndConstantsFollowThem) {
  const Mechanism m = model(kArm);
  const ParametricSystem family = with_parameters(m, plain_system(m), {{"a", "1", "2"}});
  EXPECT_TRUE(family.system.constants.empty());
  EXPECT_EQ(family.system.equations[0].relation.text(), "x = (2*a)*cos(t) + 2*a/4");
  EXPECT_EQ(family.system.inequalities[0].relation.text(), "x^2 <= 2*a/4");
  System system = algebrize(family.system);
  ASSERT_EQ(mark_parameters(family, system), std::vector<int>{system.find("a")});
  const Variable& a = system.variables[static_cast<std::size_t>(system.find("a"))];
  EXPECT_TRUE(a.lower_implied && a.upper_implied && a.lower == ExactNumber(1) && a.upper == ExactNumber(2));
}

TEST(Parameters, WidenTheRangesThatDependOnThem) {
  const Mechanism m = model(kArm);
  const ParametricSystem family = with_parameters(m, plain_system(m), {{"a", "1", "2"}});
  const System system = algebrize(family.system);
  const Variable& x = system.variables[static_cast<std::size_t>(system.find("x"))];
  EXPECT_TRUE(x.domain.strictly_contains(Interval(-4, 4)));
  EXPECT_LT(x.domain.width(), 8.5);
}

TEST(Parameters, MayBeAnglesWhoseSinesTheEquationsTake) {
  const Mechanism m = model(kArm);
  const ParametricSystem family = with_parameters(m, plain_system(m), {{"t", "-pi", "2*pi"}}, {{"x", "1/2"}});
  const System system = algebrize(family.system);
  EXPECT_EQ(system.variables[static_cast<std::size_t>(system.find("t"))].kind, VariableKind::length);
  EXPECT_LT(system.find("x"), 0);
  EXPECT_LT(system.find("c_t"), 0);  // a term of its own, and no variable
}

TEST(Parameters, LeaveOutTheHalfSpacesOfKernelVectors) {
  const Mechanism m = model(R"([CONSTANTS]
r := 1
[SYSTEM VARS]
x : [-2, 2]
y : [-2, 2]
[SYSTEM EQS]
x^2 + y^2 = r^2;
[INPUTS] x
[OUTPUTS] y)");
  const TrigonometricSystem forward = singularity_system(m, SingularitySet::forward);
  const ParametricSystem family = with_parameters(m, forward, {{"r", "1", "2"}});
  EXPECT_EQ(family.copies, 2);
  EXPECT_EQ(family.system.inequalities.size() + 1, forward.inequalities.size());
}

TEST(Parameters, AreRefusedWithTheReason) {
  const Mechanism m = model(kArm);
  const auto reason = [&](const std::vector<Parameter>& parameters, const std::vector<FixedCoordinate>& fixed = {}) {
    try {
      with_parameters(m, plain_system(m), parameters, fixed);
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(reason({{"z", "0", "1"}}), HasSubstr("is not in the model"));
  EXPECT_THAT(reason({{"a", "0", "1"}, {"a", "0", "1"}}), HasSubstr("twice"));
  EXPECT_THAT(reason({{"a", "1", "0"}, {"a", "0", "1"}}), HasSubstr("twice"));
  EXPECT_THAT(reason({{"a", "1", "1"}}), HasSubstr("not an interval"));
  EXPECT_THAT(reason({{"a", "1", "2"}, {"t", "0", "b"}}), HasSubstr("depends on a parameter"));
  EXPECT_THAT(reason({{"a", "1", "2"}}, {{"b", "1"}}), HasSubstr("is not in the model"));
}

}  // namespace
}  // namespace corank::symbolic
