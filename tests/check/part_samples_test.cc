// Samples of a set and of its parts: a set is planted as a union, and its parts are right or damaged.
#include "corank/check/part_samples.h"

#include <gtest/gtest.h>

#include <random>

#include "corank/core/nearest_rounding.h"
#include "corank/tests/check/covers.h"
#include "corank/tests/seeds.h"

namespace corank::check {
namespace {

const std::string kInSpace = "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-2, 2]\nw : [-9, 9]\n";
const std::string kHeight = "w - x*y - z^2 = 0;\n";

System part_of(const std::string& equations, const std::string& variables = kInSpace) {
  return plain(variables + "[SYSTEM EQS]\n" + equations);
}

// M(q) ξ = 0 with det M = f·g, M = (f h; 0 g).
System set_of(const std::string& f, const std::string& g, const std::string& h) {
  System system = part_of(kHeight + "(" + f + ")*a + (" + h + ")*b = 0;\n(" + g + ")*b = 0;\na^2 + b^2 = 1;\n",
                          kInSpace + "a : [-1, 1]\nb : [-1, 1]\n");
  for (const std::size_t j : {4u, 5u}) system.variables[j].kind = VariableKind::kernel;
  system.configuration_size = 4;
  return system;
}

const std::string kLevel = "x + 2*y - 1", kSphere = "x^2 + y^2 + z^2 - 2";
const PartOfSet kOnPlane{"plane", part_of(kHeight + kLevel + " = 0;\n")},
    kOnSphere{"sphere", part_of(kHeight + kSphere + " = 0;\n")};

PartSamples samples_of(const std::vector<PartOfSet>& parts, unsigned seed = 1) {
  const NearestRounding nearest;
  return sample_parts(set_of(kLevel, kSphere, "x - z"), parts, seed);
}

TEST(PartSamples, AreInTheOthersWhereThePartsAreRight) {
  const PartSamples samples = samples_of({kOnPlane, kOnSphere});
  EXPECT_TRUE(samples.failures.empty()) << samples.failures[0];
  EXPECT_GE(samples.of_set, 10u);
  EXPECT_GE(samples.of_parts, 20u);
}

TEST(PartSamples, TellThatAPartIsMissing) {
  const PartSamples samples = samples_of({kOnSphere});
  ASSERT_EQ(samples.failures.size(), 1u);
  EXPECT_EQ(samples.failures[0].find("a solution of the set is in no part: x = "), 0u) << samples.failures[0];
}

TEST(PartSamples, TellThatAPartLacksAnEquation) {
  const PartSamples samples = samples_of({kOnPlane, {"sphere", part_of(kSphere + " = 0;\n")}});
  ASSERT_EQ(samples.failures.size(), 1u);
  EXPECT_EQ(samples.failures[0].find("a solution of the part 'sphere' is not in the set: x = "), 0u);
}

TEST(PartSamples, TellThatACoordinateIsNotFree) {
  // On the plane z and w are free together, w = x·y + z², but neither alone; z is where w is left out as well.
  const auto without = [](const std::string& variables, std::vector<std::string> free) {
    return PartOfSet{"plane", part_of(kLevel + " = 0;\n", variables), std::move(free)};
  };
  const std::string two = "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n";
  EXPECT_TRUE(samples_of({without(two, {"z"}), kOnSphere}).failures.empty());
  EXPECT_EQ(samples_of({without(two, {"w"}), kOnSphere}).failures.size(), 1u) << "w < x·y has no z";
}

// One damaged in six: a part is left out, or its equation is another.
TEST(PartSamples, RefuseNoRightPartsAndFindWrongOnes) {
  std::size_t right = 0, wrong = 0, found = 0;
  for (unsigned seed = 0; seed < test::seeds(60); ++seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return std::to_string(static_cast<int>(random() % 5) - 2); };
    const auto surface = [&] {
      return number() + "*x + " + number() + "*y + " + number() + "*z + x*y - " + number() + "*z^2 - 1/3";
    };
    std::string f = surface(), g = surface();
    const System set = set_of(f, g, surface());
    const bool damaged = random() % 6 == 0;
    if (damaged) (random() % 2 == 0 ? f : g) += " + 1/100*x^2";
    const NearestRounding nearest;
    const PartSamples samples =
        sample_parts(set, {{"f", part_of(kHeight + f + " = 0;\n")}, {"g", part_of(kHeight + g + " = 0;\n")}}, seed);
    if (damaged) {
      ++wrong;
      found += !samples.failures.empty();
    } else {
      ++right;
      EXPECT_TRUE(samples.failures.empty()) << "seed " << seed << ": " << samples.failures[0];
    }
  }
  EXPECT_GT(right, 30u);
  EXPECT_EQ(found, wrong);
}

}  // namespace
}  // namespace corank::check
