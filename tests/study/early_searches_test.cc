// Searches made ahead: what they find is what study::answer finds, and what is not small, or not to go on, is left to it.
#include "corank/study/early_searches.h"

#include <gtest/gtest.h>

#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank::study {
namespace {
using symbolic::SingularitySet;

/// Dextar's sets, small ones first.
class DextarAhead : public testing::Test {
 protected:
  DextarAhead() {
    Question question{.model = read_model(CORANK_SOURCE_DIR "/models/dextar.cuik").mechanism, .in_parts = false};
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace}) {
      question.set = set;
      questions_.push_back(question);
      systems_.push_back(system(question));
    }
  }

  EarlyTask task(std::size_t k, double sigma = 0.1) const {
    Options options{{.sigma = sigma}};
    return {questions_[k].set, systems_[k], labelling(questions_[k], systems_[k]), options, {}, k};
  }
  void expect_answer(std::size_t k, const std::optional<Cover>& found) const {
    ASSERT_TRUE(found);
    const result::Result whole = answer(questions_[k], task(k).options);
    ASSERT_EQ(found->boxes.size(), whole.cover.boxes.size());
    for (std::size_t i = 0; i < whole.cover.boxes.size(); ++i) {
      const CoverBox &a = found->boxes[i], &b = whole.cover.boxes[i];
      EXPECT_EQ(a.box, b.box);
      EXPECT_EQ(a.verdict, b.verdict);
      EXPECT_EQ(a.types, b.types);
      EXPECT_EQ(a.region, b.region);
    }
    EXPECT_EQ(found->types, whole.cover.types);
  }

  std::vector<Question> questions_;
  std::vector<System> systems_;
};

TEST_F(DextarAhead, FindsWhatTheirAnswersHoldInTheOrderOfTheTasks) {
  std::vector<EarlyTask> tasks;
  std::vector<std::size_t> told(9);
  for (std::size_t i = 0; i < 9; ++i) {
    tasks.push_back(task(i % 3));
    tasks.back().then = [&told, i](const Cover& found) { told[i] = found.boxes.size(); };
  }
  EarlySearches early(std::move(tasks), 3);
  for (std::size_t i = 0; i < 9; ++i) {
    const std::optional<Cover> found = early.take(i);
    expect_answer(i % 3, found);
    EXPECT_EQ(told[i], found->boxes.size());
  }
}

TEST_F(DextarAhead, LeavesWhatIsNotSmallToTheirs) {
  EarlySearches early({task(0), task(2, 0.01), task(1)}, 2);
  EXPECT_TRUE(early.take(0));
  EXPECT_FALSE(early.take(1));  // two million boxes
  EXPECT_TRUE(early.take(2));
}

TEST_F(DextarAhead, TriesNoneAnyMoreThatIsLikeOneThatWasNotSmall) {
  std::vector<EarlyTask> tasks{task(2, 0.01)};
  for (int i = 0; i < 5; ++i) tasks.push_back(task(0));
  tasks.push_back(task(2));  // alone it would be small
  {
    EarlySearches alone({task(2)}, 2);
    EXPECT_TRUE(alone.take(0));
  }
  EarlySearches early(std::move(tasks), 2);
  EXPECT_FALSE(early.take(0));
  for (std::size_t i = 1; i < 6; ++i) EXPECT_TRUE(early.take(i));
  EXPECT_FALSE(early.take(6));
}

TEST_F(DextarAhead, LeavesWhatALimitEndsToTheirs) {
  EarlyTask limited = task(0);
  limited.limits.boxes = 20;
  EarlyTask few = task(0);
  few.options.search.max_found = 20;
  few.kind = 1;
  EarlySearches early({limited, few, task(2)}, 2);
  EXPECT_FALSE(early.take(0));
  EXPECT_FALSE(early.take(1));
  EXPECT_TRUE(early.take(2));
}

TEST_F(DextarAhead, LeavesWhatFailsToTheirs) {
  EarlyTask wrong = task(0);
  wrong.options.search.sigma = -1;
  EarlySearches early({wrong, task(1)}, 2);
  EXPECT_FALSE(early.take(0));
  EXPECT_TRUE(early.take(1));
}

TEST_F(DextarAhead, EndsSoonWhereAnInterruptStopsIt) {
  const std::atomic<bool> stop{true};
  EarlyTask stopped = task(0);
  stopped.limits.stop = &stop;
  EarlySearches early({stopped, stopped, stopped}, 2);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(early.take(i));
}

TEST_F(DextarAhead, MakesNoneForOneThread) {
  EarlySearches early({task(0)}, 1);
  EXPECT_FALSE(early.take(0));
}

TEST_F(DextarAhead, CanBeLeftBeforeItsTasksAreTaken) {
  EarlySearches early({task(0), task(1), task(2), task(0), task(1)}, 2);
  EXPECT_TRUE(early.take(0));
}

}  // namespace
}  // namespace corank::study
