// The independent checker: what solve() proves it accepts; what is false it rejects.
#include "corank/check/checker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "corank/check/distinct.h"
#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using symbolic::SingularitySet;
using testing::HasSubstr;

constexpr const char* kCirclesAndLine =
    "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-9, 9]\n[SYSTEM EQS]\nx^2 + y^2 = 2;\n3*x - 2*y = 1/3;\nz = x*y + x;\n";

TEST(Checker, AcceptsACircle) { expect_verified(plain(kCircle), solved(plain(kCircle), 0.1)); }

TEST(Checker, AcceptsPointsWithAnEliminatedVariable) {
  const System system = plain(kCirclesAndLine);
  const Cover cover = solved(system, 1e-6);
  ASSERT_EQ(cover.boxes.size(), 2u);
  ASSERT_FALSE(cover.reduction.empty());
  expect_verified(system, cover);
}

TEST(Checker, AcceptsSinesOfLengths) {
  const System system = plain("[SYSTEM VARS]\nt : [0, 20]\nx : [-2, 2]\n[SYSTEM EQS]\nx - sin(t) + 1/5*cos(3*t) = 0;\n");
  expect_verified(system, solved(system, 0.1));
}

// 2/5 lies between two doubles: the boxes of the arc reach to the greater one, and claim what holds up to 2/5.
TEST(Checker, AcceptsFreeSidesThatEndWhereTheRangeDoesAndNoneBeyond) {
  const System system = plain("[SYSTEM VARS]\nx : [-2, 2/5]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n");
  Cover cover = solved(system, 0.1);
  EXPECT_EQ(cover.count(Verdict::boundary), 0u) << "the arc ends there with its free variable";
  expect_verified(system, cover);
  int ends = 0;
  for (CoverBox& box : cover.boxes) {
    if (box.box[0].hi() < 0.4) continue;
    ++ends;
    EXPECT_EQ(box.free, std::vector<int>{0});
    EXPECT_EQ(box.box[0].hi(), system.variables[0].domain.hi());
    box.box[0] = Interval(box.box[0].lo(), std::nextafter(box.box[0].hi(), 1.0));
  }
  EXPECT_EQ(ends, 2);
  EXPECT_EQ(tally(check(system, cover), Verdict::regular).failed, 2u);
}

TEST(Checker, AcceptsASystemWithATolerance) {
  System system = plain(kCirclesAndLine);
  system.coefficient_tolerance = 1e-7;
  expect_verified(system, solved(system, 0.01));
}

TEST(Checker, AcceptsTheSetsOfTheThreeSlider) {
  for (const auto set : {SingularitySet::cspace, SingularitySet::forward, SingularitySet::inverse}) {
    const System system = model("three_slider", set);
    expect_verified(system, solved(system, set == SingularitySet::cspace ? 0.1 : 1e-6));
  }
}

TEST(Checker, AcceptsDextarsForwardLocus) {
  const System system = model("dextar", SingularitySet::forward);
  expect_verified(system, solved(system, 0.25));
}

TEST(Checker, GivesTheSameReportForAnyNumberOfThreads) {
  const System system = model("three_slider", SingularitySet::cspace);
  Cover cover = solved(system, 0.1);
  for (std::size_t i = 0; i < cover.boxes.size(); i += 7) cover.boxes[i].region = -1;
  Options four;
  four.threads = 4;
  EXPECT_EQ(text(check(system, cover)), text(check(system, cover, four)));
}

// Stopped before it begins, or as soon as the progress says so.
Report stopped(const System& system, const Cover& cover, const std::function<bool(const Progress&)>& at) {
  std::atomic<bool> stop = at({});
  Options options;
  options.ended = [&stop] { return stop.load(); };
  options.progress = [&](const Progress& p) { stop = stop || at(p); };
  return check(system, cover, options);
}

TEST(Checker, EndsWhereItIsStoppedAndNamesTheStage) {
  const System system = plain(kCircle);
  solve::Options options;
  options.sigma = 0.01;
  options.proof = true;
  const Cover cover = solve::solve(system, options);
  const Report first = stopped(system, cover, [](const Progress&) { return true; });
  EXPECT_TRUE(first.interrupted);
  EXPECT_EQ(first.stage, "the reduction");
  const Report second = stopped(system, cover, [](const Progress& p) { return p.boxes > 0; });
  EXPECT_EQ(second.stage, "the boxes");
  EXPECT_GE(tally(second, Verdict::regular).verified, 1u);
  EXPECT_LT(tally(second, Verdict::regular).verified, cover.boxes.size());
  const Report third = stopped(system, cover, [](const Progress& p) { return p.steps > 0; });
  EXPECT_EQ(third.stage, "the proof of completeness");
  EXPECT_EQ(tally(third, Verdict::regular).verified, cover.boxes.size());
  for (const Report& report : {first, second, third}) EXPECT_FALSE(report.verified() || report.complete());
  const Report last = stopped(system, cover, [](const Progress&) { return false; });
  EXPECT_TRUE(last.verified() && last.complete()) << text(last);
}

TEST(Checker, VerifiesWithoutAProofButNotThatNothingIsMissing) {
  const Report report = check(plain(kCircle), solved(plain(kCircle), 0.1));
  EXPECT_TRUE(report.verified());
  EXPECT_FALSE(report.complete());
}

TEST(Checker, HoldsNothingAgainstBoxesThatClaimNothing) {
  Cover cover = solved(plain(kCircle), 0.1);
  const std::size_t n = cover.boxes.size();
  const auto unclaimed = [&](Verdict verdict) {
    Cover changed = cover;
    const int region = changed.boxes[0].region;
    for (CoverBox& b : changed.boxes)
      if (b.region == region) b.verdict = verdict, b.free.clear(), b.region = -1;
    changed.regions.erase(changed.regions.begin() + region);
    for (CoverBox& b : changed.boxes) b.region -= b.region > region;
    return check(plain(kCircle), changed);
  };
  for (const Verdict verdict : {Verdict::undecided, Verdict::pending}) {
    const Report report = unclaimed(verdict);
    EXPECT_GE(tally(report, verdict).unchecked, 1u);
    EXPECT_TRUE(report.verified()) << text(report);
    EXPECT_LT(tally(report, Verdict::regular).verified, n);
  }
  EXPECT_FALSE(unclaimed(Verdict::partial).verified()) << "a claim that cannot be checked";
}

// --- what is false ---

std::string reasons(const System& system, const Cover& cover) {
  const Report report = check(system, cover);
  EXPECT_FALSE(report.verified());
  return text(report);
}

TEST(Checker, RejectsAnotherSystem) {
  const Cover cover = solved(plain(kCircle), 0.1);
  EXPECT_THAT(reasons(plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1.01;\n"), cover),
              HasSubstr("outside it"));
}

TEST(Checker, RejectsABoxThatItsSolutionsLeave) {
  const System system = plain(kCircle);
  for (const double share : {0.01, 0.3}) {
    Cover cover = solved(system, 0.1);
    CoverBox& box = cover.boxes[first(cover, Verdict::regular)];
    ASSERT_EQ(box.free.size(), 1u);
    const Interval along = box.box[static_cast<std::size_t>(box.free[0])];
    Interval& side = box.box[static_cast<std::size_t>(1 - box.free[0])];
    // The ends of the arc over the free side, which a little is cut off of.
    const double from = std::sqrt(1 - along.lo() * along.lo()), to = std::sqrt(1 - along.hi() * along.hi());
    const double greatest = side.lo() > 0 ? std::max(from, to) : -std::min(from, to);
    side = {side.lo(), greatest - share * std::fabs(from - to)};
    EXPECT_NE(reasons(system, cover), "") << share;
  }
}

TEST(Checker, RejectsABoxOutsideItsRegion) {
  const System system = plain(kCircle);
  Cover cover = solved(system, 0.1);
  CoverBox& box = cover.boxes.back();
  box.box[static_cast<std::size_t>(box.free.at(0))] = {-2, 2};
  EXPECT_THAT(reasons(system, cover), HasSubstr("not inside the region"));
}

TEST(Checker, RejectsARegionWithTwoSolutions) {
  const System system = plain(kCircle);
  Cover cover = solved(system, 0.1);
  for (Box& region : cover.regions) region = {{-2, 2}, {-2, 2}};
  EXPECT_THAT(reasons(system, cover), HasSubstr("the Jacobian is singular"));
  for (Box& region : cover.regions) region = {{-2, 2}, {-2, 1.9}};
  EXPECT_THAT(reasons(system, cover), HasSubstr("is not shown"));
}

TEST(Checker, RejectsAWiderDomainThanThatOfTheModel) {
  // In x ≤ 1/2 the pieces beyond are none of the set's; regular says that they are.
  const System system = plain("[SYSTEM VARS]\nx : [-2, 1/2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n");
  EXPECT_THAT(reasons(system, solved(plain(kCircle), 0.1)), HasSubstr("domain of x"));
}

TEST(Checker, RejectsAViolatedInequality) {
  const System system = plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nx + y <= 1;\n");
  EXPECT_THAT(reasons(system, solved(plain(kCircle), 0.1)), HasSubstr("an inequality"));
}

// Repeats that are dropped, sums with irrational coefficients, sums of what was summed: the checker's reduction is the
// solver's.
TEST(Checker, RepeatsTheReductionsOfSystemsWithSums) {
  const std::string variables = "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-2, 2]\n[SYSTEM EQS]\n";
  for (const char* equations : {
           "x^2 + y^2 = 1;\nx^2 + y^2 + z^2 - z*x = 2;\n3*x^2 + 3*y^2 + 3*z^2 - 3*z*x = 6;\n",
           "3*x^2 + 3*y^2 + 3*z^2 - 3*z*x = 6;\nx^2 + y^2 + z^2 - z*x = 2;\nx^2 + y^2 = 1;\n",
           "x^2 + sqrt(2)*y^2 + z = 1;\n3*x^2 + 3*sqrt(2)*y^2 + 3*z - x*y = 5/2;\n",
           "x^2 + (7/10 - sqrt(2))*y^2 + z^2 = 1;\n2*x^2 + 2*(7/10 - sqrt(2))*y^2 + 2*z^2 - x*y + z = 2;\n",
           "x^2 + sqrt(2)*y^2 + z^2 = 1;\n2*x^2 + sqrt(8)*y^2 + 2*z^2 - x*y = 5/2;\n",
       }) {
    const System system = plain(variables + equations);
    const Report report = check(system, solved(system, 0.2));
    EXPECT_TRUE(report.verified()) << equations << text(report);
  }
}

TEST(Checker, RejectsIllegalEliminations) {
  const System system = plain(kCirclesAndLine);
  const Cover good = solved(system, 1e-6);
  const auto with = [&](std::vector<ReductionStep> steps) {
    Cover cover = good;
    cover.reduction = std::move(steps);
    return reasons(system, cover);
  };
  EXPECT_THAT(with({Elimination{0, 0}}), HasSubstr("does not define it"));
  EXPECT_THAT(with({Elimination{0, {}}}), HasSubstr("more than one number"));
  EXPECT_THAT(with({Elimination{0, 1}, Elimination{0, 2}}), HasSubstr("gone already"));
  EXPECT_THAT(with({Elimination{0, 1}, Elimination{1, 1}}), HasSubstr("has been used"));
  EXPECT_THAT(with({Elimination{7, 1}}), HasSubstr("no variable"));
  EXPECT_THAT(with({SumOfEquations{0, 0, 1}}), HasSubstr("it does not name two different equations"));
  EXPECT_THAT(with({SumOfEquations{0, 9, 1}}), HasSubstr("it does not name two different equations"));
  EXPECT_THAT(with({Elimination{0, 1}, SumOfEquations{0, 1, 1}}), HasSubstr("it does not name two different equations"));
  EXPECT_THAT(with({SumOfEquations{0, 1, ExactNumber::pi()}}), HasSubstr("not rational"));
  const auto implied = [](int equation, const ExactNumber& factor, std::vector<Factor> product) {
    return ImpliedEquation{{{equation, factor, std::move(product)}}};
  };
  EXPECT_THAT(with({implied(9, 1, {})}), HasSubstr("not there"));
  EXPECT_THAT(with({implied(-1, 1, {})}), HasSubstr("not there"));
  EXPECT_THAT(with({implied(3, 1, {})}), HasSubstr("not there")) << "itself";
  EXPECT_THAT(with({Elimination{0, 1}, implied(1, 1, {})}), HasSubstr("has been used"));
  EXPECT_THAT(with({implied(0, ExactNumber::pi(), {})}), HasSubstr("not rational"));
  EXPECT_THAT(with({implied(0, 1, {{7, 1}})}), HasSubstr("variables that are kept"));
  EXPECT_THAT(with({implied(0, 1, {{0, 0}})}), HasSubstr("variables that are kept"));
  EXPECT_THAT(with({implied(0, 1, {{0, 1, Function::sine}})}), HasSubstr("variables that are kept"));
  EXPECT_THAT(with({Elimination{0, 1}, implied(0, 1, {{0, 1}})}), HasSubstr("variables that are kept"));
  EXPECT_THAT(with({implied(0, 1, {{0, 1}}), SumOfEquations{0, 2, 1}}), HasSubstr("after an implied equation"));
  EXPECT_THAT(with({implied(0, 1, {{0, 1}}), Elimination{0, 1}}), HasSubstr("after an implied equation"));
}

TEST(Checker, RejectsSwappedBoxesAndPointsThatAreNone) {
  const System system = plain(kCirclesAndLine);
  const Cover good = solved(system, 1e-6);
  Cover cover = good;
  std::swap(cover.boxes[0], cover.boxes[1]);
  EXPECT_THAT(reasons(system, cover), HasSubstr("order of the sides"));
  cover = good;
  cover.points.pop_back();
  EXPECT_THAT(reasons(system, cover), HasSubstr("has no entry for it"));
  cover = good;
  cover.points.push_back(cover.points[0]);
  EXPECT_THAT(reasons(system, cover), HasSubstr("same solution"));
  cover = good;
  cover.boxes.insert(cover.boxes.begin(), cover.boxes[0]);
  cover.points.insert(cover.points.begin(), cover.points[0]);
  EXPECT_THAT(reasons(system, cover), HasSubstr("same solution"));
}

TEST(Checker, RejectsSidesThatAreNoNumbers) {
  const System system = plain(kCircle);
  Cover cover = solved(system, 0.1);
  cover.boxes[0].box[0] = {-HUGE_VAL, 1};
  EXPECT_THAT(reasons(system, cover), HasSubstr("bounded side"));
}

// --- exact points ---

// The three-slider with L1 = L2 = 1 has its forward singularities at (0, 0, ±1) and (±1, ±1, 0): y_A, y_B, x_C.
class ThreeSlider : public testing::Test {
 protected:
  void SetUp() override {
    system_ = model("three_slider", SingularitySet::forward, {{"L2", "1"}});
    cover_ = solved(system_, 1e-6);
    const auto undecided = first(cover_, Verdict::undecided);
    const bool below = cover_.boxes[undecided].box[2].hi() < 0;
    // The half-space of the kernel's sign: xi1 = ±1.
    const double xi1 = cover_.boxes[undecided].box[3].mid();
    const RationalPolynomial x_c{below ? -1 : 1}, xi{xi1 < 0 ? -1 : 1};
    cover_.exact_points = {{{0, 1}, -1, 1, {{0}, {0}, x_c, xi, {0}}, 1, 1e-3}};
    // Of the undecided boxes around the point only those that hold it are claimed.
    for (CoverBox& b : cover_.boxes)
      if (b.verdict == Verdict::undecided && holds(b.box, x_c)) b.verdict = Verdict::exact, b.point = 0;
    for (CoverBox& p : cover_.points)
      if (p.verdict == Verdict::undecided && holds(p.box, x_c)) p.verdict = Verdict::exact, p.point = 0;
  }
  static bool holds(const Box& box, const RationalPolynomial& x_c) {
    return box[2].contains(x_c[0].enclose()) && box[0].contains(0.0) && box[1].contains(0.0) && box[4].contains(0.0);
  }
  Report report() const { return check(system_, cover_); }
  ExactPoint& point() { return cover_.exact_points[0]; }

  System system_;
  Cover cover_;
};

TEST_F(ThreeSlider, HasAnExactPoint) {
  EXPECT_GE(tally(report(), Verdict::exact).verified, 1u);
  EXPECT_EQ(tally(report(), Verdict::exact).failed, 0u) << text(report());
  EXPECT_EQ(report().exact_points, (Tally{1, 0, 0})) << text(report());
}

TEST_F(ThreeSlider, HasNoPointThatViolatesAnEquation) {
  point().coordinates[1] = {number("1/10000000000000000")};
  EXPECT_THAT(text(report()), HasSubstr("does not hold there"));
}

TEST_F(ThreeSlider, HasNoPointWithAnotherKernel) {
  for (const int corank : {0, 2}) {
    point().corank = corank;
    EXPECT_THAT(text(report()), HasSubstr("the kernel's dimension is 1")) << corank;
  }
}

TEST_F(ThreeSlider, HasNoPointOutsideItsBox) {
  point().coordinates[2] = {-point().coordinates[2][0]};
  EXPECT_THAT(text(report()), HasSubstr("x_C of its exact point lies outside it"));
}

TEST_F(ThreeSlider, HasNoPointOfAnUndefinedNumber) {
  point().lower = 0;
  EXPECT_THAT(text(report()), HasSubstr("opposite signs"));
  point().lower = -1;
  point().polynomial = {0, number("-1/4"), 0, 1};  // roots 0, ±1/2
  EXPECT_THAT(text(report()), HasSubstr("exactly one root"));
  point().polynomial = {5};
  EXPECT_THAT(text(report()), HasSubstr("not defined"));
}

TEST_F(ThreeSlider, HasNoPointOfUnknownCoordinates) {
  point().coordinates[3].clear();
  point().sole_within = 0;
  EXPECT_THAT(text(report()), HasSubstr("says nothing of xi1"));
}

TEST_F(ThreeSlider, HasNoOtherSolutionNearThePoint) { EXPECT_EQ(report().exact_points, (Tally{1, 0, 0})) << text(report()); }

TEST_F(ThreeSlider, HasOtherSolutionsFarFromThePoint) {
  point().sole_within = 1.5;  // (±1, ±1, 0) are as near as that
  EXPECT_THAT(text(report()), HasSubstr("it is not shown that no other solution is near it"));
}

// x = y = √(1/2), z = x + x²: t² = 1/2.
class RootOfTwo : public testing::Test {
 protected:
  void SetUp() override {
    system_ = plain(
        "[SYSTEM VARS]\nx : [0, 2]\ny : [-2, 2]\nz : [-9, 9]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nx*y = 1/2;\nz = x + x^2;\n");
    const double t = std::sqrt(0.5);
    const Interval side(t - 1e-7, t + 1e-7);  // the point is alone within 1/4
    cover_.boxes.push_back({{side, side, {1.2, 1.21}}, Verdict::exact, {}, -1, 0});
    cover_.points = cover_.boxes;
    cover_.sigma = {0.1, 0.1};
    cover_.exact_points = {{{number("-1/2"), 0, 1}, 0, 1, {{0, 1}, {0, 1}, {number("1/2"), 1}}, -1, 0.25}};
    cover_.reduction = {Elimination{2, 2}};
  }
  System system_;
  Cover cover_;
};

TEST_F(RootOfTwo, IsVerified) {
  const Report report = check(system_, cover_);
  EXPECT_TRUE(report.verified()) << text(report);
  EXPECT_EQ(tally(report, Verdict::exact), (Tally{1, 0, 0}));
}

TEST_F(RootOfTwo, IsNotItsConjugate) {
  cover_.exact_points[0].lower = -1;
  cover_.exact_points[0].upper = 0;
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("not shown to lie in its domain"));
}

TEST_F(RootOfTwo, IsNoRootOfAnotherPolynomial) {
  cover_.exact_points[0].polynomial = {number("-50000000001/100000000000"), 0, 1};
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("does not hold there"));
}

TEST_F(RootOfTwo, IsTheOnlySolutionNearby) {
  EXPECT_TRUE(check(system_, cover_).verified()) << text(check(system_, cover_));
  cover_.exact_points[0].sole_within = 3;  // −√(1/2) twice
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("it is not shown that no other solution is near it"));
}

TEST_F(RootOfTwo, HasABoxNoLargerThanWhereItIsAlone) {
  for (const double radius : {0.0, 1e-8}) {
    cover_.exact_points[0].sole_within = radius;
    EXPECT_THAT(text(check(system_, cover_)), HasSubstr("beyond the distance at which")) << radius;
  }
}

TEST_F(RootOfTwo, HasAnEntryOfThePointsNoLargerThanWhereItIsAlone) {
  cover_.points[0].box[0] = {-1, 1};  // −√(1/2), too
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("beyond the distance at which"));
}

TEST_F(RootOfTwo, HasNoCoordinatesBeyondReason) {
  for (auto& x : cover_.exact_points[0].coordinates) x = {pow(ExactNumber(2), 60'000)};
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("100000 bits"));
}

TEST(MeetingPairs, GoBeyondThoseThatAreToldApart) {
  const Box a{{0, 2}}, b{{1, 3}}, c{{2, 4}};
  const auto first_two = [](std::size_t i, std::size_t k) { return i + k == 1; };
  const std::vector<std::pair<std::size_t, std::size_t>> expected{{0, 2}};
  EXPECT_EQ(meeting_pairs({&a, &b, &c}, first_two, 1), expected);
}

TEST_F(RootOfTwo, IsCountedOnce) {
  cover_.boxes.push_back(cover_.boxes[0]);
  cover_.points.push_back(cover_.points[0]);
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("same solution"));
}

// An undecided box around a configuration whose kernel is a plane: M = diag(x, y, x) at the origin … has rank 0 but for its
// last entry.
class Plane : public testing::Test {
 protected:
  void SetUp() override {
    system_ = plain(
        "[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\na : [-1, 1]\nb : [-1, 1]\nc : [-1, 1]\n"
        "[SYSTEM EQS]\nx^2 + y^2 = 0;\nx*a + y*b = 0;\ny*a - x*b = 0;\n3*c - x*a = 0;\na^2 + b^2 + c^2 = 1;\n");
    for (std::size_t j = 2; j < 5; ++j) system_.variables[j].kind = VariableKind::kernel;
    system_.configuration_size = 2;
    const Interval all(-1, 1), zero(-1e-9, 1e-9);
    cover_.boxes.push_back({{zero, zero, all, all, all}, Verdict::undecided, {}, -1, 0});
    cover_.points = cover_.boxes;
    cover_.sigma = {0.1, 0.1};
    cover_.exact_points = {{{0, 1}, -1, 1, {{0}, {0}, {}, {}, {}}, 2, 0}};
  }
  System system_;
  Cover cover_;
};

TEST_F(Plane, ExplainsAnUndecidedBox) {
  const Report report = check(system_, cover_);
  EXPECT_TRUE(report.verified()) << text(report);
  EXPECT_EQ(tally(report, Verdict::undecided), (Tally{1, 0, 0}));
}

TEST_F(Plane, HasNotAnotherDimension) {
  for (const int corank : {1, 3}) {
    cover_.exact_points[0].corank = corank;
    EXPECT_THAT(text(check(system_, cover_)), HasSubstr("the kernel's dimension is 2"));
  }
  cover_.exact_points[0].corank = -1;
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("not have a kernel of dimension 2"));
}

TEST_F(Plane, IsNotExplainedInTheListOfPointsAlone) {
  cover_.boxes[0].point = -1;
  cover_.exact_points[0].corank = -1;
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("not have a kernel of dimension 2"));
}

TEST_F(Plane, HasNoSmallerKernelInTheListOfPoints) {
  cover_.points[0].kernel_at_most = 1;
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("a dimension above 1 is not excluded"));
}

TEST_F(Plane, IsNotElsewhere) {
  cover_.boxes[0].box[0] = cover_.points[0].box[0] = {0.1, 0.2};
  EXPECT_THAT(text(check(system_, cover_)), HasSubstr("lies outside it"));
}

}  // namespace
}  // namespace corank::check
