// Aspects and shapes of all robots within tolerances: what is claimed for every robot is compared with random ones.
#include "corank/analyze/robots/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/aspects/aspects_factor.h"
#include "corank/analyze/robots/robots_words.h"
#include "corank/analyze/topology/topology.h"
#include "corank/study/model.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using testing::HasSubstr;

struct ToleratedLength {
  std::string name;
  double value, tolerance;  // multiples of 2⁻²⁰
};
using ToleratedLengths = std::vector<ToleratedLength>;

study::Question within_tolerances(const std::string& file, const ToleratedLengths& lengths,
                                  std::vector<result::ConstantOverride> overrides = {}) {
  for (const auto& [name, value, tolerance] : lengths) {
    const std::string exact = ExactNumber::dyadic(value).text();
    overrides.push_back({name, tolerance > 0 ? exact + " ± " + ExactNumber::dyadic(tolerance).text() : exact});
  }
  study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR "/models/") + file, overrides);
  return {.model = std::move(model.mechanism), .constants = overrides, .assembly = std::move(model.assembly)};
}

double rounded_to_bits(double x) { return std::round(std::ldexp(x, 20)) / std::ldexp(1, 20); }

ToleratedLengths random_lengths(const std::vector<std::string>& names, double least, double most, double tolerance,
                                std::mt19937& random) {
  std::uniform_real_distribution<double> value(least, most), size(tolerance / 100, tolerance);
  std::bernoulli_distribution toleranced(0.6);
  ToleratedLengths lengths;
  for (const std::string& name : names)
    lengths.push_back({name, rounded_to_bits(value(random)), toleranced(random) ? rounded_to_bits(size(random)) : 0});
  if (std::ranges::all_of(lengths, [](const ToleratedLength& l) { return l.tolerance == 0; }))
    lengths.front().tolerance = rounded_to_bits(tolerance / 2);
  return lengths;
}

// Some at ends of the tolerances.
ToleratedLengths random_robot(const ToleratedLengths& all, std::mt19937& random) {
  std::uniform_real_distribution<double> by(-1, 1);
  std::bernoulli_distribution at_end(0.5);
  ToleratedLengths one = all;
  for (auto& [name, value, tolerance] : one) {
    const double x = by(random);
    value += at_end(random) ? std::copysign(tolerance, x) : rounded_to_bits(x * tolerance);
    tolerance = 0;
  }
  return one;
}

Aspects aspects_within(const study::Question& question) {
  solve::Control control;
  return aspects(question, {.threads = 2}, control);
}

Topology shape_within(const study::Question& question) {
  solve::Control control;
  return topology(question, {.threads = 2}, control);
}

void expect_the_same_aspects(const Aspects& all, const Aspects& one, const std::string& what) {
  const auto agree = [](const Pieces& p, const Pieces& q) { return !(p.exact() && q.exact()) || p.at_least == q.at_least; };
  EXPECT_TRUE(one.reason.empty()) << what << one.reason;
  EXPECT_TRUE(agree(all.aspects, one.aspects) && agree(all.assembly_modes, one.assembly_modes) &&
              agree(all.working_modes, one.working_modes))
      << what << summary(all) << " but " << summary(one);
}

// Of random robots of a family; returns for how many tolerances the answer is the same for all robots.
int count_decided(const std::string& file, const std::vector<std::string>& names, double least, double most,
                  double tolerance, unsigned cases, unsigned robots, std::vector<result::ConstantOverride> held = {}) {
  std::mt19937 random(7);
  int decided = 0;
  for (unsigned k = 0; k < cases; ++k) {
    const ToleratedLengths lengths = random_lengths(names, least, most, tolerance, random);
    const Aspects all = aspects_within(within_tolerances(file, lengths, held));
    EXPECT_TRUE(all.robots) << file;
    if (!all.robots) return 0;
    EXPECT_NE(all.robots->same, !all.robots->obstacle.empty());
    if (!all.robots->same) continue;
    ++decided;
    for (unsigned i = 0; i < robots; ++i)
      expect_the_same_aspects(all, aspects_within(within_tolerances(file, random_robot(lengths, random), held)),
                              file + " " + std::to_string(k) + ": ");
  }
  testing::Test::RecordProperty("decided", decided);
  printf("%s: the same for all robots in %d of %u cases\n", file.c_str(), decided, cases);
  return decided;
}

// Grashof: 2 circles if the sum of the shortest and the longest link is less than that of the others, else 1.
double grashof(const ToleratedLengths& links) {
  std::vector<double> l;
  for (const ToleratedLength& link : links) l.push_back(link.value);
  std::ranges::sort(l);
  return l[0] + l[3] - l[1] - l[2];
}

TEST(AllRobots, OfFourBarsPlantedOnBothSidesOfGrashofsConditionAreNeverClaimedToBeAlike) {
  const std::vector<std::string> names{"a", "b", "c", "d"};
  std::mt19937 random(3);
  int alike = 0, different = 0, found = 0, cases = 0;
  for (unsigned k = 0; k < test::seeds(24); ++k) {
    ToleratedLengths links = random_lengths(names, 1, 5, 0.05, random);
    if (k % 2 == 0) {  // the robot as drawn is nearly at the condition
      std::ranges::sort(links, {}, &ToleratedLength::value);
      links[3].value -= rounded_to_bits(0.9 * grashof(links));
    }
    bool positive = false, negative = false;
    for (int i = 0; i < 300; ++i) {
      const double g = grashof(random_robot(links, random));
      positive = positive || g > 0, negative = negative || g < 0;
    }
    const Topology t = shape_within(within_tolerances("planar/four_bar_crank_rocker.cuik", links));
    ASSERT_TRUE(t.robots);
    ++cases;
    if (t.robots->same) {
      ++alike;
      EXPECT_FALSE(positive && negative) << k;
      ASSERT_TRUE(t.components.exact());
      EXPECT_EQ(t.components.at_least, positive ? 1 : 2) << k;
    } else if (!t.robots->other.empty()) {
      ++found;
      EXPECT_TRUE(positive && negative) << k;
    }
    different += positive && negative;
  }
  printf("four-bars: %d of %d the same, %d differ, of which %d found\n", alike, cases, different, found);
  EXPECT_GT(alike, cases / 4);
  EXPECT_GT(found, 0);
}

TEST(AllRobots, OfRandomFiveBarsHaveTheAspectsThatAreClaimed) {
  EXPECT_GT(count_decided("dextar.cuik", {"l2", "l3", "l4", "l5", "d"}, 0.8, 1.2, 0.004, test::seeds(2), 2), 0);
}

TEST(AllRobots, OfRandomOrthogonalArmsHaveTheAspectsThatAreClaimed) {
  EXPECT_GT(count_decided("serial/orthogonal_3r.cuik", {"d2", "d3", "d4", "r2"}, 0.7, 2.5, 0.02, test::seeds(3), 3), 0);
}

TEST(AllRobots, OfRandomSlicesOfAPlatformHaveTheAspectsThatAreClaimed) {
  EXPECT_GT(count_decided("planar/3rpr.cuik", {"bx", "px"}, 0.95, 1.15, 0.002, test::seeds(1), 1,
                          {{"lower1", "6/5"}, {"upper1", "6/5"}}),
            -1);
}

TEST(AllRobots, OfDextarAreOfOneShape) {
  const ToleratedLengths lengths{{"l", 0.9, 0.001}, {"d", 1.18, 0.001}};
  const Aspects a = aspects_within(within_tolerances("dextar.cuik", lengths));
  ASSERT_TRUE(a.robots && a.aspects.exact());
  EXPECT_TRUE(a.robots->same) << a.robots->obstacle;
  EXPECT_EQ(a.aspects.at_least, 10);
  const Topology t = shape_within(within_tolerances("dextar.cuik", lengths));
  ASSERT_TRUE(t.robots && t.euler_characteristic);
  EXPECT_TRUE(t.robots->same) << t.robots->obstacle;
  EXPECT_EQ(*t.euler_characteristic, -6);
}

// A circle, or no point; one point for the robot between them.
TEST(AllRobots, ThatDifferAreNamed) {
  const auto circle = [](const std::string& a) {
    return study::Question{.model = study::parse_model({"[CONSTANTS]\na := " + a +
                                                            "\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-3, 3]\n[SYSTEM EQS]\n"
                                                            "x^2 + y^2 = a;\n",
                                                        "circle.cuik"})
                                        .mechanism};
  };
  const Topology same = shape_within(circle("1 ± 0.5"));
  ASSERT_TRUE(same.robots);
  EXPECT_TRUE(same.robots->same) << same.robots->obstacle;
  EXPECT_EQ(same.components.at_least, 1);
  const Topology other = shape_within(circle("1 ± 1.5"));
  ASSERT_TRUE(other.robots);
  EXPECT_FALSE(other.robots->same);
  ASSERT_EQ(other.robots->other.size(), 1u);
  EXPECT_EQ(other.robots->other[0].value.mid(), -0.5);
  EXPECT_EQ(other.robots->other_numbers.front(), std::pair(std::string("components"), 0));
  const auto json = nlohmann::json::parse(to_json(circle("1 ± 1.5"), other));
  EXPECT_EQ(json["robots"]["other"]["components"], 0);
  EXPECT_EQ(json["robots"]["every"], false);
  EXPECT_THAT(robots_text(*other.robots), HasSubstr("another robot"));
  EXPECT_THAT(robots_text(*same.robots), HasSubstr("every one within the tolerances of a"));
}

// The end of a range cuts the circles of all robots, or of some only.
TEST(AllRobots, KeepToTheSameLimits) {
  const auto cut = [](const std::string& a) {
    return study::Question{.model = study::parse_model({"[CONSTANTS]\na := " + a +
                                                            "\n[SYSTEM VARS]\nx : [-1, 2]\ny : [-3, 3]\n[SYSTEM EQS]\n"
                                                            "x^2 + y^2 = a;\n",
                                                        "cut.cuik"})
                                        .mechanism};
  };
  const Topology always = shape_within(cut("2 ± 0.5")), sometimes = shape_within(cut("1 ± 0.5"));
  ASSERT_TRUE(always.robots && sometimes.robots);
  EXPECT_TRUE(always.robots->same) << always.robots->obstacle;
  EXPECT_EQ(always.ends.size(), 1u);
  EXPECT_FALSE(sometimes.robots->same);
}

TEST(AllRobots, OfWhomADeterminantVanishesAreNotAlike) {
  const ToleratedLengths lengths{{"l", 0.9, 0}, {"l2", 0.0625, 0.125}};
  const Aspects a = aspects_within(within_tolerances("dextar.cuik", lengths));
  ASSERT_TRUE(a.robots);
  EXPECT_FALSE(a.robots->same);
  EXPECT_THAT(a.robots->obstacle, HasSubstr("factor l2"));
  // Also where it is 0 at a corner of the tolerances.
  const Aspects corner = aspects_within(within_tolerances("dextar.cuik", {{"l", 0.9, 0}, {"l2", 0.0625, 0.0625}}));
  ASSERT_TRUE(corner.robots);
  EXPECT_THAT(corner.robots->obstacle, HasSubstr("factor l2"));
  EXPECT_THROW(aspects_within(within_tolerances("dextar.cuik", {{"l", 0.9, 0}, {"l2", 0, 0.125}})),
               symbolic::DeterminantVanishes);
}

// C-space is two circles while 2 + d < 3 + 9/2, then one: the factor of ±t is (11/2 − d)/t, planted at random.
TEST(AllRobots, KeepTheirAspectsUpToThePlantedFactor) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(4.9, 5.2), size(0.01, 0.1);
  for (unsigned k = 0; k < test::seeds(2); ++k) {
    const ToleratedLength d{"d", rounded_to_bits(value(random)), rounded_to_bits(size(random))};
    const double truth = (5.5 - d.value) / d.tolerance;
    solve::Control control;
    const study::Question question = within_tolerances("planar/four_bar_crank_rocker.cuik", {d});
    const AspectsFactor f = aspects_factor(question, {.precision = 0.05, .threads = 2, .progress = {}}, control);
    ASSERT_TRUE(f.upper) << f.reason;
    EXPECT_GT(f.lower, 0.4 * truth);
    EXPECT_LE(f.lower, truth);
    EXPECT_GE(*f.upper, truth);
    EXPECT_LT(*f.upper, 1.1 * truth);
    printf("factor %g in [%g, %g]\n", truth, f.lower, *f.upper);
    const auto json = nlohmann::json::parse(to_json(question, f));
    EXPECT_EQ(json["keep"]["working_modes"], 4);
    EXPECT_EQ(json["other"]["working_modes"], 2);
    EXPECT_THAT(to_table(question, f), HasSubstr("every robot is to keep: aspects 4, assembly modes 2"));
  }
}

TEST(AllRobots, HaveNoCertificateOfAspects) {
  const study::Question question = within_tolerances("dextar.cuik", {{"l", 0.9, 0.001}});
  solve::Control control;
  EXPECT_THROW(aspects(question, {.certificate = true}, control), symbolic::ModelError);
  EXPECT_THROW(aspects(question, {.cusps = true}, control), symbolic::ModelError);
  EXPECT_THROW(topology(question, {.certificate = true}, control), symbolic::ModelError);
}

}  // namespace
}  // namespace corank::analyze
