// Every stage of a run ends where a clock that nobody waits for says so, with a cover whose claims the independent checker
// accepts.
#include <gtest/gtest.h>

#include <atomic>

#include "corank/check/checker.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/closed_forms.h"

namespace corank {
namespace {
using solve::Control;
using solve::Ending;
using solve::Limit;
using solve::Stage;
using symbolic::SingularitySet;

// Stands still but in one stage: there it is late from the (k + 1)-th question on, later with each.
class FakeClock {
 public:
  FakeClock(Stage stage, int k) : stage_(stage), k_(k) {}
  void watch(const Control& control) { control_ = &control; }
  double operator()() {
    if (control_ == nullptr || control_->stage() != stage_) return late_;
    const int late = ++questions_ - k_;
    if (late > 0) late_ = 1e6 * late;
    return late_;
  }
  int questions() const { return questions_; }

 private:
  const Control* control_ = nullptr;
  const Stage stage_;
  const int k_;
  std::atomic<int> questions_{0};
  std::atomic<double> late_{0};
};

struct Question {
  const char* model;
  SingularitySet set;
  const char* constant;  // of another value, or nothing
  double sigma;
};
const Question kPoints{"three_slider.cuik", SingularitySet::forward, "1", 1e-6};
const Question kCurves{"dextar.cuik", SingularitySet::inverse, nullptr, 0.2};

System system_of(const Question& question) {
  auto model = symbolic::read_model(std::string(CORANK_SOURCE_DIR "/models/") + question.model);
  if (question.constant) model.set_constant("L2", symbolic::Expression(question.constant));
  return symbolic::algebrize(symbolic::singularity_system(model, question.set));
}

struct Outcome {
  Cover cover;
  std::optional<Ending> ending;
  int questions = 0;  // asked in the stage
};

void solve_all(const System& system, const Question& question, solve::Options options, Control& control, Cover& cover) {
  options.sigma = question.sigma;
  const solve::Prepared prepared = solve::prepare(system, options, control);
  cover = solve::solve(prepared, control);
  solve::prove_exactly(prepared, cover, control);
  if (cover.dimension == 0) solve::prove_decimals(prepared, 20, cover, control);
}

// All that `corank solve --digits 20 --proof` does (no proof of curves: to check it takes long), with k answers of "not yet"
// in the stage.
Outcome run(const System& system, const Question& question, Stage stage, int k, int threads) {
  FakeClock clock(stage, k);
  Control control({.time = 1, .clock = [&clock] { return clock(); }});
  clock.watch(control);
  solve::Options options;
  options.threads = threads;
  options.proof = question.set == SingularitySet::forward;
  Outcome result;
  solve_all(system, question, options, control, result.cover);
  result.ending = control.ending();
  result.questions = clock.questions();
  return result;
}

void expect_honest(const Question& question, const System& system, const Cover& cover) {
  const check::Report report = check::check(system, cover);
  for (const auto& failure : report.failures) ADD_FAILURE() << failure.index << ": " << failure.reason;
  const test::CoverLookup lookup(cover);
  constexpr double kRounding = 1e-7;
  if (question.set == SingularitySet::forward) {
    for (const double y : {-1.0, 1.0}) {
      EXPECT_TRUE(lookup.holds(std::vector<double>{y, -y, 0}, kRounding) &&
                  lookup.holds(std::vector<double>{y, y, 0}, kRounding));
      EXPECT_TRUE(lookup.holds(std::vector<double>{0, 0, y}, kRounding));
    }
  } else {
    for (const auto& q : test::dextar_inverse_samples(50)) EXPECT_TRUE(lookup.holds(q, kRounding));
  }
}

class Stopping : public testing::TestWithParam<std::tuple<Question, Stage, int>> {};

TEST_P(Stopping, EndsTheStageWithAnHonestCover) {
  const auto [question, stage, threads] = GetParam();
  const System system = system_of(question);
  const int all = run(system, question, stage, 1'000'000'000, threads).questions;
  ASSERT_GT(all, 0) << "the stage never asks whether it is to end";
  // How often two threads ask differs from run to run.
  for (const int k : {0, all / 2, threads == 1 ? all - 1 : all / 4}) {
    SCOPED_TRACE(std::to_string(k) + " of " + std::to_string(all));
    const Outcome ended = run(system, question, stage, k, threads);
    EXPECT_EQ(ended.ending, (Ending{Limit::time, stage}));
    expect_honest(question, system, ended.cover);
    const bool before_the_end_of_the_search = stage == Stage::reduction || (stage == Stage::search && k < all / 2);
    if (before_the_end_of_the_search) {
      EXPECT_FALSE(ended.cover.complete());
    } else if (stage > Stage::search) {
      EXPECT_TRUE(ended.cover.complete());
    }
  }
}

std::string name_of(const testing::TestParamInfo<Stopping::ParamType>& info) {
  std::string name = std::string(std::get<0>(info.param).constant ? "points_" : "curves_") +
                     to_string(std::get<1>(info.param)) + "_" + std::to_string(std::get<2>(info.param));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(OfPoints, Stopping,
                         testing::Combine(testing::Values(kPoints),
                                          testing::Values(Stage::reduction, Stage::search, Stage::points, Stage::exact,
                                                          Stage::kernel, Stage::decimals),
                                          testing::Values(1)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(OfCurves, Stopping,
                         testing::Combine(testing::Values(kCurves),
                                          testing::Values(Stage::reduction, Stage::search, Stage::merging, Stage::exact,
                                                          Stage::kernel),
                                          testing::Values(2)),
                         name_of);

class Interrupted : public testing::TestWithParam<Stage> {};

TEST_P(Interrupted, EndsTheStageInWhichItIs) {
  const System system = system_of(kPoints);
  std::atomic<bool> stop{false};
  Control control({.stop = &stop});
  control.progress = [&stop](const Control::Progress& p) {
    if (p.stage == GetParam()) stop = true;
  };
  Cover cover;
  solve_all(system, kPoints, {}, control, cover);
  EXPECT_EQ(control.ending(), (Ending{Limit::interrupt, GetParam()}));
  EXPECT_EQ(cover.complete(), GetParam() > Stage::search);
  expect_honest(kPoints, system, cover);
}

INSTANTIATE_TEST_SUITE_P(InEachStage, Interrupted,
                         testing::Values(Stage::reduction, Stage::search, Stage::points, Stage::exact, Stage::kernel,
                                         Stage::decimals),
                         [](const auto& stage) {
                           std::string name = to_string(stage.param);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(BoxLimit, HoldsForTheSearchesOfTheExactStage) {
  const System system = system_of(kPoints);
  const auto exact_within = [&](std::uint64_t boxes, std::optional<Ending> expected) {
    Control control({.boxes = boxes});
    Cover cover;
    solve_all(system, kPoints, {}, control, cover);
    EXPECT_EQ(control.ending(), expected);
    expect_honest(kPoints, system, cover);
    EXPECT_TRUE(cover.complete());
    return cover.count(Verdict::exact);
  };
  solve::Options options;
  options.sigma = kPoints.sigma;
  const std::uint64_t processed = solve::solve(system, options).statistics.processed;
  EXPECT_EQ(exact_within(0, std::nullopt), 2u);
  EXPECT_EQ(exact_within(processed + 2, Ending{Limit::boxes, Stage::exact}), 0u);
}

}  // namespace
}  // namespace corank
