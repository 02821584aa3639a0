// Self-motions: relations that leave more equations than is said, and other solutions beside them.
#include "corank/check/self_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using testing::HasSubstr;

Polynomial relation(std::initializer_list<std::pair<int, std::vector<Factor>>> terms) {
  Polynomial f;
  for (const auto& [c, factors] : terms) f.monomials.emplace_back(ExactNumber(c), factors);
  return f;
}
const Polynomial kEqual = relation({{1, {{0, 1}}}, {-1, {{1, 1}}}});  // x = y

std::string fault(const System& system, const SelfMotionRecord& record, const std::vector<ReductionStep>& reduction = {}) {
  const Problem problem(system, reduction);
  return MotionCheck(problem, record).fault();
}

// (x − y)(x − 2) = 0 and (x − y)(y − 3) = 0: the line x = y, and the point (2, 3).
class LineAndPoint : public testing::Test {
 protected:
  // A piece of the line over x ∈ [1.9, 2.1].
  Cover piece(const Interval& region) const {
    const Interval x(1.9, 2.1), y(1.85, 2.15);
    Cover cover;
    cover.sigma = {1, 1};
    cover.dimension = 0;
    cover.self_motions = {{1, {kEqual}}};
    cover.regions = {{x, region}};
    CoverBox box{{x, y}, Verdict::regular, {0}, 0};
    box.motion = 0;
    cover.boxes = {box};
    return cover;
  }
  const System system_ = plain(
      "[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\nx^2 - x*y - 2*x + 2*y = 0;\nx*y - y^2 - 3*x + 3*y = 0;\n");
};

TEST_F(LineAndPoint, HasTheLineAsASelfMotion) {
  EXPECT_EQ(fault(system_, {1, {kEqual}}), "");
  const Report report = check(system_, piece({1.7, 2.3}));
  EXPECT_TRUE(report.verified()) << text(report);
}

TEST_F(LineAndPoint, HasNotOneSolutionWhereThePointIsBesideTheLine) {
  EXPECT_THAT(text(check(system_, piece({1, 4}))), HasSubstr("uniqueness along its self-motion"));
}

TEST_F(LineAndPoint, HasNoSelfMotionOfAnotherDimension) {
  EXPECT_THAT(fault(system_, {2, {kEqual}}), HasSubstr("not make a set of dimension"));
  for (const int dimension : {0, 2}) {
    EXPECT_NE(fault(system_, {dimension, {kEqual}}), "") << dimension;
    Cover cover = piece({1.7, 2.3});
    cover.self_motions[0].dimension = dimension;
    EXPECT_THAT(text(check(system_, cover)), HasSubstr("its self-motion is not shown to be one")) << dimension;
  }
}

// The count of the equations says dimension 0: points are no self-motion, whose pieces are not counted.
TEST_F(LineAndPoint, HasNoSelfMotionThatIsAPoint) {
  const Polynomial two = relation({{1, {{0, 1}}}, {-2, {}}}), three = relation({{1, {{1, 1}}}, {-3, {}}});
  EXPECT_THAT(fault(system_, {0, {two, three}}), HasSubstr("not larger than the number of equations"));
  const Interval x(1.9, 2.1), y(2.9, 3.1);
  Cover cover;
  cover.sigma = {1, 1};
  cover.self_motions = {{0, {two, three}}};
  cover.regions = {{{1.5, 2.5}, {2.6, 3.4}}};
  CoverBox box{{x, y}, Verdict::isolated, {}, 0};
  box.motion = 0;
  cover.boxes = {box, box};
  EXPECT_THAT(text(check(system_, cover)), HasSubstr("its self-motion is not shown to be one"));
}

TEST_F(LineAndPoint, HasNoSelfMotionOfOtherRelations) {
  const Polynomial other = relation({{1, {{0, 1}}}, {-2, {{1, 1}}}});  // x = 2 y
  EXPECT_THAT(fault(system_, {1, {other}}), HasSubstr("not make a set of dimension"));
  const Polynomial parabola = relation({{1, {{0, 1}}}, {-1, {{1, 2}}}});
  EXPECT_THAT(fault(system_, {1, {parabola}}), HasSubstr("not linear"));
  EXPECT_THAT(fault(system_, {1, {relation({{1, {{7, 1}}}})}}), HasSubstr("variables that were kept"));
}

// The line, and with it the point where y may be 3, over x ∈ [1.9, 2.1]; all of it is said to lie in one box.
class OneLeaf : public testing::Test {
 protected:
  Report replayed(const std::string& upper_y, const std::function<void(CoverBox&)>& change = {}, int box = 0) const {
    const System system = plain("[SYSTEM VARS]\nx : [1.9, 2.1]\ny : [1.5, " + upper_y +
                                "]\n[SYSTEM EQS]\nx^2 - x*y - 2*x + 2*y = 0;\nx*y - y^2 - 3*x + 3*y = 0;\n");
    Cover cover;
    cover.sigma = {1, 1};
    cover.self_motions = {{1, {kEqual}}};
    cover.regions = {{{1.9, 2.1}, {1.7, 2.3}}};
    cover.boxes = {CoverBox{{{1.9, 2.1}, {1.85, 2.15}}, Verdict::regular, {0}, 0}};
    cover.boxes[0].motion = 0;
    if (change) change(cover.boxes[0]);
    Proof proof;
    proof.roots = {{{1.9, 2.1}, {1, 4}}};
    proof.steps = {static_cast<std::uint8_t>(Proof::Step::box)};
    proof.integers = {box};
    cover.proof = std::make_shared<const Proof>(std::move(proof));
    return check(system, cover);
  }
};

TEST_F(OneLeaf, HoldsWhatItsBoxClaimsOfItsRegion) {
  const Report report = replayed("2.5");
  EXPECT_TRUE(report.complete()) << text(report);
}

TEST_F(OneLeaf, HoldsNoSolutionBesideItsRegion) {
  const Report report = replayed("3.2");
  EXPECT_FALSE(report.proof.verified);
  EXPECT_TRUE(report.proof.open);
  EXPECT_TRUE(report.verified()) << "what the box claims";
  EXPECT_FALSE(report.complete());
}

TEST_F(OneLeaf, IsOfNoUseWhereItsScriptIsMalformed) {
  const Report report = replayed("2.5", {}, 7);
  EXPECT_FALSE(report.proof.open);
  EXPECT_FALSE(report.verified());
}

TEST_F(OneLeaf, HoldsNoOtherValuesOfTheFreeVariables) {
  EXPECT_FALSE(replayed("2.5", [](CoverBox& box) { box.box[0] = {1.9, 2.05}; }).proof.verified);
}

TEST_F(OneLeaf, HoldsNoMoreThanItsSidesWhereTheBoxClaimsNothing) {
  const auto undecided = [](double upper) {
    return [upper](CoverBox& box) {
      box.verdict = Verdict::undecided;
      box.free = {};
      box.box[1] = {1.85, upper};
    };
  };
  EXPECT_FALSE(replayed("2.5", undecided(2)).proof.verified);
  EXPECT_TRUE(replayed("2.5", undecided(2.15)).proof.verified);
}

// (x − y)(2 x + y − 7) = 0, and x/9 times that: the other line meets the region in the upper half only.
TEST(SelfMotion, IsUniqueOverEveryPartOfItsFreeSide) {
  const System system = plain(
      "[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\n2*x^2 - x*y - y^2 - 7*x + 7*y = 0;\n"
      "2/9*x^3 - 1/9*x^2*y - 1/9*x*y^2 - 7/9*x^2 + 7/9*x*y = 0;\n");
  const Problem problem(system, {});
  const MotionCheck motion(problem, {1, {kEqual}});
  ASSERT_EQ(motion.fault(), "");
  const auto unique = [&](double to) {
    const Interval x(1, to), y(0.95, to + 0.05);
    return motion.unique({{x, y}, Verdict::regular, {0}, 0}, {x, {0.9, 2.7}});
  };
  EXPECT_EQ(unique(1.4), "");
  EXPECT_NE(unique(2.6), "");
}

// On z = 0 two different equations are left, x² + y² = 1 and x² + 2 y² = 1: points.
TEST(SelfMotion, KeepsEveryEquationThatItsRelationsLeave) {
  const System system = plain(
      "[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nz : [-9, 9]\n"
      "[SYSTEM EQS]\nx^2 + y^2 = 1;\nx^2 + 2*y^2 = 1;\nx*z = 0;\n");
  const Polynomial flat = relation({{1, {{2, 1}}}});
  EXPECT_THAT(fault(system, {1, {flat}}), HasSubstr("leave 2 equations"));
  const Problem problem(system, {});
  EXPECT_EQ(MotionCheck(problem, {0, {flat}}).rows().size(), 3u);
}

TEST(SelfMotion, IsNoneOfVariablesThatAreGoneOrOfEquationsWithATolerance) {
  System system = plain(
      "[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nz : [-9, 9]\nw : [-9, 9]\n"
      "[SYSTEM EQS]\n1/3*x^2 + z^2 = 1;\nx^2 - x*y = 0;\nw = x^2 + 1;\nx*y - y^2 = 0;\n");
  EXPECT_EQ(fault(system, {1, {kEqual}}, {Elimination{3, 2}}), "");
  EXPECT_THAT(fault(system, {1, {relation({{1, {{0, 1}}}, {-1, {{3, 1}}}})}}, {Elimination{3, 2}}), HasSubstr("were kept"));
  system.coefficient_tolerance = 1e-3;
  EXPECT_THAT(fault(system, {1, {kEqual}}, {Elimination{3, 2}}), HasSubstr("tolerance"));
}

}  // namespace
}  // namespace corank::check
