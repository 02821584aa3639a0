// What a cover says beside its boxes' sides: shapes, lists, counts, and what a report makes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corank/check/distinct.h"
#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using testing::HasSubstr;

constexpr const char* kTwo = "[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\nx^2 = 4;\n";

std::string faults(const System& system, const Cover& cover) {
  const Report report = check(system, cover);
  EXPECT_FALSE(report.verified());
  return text(report);
}

TEST(Report, IsVerifiedWithEveryClaimAndCompleteWithNothingPending) {
  Report good;
  good.proof = {true, true, 1, 1, 0};
  EXPECT_TRUE(good.verified() && good.complete());
  Report report = good;
  report.boxes[static_cast<std::size_t>(Verdict::pending)].unchecked = 1;
  EXPECT_TRUE(report.verified());
  EXPECT_FALSE(report.complete());
  report = good;
  report.proof = {};
  EXPECT_TRUE(report.verified());
  EXPECT_FALSE(report.complete());
  report = good;
  report.points.unchecked = 1;
  EXPECT_FALSE(report.verified()) << "a point that claims something";
  report.points_without_claim = 1;
  EXPECT_TRUE(report.verified());
  for (const Verdict verdict : {Verdict::regular, Verdict::isolated, Verdict::exact, Verdict::boundary, Verdict::partial}) {
    report = good;
    report.boxes[static_cast<std::size_t>(verdict)].unchecked = 1;
    EXPECT_FALSE(report.verified()) << to_string(verdict);
  }
}

class CircleClaims : public testing::Test {
 protected:
  std::string faults() const { return check::faults(system_, cover_); }
  const System system_ = plain(kCircle);
  Cover cover_ = solved(system_, 0.1);
};

TEST_F(CircleClaims, HaveAPositiveSigma) {
  cover_.sigma = {0.1, 0};
  EXPECT_THAT(faults(), HasSubstr("sigma"));
  cover_.sigma = {0, 0.1};
  EXPECT_THAT(faults(), HasSubstr("sigma"));
}

TEST_F(CircleClaims, HaveRegionsWithOneBoundedSideForEachVariable) {
  const auto good = cover_.regions;
  cover_.regions[0].pop_back();
  EXPECT_THAT(faults(), HasSubstr("a region does not have one bounded side"));
  cover_.regions = good;
  cover_.regions[0][0] = {-HUGE_VAL, 2};
  EXPECT_THAT(faults(), HasSubstr("a region does not have one bounded side"));
}

TEST_F(CircleClaims, HaveNoRegionWithoutABox) {
  cover_.regions.push_back(cover_.regions[0]);
  EXPECT_THAT(faults(), HasSubstr("belongs to no box"));
}

TEST_F(CircleClaims, HaveARegionForEachProof) {
  cover_.boxes[0].region = -1;
  EXPECT_THAT(faults(), HasSubstr("no region for it"));
}

TEST_F(CircleClaims, HaveTheDimensionOfTheSet) {
  for (const int dimension : {0, 2}) {
    cover_.dimension = dimension;
    EXPECT_THAT(faults(), HasSubstr("the set has dimension 1")) << dimension;
  }
}

TEST_F(CircleClaims, HaveNoPoints) {
  cover_.points.push_back(cover_.boxes[0]);
  EXPECT_THAT(faults(), HasSubstr("does not consist of points"));
}

TEST_F(CircleClaims, HaveBoxesInOrder) {
  const std::size_t last = cover_.boxes.size() - 1;
  ASSERT_LT(cover_.boxes[0].box[0].lo(), cover_.boxes[last].box[0].lo());
  std::swap(cover_.boxes[0], cover_.boxes[last]);
  EXPECT_THAT(faults(), HasSubstr("order of the sides"));
}

TEST(Claims, AreNoneOfEquationsThatContradictEachOther) {
  const System system = plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx = 1;\n2*x = 3;\n");
  Cover cover;
  cover.sigma = {0.1, 0.1};
  cover.reduction = {Elimination{0, 0}};
  EXPECT_TRUE(check(system, cover).verified()) << text(check(system, cover));
  cover.regions = {{{0, 2}, {0, 1}}};
  cover.boxes = {{{{0, 2}, {0, 1}}, Verdict::regular, {1}, 0}};
  EXPECT_THAT(faults(system, cover), HasSubstr("contradict each other"));
}

// x = −2 and x = 2.
class TwoNumbers : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(cover_.boxes.size(), 2u); }
  std::string faults() const { return check::faults(system_, cover_); }
  // The exact point x = 2 or −2.
  void know(int x) { cover_.exact_points = {{{0, 1}, -1, 1, {{x}}, -1, 0}}; }
  const System system_ = plain(kTwo);
  Cover cover_ = solved(system_, 1e-6);
};

TEST_F(TwoNumbers, AreIsolatedAtTheirExactPoints) {
  know(-2);
  cover_.boxes[0].point = cover_.points[0].point = 0;
  EXPECT_TRUE(check(system_, cover_).verified()) << text(check(system_, cover_));
  know(2);
  EXPECT_THAT(faults(), HasSubstr("lies outside it"));
}

TEST_F(TwoNumbers, HaveAFiniteRadius) {
  know(-2);
  cover_.exact_points[0].sole_within = HUGE_VAL;
  EXPECT_THAT(faults(), HasSubstr("a radius is not a number"));
}

TEST_F(TwoNumbers, AreNotExactByAPointThatIsNone) {
  know(-2);
  cover_.exact_points[0].coordinates[0] = {ExactNumber::rational("-2000001/1000000")};
  cover_.boxes[0].verdict = cover_.points[0].verdict = Verdict::exact;
  cover_.boxes[0].point = cover_.points[0].point = 0;
  cover_.boxes[0].region = cover_.points[0].region = -1;
  const std::string all = faults();
  EXPECT_THAT(all, HasSubstr("does not hold there"));
  EXPECT_THAT(all, HasSubstr("its exact point is not confirmed"));
}

TEST_F(TwoNumbers, AreNoPiecesOfASelfMotion) {
  // An exact box that names one would be none of the points.
  know(-2);
  cover_.boxes[0].verdict = Verdict::exact;
  cover_.boxes[0].point = cover_.boxes[0].motion = 0;
  cover_.boxes[0].region = -1;
  cover_.boxes[0].box[0] = {-2, -2};
  cover_.points.erase(cover_.points.begin());
  cover_.regions.erase(cover_.regions.begin());
  cover_.boxes[1].region = cover_.points[0].region = 0;
  cover_.self_motions = {{1, {}}};
  EXPECT_THAT(faults(), HasSubstr("it names a self-motion"));
}

TEST_F(TwoNumbers, HaveEntriesWithTheirOwnRegions) {
  cover_.points[0].region = cover_.points[1].region;
  EXPECT_THAT(faults(), HasSubstr("has no entry for it"));
}

TEST_F(TwoNumbers, HaveAnEntryForEachBox) {
  cover_.boxes.insert(cover_.boxes.begin(), cover_.boxes[0]);
  EXPECT_THAT(faults(), HasSubstr("the list of points has no entry for it"));
}

TEST_F(TwoNumbers, HaveOpenEntriesThatHoldTheirBoxes) {
  CoverBox open{{{-1, 1}}, Verdict::undecided, {}};
  cover_.boxes.insert(cover_.boxes.begin() + 1, open);
  open.box[0] = {-1.5, 1.5};
  cover_.points.push_back(open);
  EXPECT_TRUE(check(system_, cover_).verified()) << text(check(system_, cover_));
  cover_.points.back().box[0] = {-0.5, 0.5};
  EXPECT_THAT(faults(), HasSubstr("the list of points has no entry for it"));
}

TEST_F(TwoNumbers, HaveNoEntryWithoutABox) {
  cover_.points.push_back({{{4, 5}}, Verdict::undecided, {}});
  EXPECT_THAT(faults(), HasSubstr("there is no box for it"));
}

TEST_F(TwoNumbers, HaveNoEntryThatIsPending) {
  cover_.boxes.insert(cover_.boxes.begin() + 1, {{{-1, 1}}, Verdict::undecided, {}});
  cover_.points.push_back({{{-1, 1}}, Verdict::pending, {}});
  EXPECT_THAT(faults(), HasSubstr("cannot be pending"));
}

TEST_F(TwoNumbers, AreCountedOnceAsBoundaryToo) {
  for (auto* list : {&cover_.boxes, &cover_.points}) {
    for (CoverBox& b : *list) b.verdict = Verdict::boundary;
    list->insert(list->begin(), list->front());
  }
  EXPECT_THAT(faults(), HasSubstr("same solution"));
}

TEST_F(TwoNumbers, HaveNoRegionWhereNothingIsProven) {
  cover_.boxes[0].verdict = Verdict::undecided;
  EXPECT_THAT(faults(), HasSubstr("it names a region"));
}

// (2, 5), isolated and exact at once.
TEST(Claims, TellAnExactPointApartByItsOwnCoordinateOnly) {
  const System system = plain("[SYSTEM VARS]\nx : [0, 9]\ny : [0, 9]\n[SYSTEM EQS]\nx^2 + y = 9;\ny^2 = 25;\n");
  Cover cover = solved(system, 1e-6);
  ASSERT_EQ(cover.boxes.size(), 1u);
  cover.exact_points = {{{0, 1}, -1, 1, {{2}, {5}}, -1, 0}};
  for (auto* list : {&cover.boxes, &cover.points}) {
    CoverBox exact = list->front();
    exact.verdict = Verdict::exact;
    exact.region = -1;
    exact.point = 0;
    list->push_back(exact);
  }
  EXPECT_THAT(faults(system, cover), HasSubstr("same solution"));
}

// A kernel of dimension 2 explains nothing of a set that asks for three kernel vectors.
TEST(Claims, AreExplainedByAKernelAsLargeAsTheSetAsksFor) {
  std::string variables = "[SYSTEM VARS]\nx : [-1, 1]\n", equations = "[SYSTEM EQS]\nx^2 = 0;\n";
  for (const char* k : {"1", "2", "3"}) {
    for (const char* name : {"a", "b", "c"}) variables += std::string(name) + k + " : [-1, 1]\n";
    equations += std::string("3*a") + k + " - x*b" + k + " = 0;\n";
  }
  System system = plain(variables + equations);
  ASSERT_EQ(system.variables.size(), 10u);
  for (std::size_t j = 1; j < 10; ++j) system.variables[j].kind = VariableKind::kernel;
  system.configuration_size = 1;
  Cover cover;
  cover.sigma = {0.1, 0.1};
  Box box(10, Interval(-1, 1));
  cover.boxes = {{box, Verdict::undecided, {}, -1, 0}};
  std::vector<RationalPolynomial> coordinates(10);
  coordinates[0] = {0};
  cover.exact_points = {{{0, 1}, -1, 1, coordinates, 2, 0}};
  system.kernel_vectors = 3;
  EXPECT_THAT(text(check(system, cover)), HasSubstr("not have a kernel of dimension 3"));
}

TEST(MeetingPairs, AreThoseWithAPointInCommon) {
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  const auto never = [](std::size_t, std::size_t) { return false; };
  const auto pairs = [&](const std::vector<Box>& boxes) {
    std::vector<const Box*> all;
    for (const Box& b : boxes) all.push_back(&b);
    return meeting_pairs(all, never, 9);
  };
  EXPECT_EQ(pairs({{{0, 2}, {0, 2}}, {{1, 3}, {1, 3}}}), Pairs({{0, 1}}));
  EXPECT_EQ(pairs({{{0, 1}, {0, 1}}, {{1, 2}, {1, 2}}}), Pairs({{0, 1}}));
  EXPECT_EQ(pairs({{{0, 1}, {0, 1}}, {{0.5, 2}, {1.5, 2}}}), Pairs());
  EXPECT_EQ(pairs({{{0, 10}}, {{1, 2}}, {{3, 4}}}), Pairs({{0, 1}, {0, 2}}));
}

}  // namespace
}  // namespace corank::check
