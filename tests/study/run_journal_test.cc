// What a run keeps of a search that a limit has ended.
#include "corank/study/run_journal.h"

#include <gtest/gtest.h>

#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank::study {
namespace {

// Ended after a few boxes.
std::string kept_by(RunJournal::Plan plan, std::uint64_t& left_out) {
  const Question question{read_model(CORANK_SOURCE_DIR "/models/dextar.cuik").mechanism, symbolic::SingularitySet::inverse};
  Options options;
  options.search.max_boxes = 20;
  options.search.proof = true;
  solve::Control control(solve::limits_of(options.search));
  RunJournal journal({}, std::move(plan));
  EXPECT_FALSE(answer(question, system(question), options, control, &journal).cover.complete());
  left_out = journal.left_out();
  return journal.take_search();
}

TEST(RunJournal, LeavesOutWhatIsTooLargeForAResult) {
  std::uint64_t left_out = 0;
  const std::string kept = kept_by({.keep_end = true}, left_out);
  EXPECT_FALSE(kept.empty());
  EXPECT_EQ(left_out, 0u);
  EXPECT_TRUE(kept_by({.keep_end = true, .most_in_result = 1000}, left_out).empty());
  EXPECT_GT(left_out, 1000u);
  EXPECT_TRUE(kept_by({}, left_out).empty());
  EXPECT_EQ(left_out, 0u);
}

}  // namespace
}  // namespace corank::study
