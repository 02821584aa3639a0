// The replay of a proof of completeness: scripts by hand and by a small recorder are accepted, and none that leaves a
// solution out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corank/tests/check/covers.h"
#include "corank/tests/check/recorder.h"

namespace corank::check {
namespace {

using symbolic::SingularitySet;
using testing::HasSubstr;
using Step = Proof::Step;

// A script as one writes it down.
class Script {
 public:
  explicit Script(std::vector<Interval> root) { proof_.roots = {std::move(root)}; }
  Script& root(std::vector<Interval> root) {
    proof_.roots.push_back(std::move(root));
    return *this;
  }
  Script& add(Step step, std::initializer_list<int> integers = {}, std::initializer_list<double> reals = {}) {
    proof_.steps.push_back(static_cast<std::uint8_t>(step));
    proof_.integers.insert(proof_.integers.end(), integers.begin(), integers.end());
    proof_.reals.insert(proof_.reals.end(), reals.begin(), reals.end());
    return *this;
  }
  Script& combination(Proof::Combination c) {
    proof_.combinations.push_back(std::move(c));
    return *this;
  }
  Proof& proof() { return proof_; }

 private:
  Proof proof_;
};

const std::vector<Interval> kSquare{{-2, 2}, {-2, 2}};

// x² + y² = 1 and x = y: two points, each in an undecided box.
class TwoPoints : public testing::Test {
 protected:
  static constexpr double kRoot = 0.70710678118654752;
  void SetUp() override {
    const Interval upper(kRoot - 0.1, kRoot + 0.1), lower(-kRoot - 0.1, -kRoot + 0.1);
    cover_.boxes = {{{lower, lower}, Verdict::undecided, {}}, {{upper, upper}, Verdict::undecided, {}}};
    cover_.points = cover_.boxes;
    cover_.sigma = {0.2, 0.2};
  }
  Report replayed(Script script) {
    cover_.proof = std::make_shared<const Proof>(std::move(script.proof()));
    return check(system_, cover_);
  }
  std::string failures(Script script) {
    const Report report = replayed(std::move(script));
    EXPECT_FALSE(report.proof.verified);
    return text(report);
  }
  // The lower half holds the lower point, the upper half the upper one.
  static Script good() {
    Script script(kSquare);
    script.add(Step::row, {0}).add(Step::row, {1}).add(Step::keep, {4, 0, 1, 2, 3}, {-1, 1, -1, 1});
    script.add(Step::split, {0}, {0.25});
    script.add(Step::row, {1}).add(Step::box, {0});
    script.add(Step::row, {1}).add(Step::cut, {1, 2}, {0.5, 0.9});
    script.add(Step::empty).add(Step::box, {1}).add(Step::elsewhere);
    return script;
  }
  const System system_ =
      plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nx^3 - y^3 + x - y = 0;\n");
  Cover cover_;
};

TEST_F(TwoPoints, AreAllThereAre) {
  const Report report = replayed(good());
  EXPECT_TRUE(report.proof.verified) << text(report);
  EXPECT_EQ(report.proof.leaves, 4u);
  EXPECT_EQ(report.proof.steps, 11u);
  EXPECT_EQ(text(report), "");
}

TEST_F(TwoPoints, AreShownByARecordedSearch) {
  cover_.proof = std::make_shared<const Proof>(Recorder(system_, cover_).run());
  const Report report = check(system_, cover_);
  EXPECT_TRUE(report.proof.verified) << text(report);
  EXPECT_GT(report.proof.leaves, 4u);
}

TEST_F(TwoPoints, AreNotShownWhereALeafIsMissing) {
  Script script = good();
  script.proof().steps.pop_back();
  EXPECT_THAT(failures(script), HasSubstr("the script ends early"));
}

TEST_F(TwoPoints, AreNotShownWhereALeafIsTooMuch) {
  EXPECT_THAT(failures(good().add(Step::empty)), HasSubstr("goes on after its last leaf"));
  Script script = good();
  script.proof().reals.push_back(1);
  EXPECT_THAT(failures(script), HasSubstr("goes on after its last leaf"));
}

TEST_F(TwoPoints, AreNotShownByAWrongLeaf) {
  Script script = good();
  for (std::uint8_t& step : script.proof().steps)
    if (step == static_cast<std::uint8_t>(Step::box)) step = static_cast<std::uint8_t>(Step::empty);
  std::erase_if(script.proof().integers, [n = 0](int) mutable {
    ++n;
    return n == 10 || n == 14;
  });
  EXPECT_THAT(failures(script), HasSubstr("not shown to have no solution"));

  script = good();
  script.proof().integers.back() = 0;  // the upper point in the lower box
  EXPECT_THAT(failures(script), HasSubstr("not shown to lie in box 1"));
}

TEST_F(TwoPoints, AreNotShownByABoundThatCutsOneOff) {
  for (const double bound : {0.7, 0.5}) {
    Script script = good();
    script.proof().reals[1] = bound;  // x ≤ bound
    EXPECT_THAT(failures(script), HasSubstr("a slab that is cut off")) << bound;
  }
  Script script = good();
  script.proof().reals[1] = 1 - 1e-15;  // no solution beyond: true, if more than rows say
  EXPECT_EQ(text(replayed(script)), "");
}

TEST_F(TwoPoints, AreNotShownWhereTheRootIsTooSmall) {
  Script script = good();
  script.proof().roots[0][0] = {-2, 0.7};
  EXPECT_THAT(failures(script), HasSubstr("does not hold the search domain"));
  script.proof().roots.clear();
  EXPECT_NE(failures(script), "");
  script.proof() = {};
  EXPECT_THAT(failures(script), HasSubstr("does not hold the search domain"));
}

TEST_F(TwoPoints, AreNotShownWhereOneBoxIsGone) {
  cover_.boxes.pop_back();
  cover_.points.pop_back();
  EXPECT_THAT(failures(good()), HasSubstr("out of range"));
  Script script = good();
  script.proof().integers.back() = 0;
  EXPECT_THAT(failures(script), HasSubstr("not shown to lie in box 1"));
}

TEST_F(TwoPoints, AreNotShownWhereTheUpperPartIsSaidToBeEmpty) {
  for (const Step leaf : {Step::empty, Step::elsewhere}) {
    Script split(kSquare), cut(kSquare);
    split.add(Step::split, {0}, {0.25}).add(Step::box, {0}).add(leaf);
    EXPECT_THAT(failures(split), HasSubstr("not shown to have no solution"));
    cut.add(Step::cut, {0, 2}, {-1.5, 0.25}).add(leaf).add(Step::box, {0}).add(leaf);
    EXPECT_THAT(failures(cut), HasSubstr("not shown to have no solution"));
    Script lower(kSquare);
    lower.add(Step::split, {0}, {0.25}).add(leaf).add(Step::box, {1});
    EXPECT_THAT(failures(lower), HasSubstr("not shown to have no solution"));
  }
}

TEST_F(TwoPoints, AreNotShownByAPartThatIsEmptyBesideOneThatIsNot) {
  // The rows leave [-1, 1]: below -1.5 there is nothing.
  Script script(kSquare);
  script.add(Step::row, {0}).add(Step::split, {0}, {-1.5}).add(Step::empty).add(Step::empty);
  EXPECT_THAT(failures(script), HasSubstr("not shown to have no solution"));
}

TEST_F(TwoPoints, AreNotShownWhereAFurtherRootIsSaidToBeEmpty) {
  Script script(kSquare);
  script.root(kSquare).add(Step::root, {1}).add(Step::empty);
  EXPECT_THAT(failures(script), HasSubstr("not shown to have no solution"));
}

TEST_F(TwoPoints, AreNotShownByAnotherBoxThanTheOneNamed) {
  Script script(kSquare);
  script.add(Step::split, {0}, {0.25}).add(Step::box, {1}).add(Step::box, {1});
  EXPECT_THAT(failures(script), HasSubstr("not shown to lie in box 2"));
}

TEST_F(TwoPoints, NeedNoStepsWhereTheCheckerFindsThemItself) {
  Script script(kSquare);
  script.add(Step::split, {0}, {0}).add(Step::box, {0}).add(Step::box, {1});
  const Report report = replayed(script);
  EXPECT_TRUE(report.proof.verified) << text(report);
}

TEST_F(TwoPoints, AreInPartsThatTileWhateverTheirPlacesAre) {
  for (const double place : {-5.0, 5.0, -0.9, 0.9}) {
    Script script(kSquare);
    script.add(Step::split, {0}, {place}).add(Step::box, {0}).add(Step::box, {1});
    EXPECT_NE(failures(script), "") << place;
  }
}

TEST_F(TwoPoints, AreNotShownByRootsThatProveOneAnother) {
  EXPECT_THAT(failures(Script(kSquare).root(kSquare).add(Step::root, {1}).add(Step::root, {0})),
              HasSubstr("an earlier one or itself"));
  EXPECT_THAT(failures(Script(kSquare).add(Step::root, {0})), HasSubstr("an earlier one or itself"));
}

TEST_F(TwoPoints, AreShownByWayOfFurtherRoots) {
  Script script(kSquare);
  script.root({{0, 2}, {-2, 2}});
  script.add(Step::split, {0}, {0}).add(Step::box, {0}).add(Step::root, {1});
  script.add(Step::box, {1});
  EXPECT_TRUE(replayed(script).proof.verified);
  script.proof().roots[1][0] = {0, 0.5};
  EXPECT_THAT(failures(script), HasSubstr("does not lie in the root"));
}

TEST_F(TwoPoints, GainNothingFromACombinationThatProvesNothing) {
  Script script(kSquare);
  script.combination({{0, 1}, {0, 1}, {0, 0, 0, 0}});
  script.add(Step::newton, {0}).add(Step::empty);
  EXPECT_THAT(failures(script), HasSubstr("not shown to have no solution"));
}

TEST_F(TwoPoints, AreNotShownByAMalformedScript) {
  const Script all(kSquare);
  EXPECT_THAT(failures(Script(all).add(Step::row, {99}).add(Step::empty)), HasSubstr("out of range"));
  EXPECT_THAT(failures(Script(all).add(Step::newton, {0}).add(Step::empty)), HasSubstr("out of range"));
  EXPECT_THAT(failures(Script(all).add(Step::split, {2}, {0}).add(Step::empty).add(Step::empty)), HasSubstr("out of range"));
  EXPECT_THAT(failures(Script(all).add(Step::keep, {-1}).add(Step::empty)), HasSubstr("negative"));
  EXPECT_THAT(failures(Script(all).add(Step::keep, {1, 4}, {0}).add(Step::empty)), HasSubstr("out of range"));
  EXPECT_THAT(failures(Script(all).add(Step::keep, {1, 0}, {NAN}).add(Step::empty)), HasSubstr("a value is not a number"));
  EXPECT_THAT(failures(Script(all).add(Step::cut, {0, 2}, {1, 0}).add(Step::empty)), HasSubstr("do not ascend"));
  EXPECT_THAT(failures(Script(all).add(Step::cut, {0, 1000000}, {1})), HasSubstr("ends early"));
  EXPECT_THAT(failures(Script(all).add(static_cast<Step>(77))), HasSubstr("unknown step"));
  EXPECT_THAT(failures(Script(all).combination({{0}, {0, 1}, {1}}).add(Step::empty)), HasSubstr("malformed"));
  EXPECT_THAT(failures(Script(all).combination({{0}, {5}, {1}}).add(Step::empty)), HasSubstr("malformed"));
  EXPECT_THAT(failures(Script(std::vector<Interval>{{-2, 2}}).add(Step::empty)), HasSubstr("one bounded side"));
  EXPECT_THAT(failures(Script({{-2, 2}, {2, -2}}).add(Step::empty)), HasSubstr("one bounded side"));
  EXPECT_THAT(failures(Script({{-2, 2}, {-2, HUGE_VAL}}).add(Step::empty)), HasSubstr("one bounded side"));
  Script deep(all);
  for (int k = 0; k < 20'000; ++k) deep.add(Step::split, {0}, {0});
  EXPECT_NE(failures(deep), "");
}

TEST(Replay, ShowsNothingWhereAnEliminatedVariablesSideIsAnother) {
  const System system = plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-9, 9]\n[SYSTEM EQS]\n(x^2 - 2)^2 = 0;\ny = x^2 + x;\n");
  solve::Options options;
  options.proof = true;
  Cover cover = solve::solve(system, options);
  ASSERT_EQ(cover.reduction.size(), 1u);
  ASSERT_EQ(std::get<Elimination>(cover.reduction[0]).variable, 1);
  EXPECT_TRUE(check(system, cover).proof.verified) << text(check(system, cover));
  ASSERT_EQ(cover.boxes.size(), cover.count(Verdict::undecided));
  for (CoverBox& box : cover.boxes) box.box[1] = Interval(box.box[1].lo() + 1, box.box[1].hi() + 1);
  EXPECT_FALSE(check(system, cover).proof.verified);
}

TEST(Replay, ShowsThatAnEliminatedVariablesSideHoldsAllOfItsValues) {
  const System system = plain("[SYSTEM VARS]\nx : [0, 1]\ny : [-9, 9]\n[SYSTEM EQS]\ny = x + x^2;\n");
  Cover cover;
  cover.sigma = {9, 9};
  cover.dimension = 1;
  cover.reduction = {Elimination{1, 0}};
  cover.proof = std::make_shared<const Proof>(Script(std::vector<Interval>{{0, 1}}).add(Step::box, {0}).proof());
  const auto verified = [&](const Interval& y) {
    cover.boxes = {{{{0, 1}, y}, Verdict::undecided, {}}};
    return check(system, cover).proof.verified;
  };
  EXPECT_TRUE(verified({0, 2}));
  for (const Interval& part : {Interval(0, 1.5), Interval(0.5, 2), Interval(0.5, 1.5)}) EXPECT_FALSE(verified(part));
}

TEST(Replay, ShowsThatASystemHasNoSolution) {
  const System system = plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx*y = 1;\nx^2 + y^2 = 1;\n");
  Cover cover;
  cover.sigma = {0.1, 0.1};
  cover.proof = std::make_shared<const Proof>(Recorder(system, cover).run());
  const Report report = check(system, cover);
  EXPECT_TRUE(report.verified()) << text(report);
  EXPECT_TRUE(report.proof.verified);
}

TEST(Replay, SearchesAnewWhereALeafGivesNoReason) {
  const System system = plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx*y = 1;\nx^2 + y^2 = 1;\n");
  Cover cover;
  cover.sigma = {0.1, 0.1};
  cover.proof = std::make_shared<const Proof>(Script(kSquare).add(Step::empty).proof());
  const Report report = check(system, cover);
  EXPECT_TRUE(report.proof.verified) << text(report);
  EXPECT_EQ(report.proof.searched, 1u);
}

void expect_complete(const System& system, Cover cover) {
  cover.proof = std::make_shared<const Proof>(Recorder(system, cover).run());
  const Report report = check(system, cover);
  EXPECT_TRUE(report.verified()) << text(report);
  EXPECT_TRUE(report.proof.verified);
  Options two;
  two.threads = 2;
  EXPECT_EQ(check(system, cover, two).proof.leaves, report.proof.leaves);
  // Without one of its boxes the cover is not complete.
  const auto last = static_cast<int>(cover.boxes.size()) - 1;
  Proof proof = *cover.proof;
  for (std::size_t at = 0, integer = 0; at < proof.steps.size(); ++at) {
    const auto step = static_cast<Step>(proof.steps[at]);
    if (step == Step::box && proof.integers[integer] == last) proof.integers[integer] = 0;
    integer += step == Step::empty ? 0 : step == Step::keep ? 1 + static_cast<std::size_t>(proof.integers[integer]) : 1;
  }
  cover.proof = std::make_shared<const Proof>(proof);
  EXPECT_FALSE(check(system, cover).proof.verified);
}

TEST(Replay, ShowsThatACoverOfACurveIsComplete) {
  const System system =
      plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-9, 9]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nz = x + y^2;\n");
  expect_complete(system, solved(system, 0.2));
}

TEST(Replay, ShowsThatACoverOfPointsIsComplete) {
  const System system = model("three_slider", SingularitySet::forward);
  expect_complete(system, solved(system, 1e-6));
}

TEST(Replay, ShowsThatTheThreeSlidersCSpaceIsComplete) {
  const System system = model("three_slider", SingularitySet::cspace);
  expect_complete(system, solved(system, 0.25));
}

}  // namespace
}  // namespace corank::check
