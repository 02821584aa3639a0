// Limits of coordinates: their section, what they mean to a system, their faults.
#include "corank/symbolic/sets/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::symbolic {
namespace {

using testing::HasSubstr;

// Lines of [LIMITS] from line 13 on.
std::string rod(const std::string& limits) {
  return "[CONSTANTS]\nl := 2\n[SYSTEM VARS]\nx : [-5, 5]\ny : [-5, 5]\nt ~\ns ~ [-1, 1]\n[SYSTEM EQS]\nx = l*cos(t);\ny = "
         "l*sin(t) + sin(s);\n"
         "[OUTPUTS] x, y\n[LIMITS]\n" +
         limits;
}

std::string fault(const std::string& limits) {
  try {
    plain_system(parse_model(rod(limits), "m.cuik"));
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

TEST(Limits, NarrowTheRangesOfEverySystem) {
  const Mechanism m = parse_model(rod("x : [-1, l/4]\nt : [0, pi]; s : [-1/2, 1]\n"), "m.cuik");
  const System system = algebrize(plain_system(m));
  EXPECT_EQ(system.variables[0].domain, Interval(-1, 0.5));
  EXPECT_EQ(system.variables[1].domain, Interval(-5, 5));
  EXPECT_EQ(system.inequalities.size(), 2u) << "of the two angles";
  EXPECT_EQ(m.coordinates()[0].upper.text(), "5") << "the declaration stays as it is";
  EXPECT_EQ(effective_limits(m).size(), 3u);
}

TEST(Limits, OfAWholeTurnAreNone) {
  const Mechanism m = parse_model(rod("t : [-pi, pi]\n"), "m.cuik");
  EXPECT_EQ(m.limits().size(), 1u);
  EXPECT_TRUE(effective_limits(m).empty());
  EXPECT_EQ(algebrize(plain_system(m)).inequalities.size(), 1u) << "the range of s";
}

TEST(Limits, FollowConstantsThatArePutIn) {
  Mechanism m = parse_model(rod("x : [-1, l/4]\n"), "m.cuik");
  m.set_constant("l", "8");
  EXPECT_EQ(algebrize(plain_system(m)).variables[0].domain, Interval(-1, 2));
}

TEST(Limits, ComeBackFromTheModelsText) {
  const Mechanism m = parse_model(rod("x : [-1, l/4]\nt : [0, pi]\n"), "m.cuik");
  const std::string text = to_model(m);
  const Mechanism again = parse_model(text, "m.cuik");
  ASSERT_EQ(again.limits().size(), 2u);
  EXPECT_EQ(again.limits()[0].upper.text(), "l/4");
  EXPECT_EQ(again.limits()[1].coordinate, "t");
  EXPECT_EQ(to_model(again), text);
}

TEST(Limits, StandBeforeTheVariablesToo) {
  EXPECT_EQ(
      parse_model("[LIMITS]\nx : [0, 1]\n[SYSTEM VARS]\nx : [-5, 5]\n[SYSTEM EQS]\nx^2 = 1;\n", "m.cuik").limits().size(),
      1u);
}

TEST(Limits, ReportFaultsWithTheirLine) {
  EXPECT_THAT(fault("x : [-1, 1]\nz : [0, 1]\n"), HasSubstr("m.cuik:14:1: the limit of 'z', which is not declared"));
  EXPECT_THAT(fault("l : [0, 1]\n"), HasSubstr("m.cuik:13:1: the limit of 'l', which is a constant"));
  EXPECT_THAT(fault("x : [0, 1]\nx : [0, 1]\n"), HasSubstr("m.cuik:14:1: 'x' is limited twice in line 13"));
  EXPECT_THAT(fault("x : [0, t]\n"), HasSubstr("m.cuik:13"));
  EXPECT_THAT(fault("x : [1, 0]\n"), HasSubstr("m.cuik:13:1: the limit of 'x', [1, 0], is empty"));
  EXPECT_THAT(fault("x : [1, l/2]\n"), HasSubstr("m.cuik:13:1: the limit of 'x', [1, l/2], is one value"));
  EXPECT_THAT(fault("x : [0, 6]\n"), HasSubstr("m.cuik:13:1: the limit of 'x', [0, 6], reaches beyond the declared range"));
  EXPECT_THAT(fault("s : [0, pi/2]\n"), HasSubstr("m.cuik:13:1: the limit of 's', [0, pi/2], reaches beyond"));
  EXPECT_THAT(fault("x ~ [0, 1]\n"), HasSubstr("m.cuik:13:3: found '~'; expected ':' after the variable's name"));
  EXPECT_THAT(fault("x : 3\n"),
              HasSubstr("m.cuik:13:5: found '3' where the limits of 'x' should be; expected [lower, upper]"));
  EXPECT_THAT(fault("3\n"), HasSubstr("m.cuik:13:1: found '3'; expected a limit, name : [lower, upper]"));
}

TEST(BoundaryParts, AreTheSetsOfLimitsThatMayBeReachedAtOnce) {
  // Mobility 2 and as many outputs: one limit at a time, and the limited output for itself.
  const auto parts = boundary_parts(parse_model(rod("t : [0, pi]\ns : [-1, 1]\nx : [0, 1]\n"), "m.cuik"));
  std::vector<std::string> names;
  for (const BoundaryPart& part : parts) names.push_back(part.text());
  EXPECT_THAT(names, testing::ElementsAre("no limit", "t at its lower limit", "t at its upper limit", "s at its lower limit",
                                          "s at its upper limit", "x at its lower limit", "x at its upper limit"));
  EXPECT_TRUE(parts.back().of_output);
  Mechanism one = parse_model(rod("t : [0, pi]\ns : [-1, 1]\n"), "m.cuik");
  one.replace_outputs({"y"});
  EXPECT_EQ(boundary_parts(one).size(), 1u + 4 + 4) << "one output: two limits at once";
}

TEST(BoundaryParts, NeedOutputs) {
  Mechanism m = parse_model(rod("t : [0, pi]\n"), "m.cuik");
  m.replace_outputs({});
  EXPECT_THROW(boundary_parts(m), ModelError);
  EXPECT_THROW(
      boundary_parts(parse_model("[SYSTEM VARS]\nx : [-5, 5]\ny : [-5, 5]\nz : [-5, 5]\n[SYSTEM EQS]\nx + y + z = 1;\n"
                                 "x = y*z;\n[OUTPUTS] x, y\n",
                                 "m.cuik")),
      ModelError)
      << "more than its mobility";
  const Mechanism tied = parse_model(
      "[SYSTEM VARS]\nx : [0, 2]\ny : [0, 2]\nz : [0, 2]\n[SYSTEM EQS]\nx = 1;\nx^2 = 1;\n[OUTPUTS] x\n", "tied.cuik");
  try {
    boundary_parts(tied);
    FAIL() << "two equations tie one output";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("mobility -1 without y and z, which no output depends on"));
  }
}

TEST(BoundaryParts, AreSystemsOfTheExpectedDimension) {
  const Mechanism m = parse_model(rod("t : [0, pi]\ns : [-1, 1]\nx : [0, 1]\n"), "m.cuik");
  for (const BoundaryPart& part : boundary_parts(m)) {
    const SetEquations equations(m, SingularitySet::boundary, part);
    const System system = equations.compiled(equations.scales());
    EXPECT_EQ(system.dimension(), part.of_output ? 2 : 1) << part.text();  // a length at its limit is a domain of one number
    ASSERT_TRUE(system.passage.has_value());
    EXPECT_EQ(system.passage->slack.size(), part.active.size());
    EXPECT_EQ(system.passage->normal.size(), 2u);
    EXPECT_EQ(system.passage->columns, part.of_output ? 0 : 2 - static_cast<int>(part.active.size()));
  }
}

// "name", "name with λ" …
std::vector<std::string> parts_of_boundary(const Mechanism& m) {
  std::vector<std::string> names;
  for (const SetPart& part : set_parts(m, SingularitySet::boundary)) {
    const auto& limits = std::get<BoundaryPart>(part);
    names.push_back(text(part) + (limits.has_multipliers ? " with λ" : ""));
    const SetEquations equations(m, SingularitySet::boundary, part);
    const System system = equations.compiled(equations.scales());
    EXPECT_EQ(system.passage->multipliers.empty(), !limits.has_multipliers) << names.back();
  }
  return names;
}

TEST(BoundaryParts, AreWithoutMultipliersWhereTheyHaveAnEquationOrNeedNone) {
  using testing::ElementsAre;
  const std::string limits = "t : [0, pi]\n";
  Mechanism m = parse_model(rod(limits), "m.cuik");
  EXPECT_THAT(parts_of_boundary(m), ElementsAre("no limit: sin(t) = 0", "t at its lower limit", "t at its upper limit"))
      << "cos(s) = 0 is beyond the range of s";
  m.replace_outputs({"y"});
  EXPECT_THAT(parts_of_boundary(m),
              ElementsAre("no limit with λ", "t at its lower limit with λ", "t at its upper limit with λ"))
      << "redundant: two limits at once would need none";
}

TEST(BoundaryParts, HoldWhatHasOneValueWhereTheOutputsAreFreeWithoutIt) {
  // Three joints in a row, the first two of length 1, the third of length 1/2.
  const auto arm = [](const std::string& range, const std::string& outputs) {
    return parse_model("[SYSTEM VARS]\nx :\ny :\na ~\nb ~\nc ~ " + range +
                           "\n[SYSTEM EQS]\nx = cos(a) + cos(b) + cos(c)/2;\ny = sin(a) + sin(b) + sin(c)/2;\n"
                           "[INPUTS] a\n[OUTPUTS] " +
                           outputs + "\n[LIMITS]\na : [0, 1]\n",
                       "arm.cuik");
  };
  const std::size_t moving = boundary_parts(arm("[-pi, pi]", "x, y")).size();
  EXPECT_EQ(moving, 3u);
  const Mechanism held = arm("[1/2, 1/2]", "x, y");
  for (const BoundaryPart& part : boundary_parts(held)) {
    const KernelQuestion kernel = boundary_kernel(held, part);
    EXPECT_THAT(kernel.matrix.columns, testing::Not(testing::Contains("c"))) << part.text();
    EXPECT_EQ(kernel.matrix.columns.size(), part.active.empty() ? 2u : 1u);
  }
  const Mechanism cut = arm("[1/2, 1/2]", "x, y, b");
  EXPECT_THAT(boundary_kernel(cut, boundary_parts(cut).front()).matrix.columns, testing::Contains("c"))
      << "else two joints would have to move three outputs";
}

}  // namespace
}  // namespace corank::symbolic
