// What a run keeps of a search that a limit has ended.
#include "corank/study/run_journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "corank/result/files/checkpoint.h"
#include "corank/solve/store/shard_bytes.h"
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

/// Curves in eight parts, of five to a hundred boxes.
Systems parts() {
  solve::Control control;
  return systems_of(
      {read_model(CORANK_SOURCE_DIR "/models/dextar_limits.cuik").mechanism, symbolic::SingularitySet::boundary}, control);
}

Options in_turns(std::uint64_t boxes_of_first_turns) {
  Options options;
  options.search.sigma = 0.5;
  options.search.proof = true;
  options.boxes_of_first_turns = boxes_of_first_turns;
  return options;
}

void expect_same(const result::Result& a, const result::Result& b) {
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    SCOPED_TRACE(a.parts[i].part);
    const Cover &one = a.parts[i].cover, &other = b.parts[i].cover;
    EXPECT_EQ(a.parts[i].part, b.parts[i].part);
    EXPECT_EQ(one.statistics.processed, other.statistics.processed);
    EXPECT_TRUE(one.proof && other.proof && *one.proof == *other.proof);
    ASSERT_EQ(one.boxes.size(), other.boxes.size());
    for (std::size_t k = 0; k < one.boxes.size(); ++k) {
      EXPECT_EQ(one.boxes[k].box, other.boxes[k].box);
      EXPECT_EQ(one.boxes[k].verdict, other.boxes[k].verdict);
    }
  }
}

TEST(Turns, MakeTheSameResult) {
  const Systems systems = parts();
  solve::Control control;
  const result::Result whole = answer(systems, in_turns(0), control);
  EXPECT_TRUE(whole.cover.complete());
  for (const std::uint64_t boxes : {1u, 40u, 300u}) {
    solve::Control other;
    expect_same(answer(systems, in_turns(boxes), other), whole);
  }
}

// Ovals, which take 100,000 boxes, and two lines.
TEST(Turns, ShareALimit) {
  Question question{parse_model({.text = R"(
[SYSTEM VARS]
u : [-100, 100]
v : [-100, 100]
x : [-1, 1]
y : [-1, 1]
[SYSTEM EQS]
u = 128/9*x^9 - 256/7*x^7 + 32*x^5 - 32/3*x^3 + x + x*(128*y^8 - 256*y^6 + 160*y^4 - 32*y^2 + 1);
v = (y - 3/10)^2;
[INPUTS]
u, v
[OUTPUTS]
x, y
)",
                                 .file = "ovals.cuik"})
                        .mechanism,
                    symbolic::SingularitySet::forward};
  question.in_parts = true;
  solve::Control control;
  const Systems systems = systems_of(question, control);
  ASSERT_EQ(systems.parts.size(), 2U);
  const auto complete = [&](std::uint64_t boxes_of_first_turns) {
    solve::Control limited({.boxes = 2000});
    std::vector<bool> result;
    for (const result::Result& part : answer(systems, in_turns(boxes_of_first_turns), limited).parts)
      result.push_back(part.cover.complete());
    return result;
  };
  EXPECT_EQ(complete(0), (std::vector{false, false}));
  EXPECT_EQ(complete(400), (std::vector{false, true}));
}

// A run that limits end again and again, with several parts under way.
TEST(Turns, GoOnFromACheckpoint) {
  const Systems systems = parts();
  solve::Control control;
  const result::Result whole = answer(systems, in_turns(0), control);
  for (const std::uint64_t boxes : {3u, 50u, 170u}) {
    const RunJournal::Plan plan{.path = testing::TempDir() + "turns_" + std::to_string(getpid()), .keep_end = true};
    std::optional<result::Result> result;
    int runs = 0;
    for (; !result && runs < 200; ++runs) {
      solve::Control limited({.boxes = boxes});
      RunJournal journal(runs == 0 ? result::Checkpoint{} : result::read_checkpoint(plan.path, solve::engine_version()),
                         plan);
      result::Result next = answer(systems, in_turns(16), limited, &journal);
      EXPECT_EQ(next.stopped.empty(), journal.take_search().empty());
      if (next.cover.complete()) result = std::move(next);
    }
    ASSERT_TRUE(result) << boxes;
    EXPECT_GT(runs, 1);
    expect_same(*result, whole);
    std::filesystem::remove(plan.path);
  }
}

}  // namespace
}  // namespace corank::study
