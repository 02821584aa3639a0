// Sets of larger dimension than the count of equations says: the rhombus four-bar, whose coupler turns freely where its
// crank is folded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corank/check/checker.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/models/exactly_solved.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::exactly_solved;
using test::holds;

// All four bars of one length, in the given unit: r cos t1 + r cos t2 = r + r cos t3, r sin t1 + r sin t2 = r sin t3.
System rhombus(SingularitySet set, const std::string& length) {
  const auto model =
      symbolic::parse_model("[CONSTANTS]\nr := " + length +
                                "\n[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\n[SYSTEM EQS]\n"
                                "r*cos(t1) + r*cos(t2) = r + r*cos(t3);\nr*sin(t1) + r*sin(t2) = r*sin(t3);\n"
                                "[INPUTS] t1\n[OUTPUTS] t3\n",
                            "rhombus.cuik");
  return symbolic::algebrize(symbolic::singularity_system(model, set));
}

// Closed form: with t1 = 0 locked, t3 = t2 and t2 is any angle; else t1 = ±pi, t2 = 0, t3 = ±pi.
TEST(SelfMotion, OfTheRhombusIsProvenWithItsDimensionAndItsRelations) {
  for (const char* length : {"1", "1000", "1/1000"}) {
    const System system = rhombus(SingularitySet::forward, length);
    const Cover cover = exactly_solved(system);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.dimension, 0);
    EXPECT_EQ(cover.count(Verdict::undecided), 0u) << length;
    EXPECT_EQ(cover.count(Verdict::exact), 1u);
    ASSERT_EQ(cover.points.size(), 1u) << "a curve is no point";
    ASSERT_EQ(cover.self_motions.size(), 1u);
    EXPECT_EQ(cover.self_motions[0].dimension, 1);
    EXPECT_EQ(cover.self_motions[0].relations.size(), 5u);
    std::size_t on_it = 0;
    for (const CoverBox& box : cover.boxes) {
      if (box.motion < 0) continue;
      ++on_it;
      EXPECT_EQ(box.verdict, Verdict::regular);
      EXPECT_EQ(box.free.size(), 1u);
    }
    EXPECT_EQ(on_it + 1, cover.boxes.size());
    for (int k = 0; k < 500; ++k) {
      const double t = -3.14 + 6.28 * k / 500;
      const std::vector<double> q{1, 0, std::cos(t), std::sin(t), std::cos(t), std::sin(t)};
      EXPECT_TRUE(std::any_of(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& b) { return holds(b, q); })) << t;
    }
    const auto report = check::check(system, cover);
    EXPECT_TRUE(report.consistent()) << (report.failures.empty() ? "" : report.failures[0].reason);
    EXPECT_EQ(report.boxes[static_cast<int>(Verdict::regular)].verified, on_it);
  }
}

System cusps(const char* model, SingularitySet set, const std::vector<result::ConstantOverride>& constants) {
  const study::Model read = study::read_model(std::string(CORANK_SOURCE_DIR "/models/") + model + ".cuik", constants);
  return study::system({.model = read.mechanism, .set = set, .assembly = read.assembly});
}

// A multiple of a length that is rational is so in every unit: as a fraction of short numbers, times a power of ten.
TEST(SelfMotion, HasTheSameRelationsInAnotherUnit) {
  const Cover thousandth =
      solve::solve(cusps("dextar", SingularitySet::forward_cusps, {{"l", "9/10000"}, {"d", "118/100000"}}));
  EXPECT_GT(thousandth.count(Verdict::regular), 0u);
  EXPECT_EQ(thousandth.count(Verdict::undecided), 0u);
  EXPECT_EQ(thousandth.self_motions.size(), 1u);
}

// Constants with irrational values: the ratio of a large and a small one is near to a fraction of a long and a short number.
TEST(SelfMotion, HasNoRelationsThatALongNumberMakes) {
  const System system = cusps("3rrr_fixed_orientation", SingularitySet::inverse_cusps,
                              {{"b", "2000000"}, {"p", "500000"}, {"l1", "1000000"}, {"l2", "1000000"}});
  solve::Options options;
  options.sigma_length = 1e4, options.sigma_angle = 0.1;
  options.roots = {system.domain()};  // where the third leg is folded: x and y are those of its base, in that orientation
  options.roots[0][static_cast<std::size_t>(system.find("x"))] = Interval(895'000, 897'000);
  options.roots[0][static_cast<std::size_t>(system.find("y"))] = Interval(1'242'000, 1'244'000);
  const Cover cover = solve::solve(system, options);
  EXPECT_GT(cover.count(Verdict::regular), 0u);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
}

TEST(SelfMotion, IsNotVerifiedWithARelationThatDoesNotHold) {
  const System system = rhombus(SingularitySet::inverse, "1");
  const Cover good = exactly_solved(system);
  ASSERT_EQ(good.self_motions.size(), 1u);
  EXPECT_TRUE(check::check(system, good).consistent());
  for (std::size_t k = 0; k < good.self_motions[0].relations.size(); ++k) {
    Cover changed = good;
    Polynomial& f = changed.self_motions[0].relations[k];
    f.monomials[0].coefficient = f.monomials[0].coefficient * ExactNumber(2);
    if (f.monomials.size() == 1) f.monomials.emplace_back(ExactNumber(1), std::vector<Factor>{});
    EXPECT_FALSE(check::check(system, changed).consistent()) << k;
    changed = good;
    changed.self_motions[0].relations.erase(changed.self_motions[0].relations.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_FALSE(check::check(system, changed).consistent()) << k;
  }
  Cover larger = good;
  larger.self_motions[0].dimension = 2;
  EXPECT_FALSE(check::check(system, larger).consistent());
}

}  // namespace
}  // namespace corank
