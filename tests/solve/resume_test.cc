// A search that pauses, ends and goes on from what it has kept makes the cover that one search makes.
#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "corank/check/checker.h"
#include "corank/solve/store/journal.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/tests/solve/same_cover.h"

namespace corank::solve {
namespace {

struct Killed {};

// Due at random boxes; keeps the state as bytes, and after a number of times throws, as if the process had ended.
class RandomJournal : public Journal {
 public:
  RandomJournal(unsigned seed, int one_in, int most) : random_(seed), one_in_(one_in), most_(most) {}
  bool due() override {
    const std::lock_guard lock(mutex_);
    return std::uniform_int_distribution(1, one_in_)(random_) == 1;
  }
  void keep(const SearchView& state, Moment moment) override {
    bytes = to_bytes(state);
    last = moment;
    moments.push_back(moment);
    cut_sheets = cut_sheets || (moment == Moment::paused && state.cutting);
    if (moment == Moment::paused && --most_ == 0) throw Killed{};
  }

  std::string bytes;
  std::optional<Moment> last;
  std::vector<Moment> moments;
  bool cut_sheets = false;

 private:
  std::mutex mutex_;
  std::mt19937 random_;
  const int one_in_;
  int most_;
};

// Ends the search by what `journal` and `limits` say, again and again, each time going on from the bytes of the last time.
int expect_same_when_resumed(const System& system, Options options, int one_in, int kills) {
  int cut_sheets = 0;
  for (const bool proof : {false, true}) {
    options.proof = proof;
    const Prepared prepared = prepared_with(system, options);
    Control control;
    const Cover whole = solve(prepared, control);
    EXPECT_TRUE(!whole.proof || check::check(system, whole).proof.verified);
    for (const int threads : {1, 3}) {
      Prepared same = prepared_from(to_bytes(prepared));
      same.options.threads = threads;
      std::optional<Cover> cover;
      std::string bytes;
      for (int run = 0; !cover; ++run) {
        Control again;
        RandomJournal journal(static_cast<unsigned>(run + 1), run < kills ? one_in : 1'000'000, 1 + run % 3);
        std::optional<SearchState> from;
        if (!bytes.empty()) from = state_from(bytes, same);
        try {
          cover = solve_on(same, again, &journal, std::move(from));
          EXPECT_EQ(journal.last, Moment::cut);
        } catch (const Killed&) {
        }
        if (!journal.bytes.empty()) bytes = journal.bytes;
        cut_sheets += journal.cut_sheets;
      }
      expect_same(whole, *cover);
    }
  }
  return cut_sheets;
}

TEST(Resuming, ASurfaceMakesTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.3;
  EXPECT_GT(expect_same_when_resumed(torus().system(), options, 60, 50), 0) << "none was ended among its sheets";
}

TEST(Resuming, ACurveThatCrossesItselfMakesTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.05;
  expect_same_when_resumed(lemniscate(), options, 20, 12);
}

TEST(Resuming, ASelfMotionMakesTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.2;
  expect_same_when_resumed(plane_and_line(), options, 100, 8);
}

TEST(Resuming, TurnsMakeTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.3;
  for (const bool proof : {false, true}) {
    options.proof = proof;
    for (const System& system : {torus().system(), lemniscate(), plane_and_line(), circle_and_diagonal().system()}) {
      const Prepared prepared = prepared_with(system, options);
      Control control;
      const Cover whole = solve(prepared, control);
      for (const std::uint64_t turns_meant : {2u, 7u}) {
        const std::uint64_t most = whole.statistics.processed / turns_meant + 1;
        RandomJournal journal(1, 1'000'000, 1000);
        std::optional<Cover> cover = solve_turn(prepared, control, journal, most);
        for (int turns = 1; !cover && turns < 1000; ++turns) {
          EXPECT_EQ(journal.last, Moment::turn_over);
          cover = solve_turn(prepared, control, journal, most, state_from(journal.bytes, prepared));
        }
        ASSERT_TRUE(cover);
        EXPECT_FALSE(control.ending());
        expect_same(whole, *cover);
      }
    }
  }
}

TEST(Resuming, PointsMakeTheCoverOfOneSearch) { expect_same_when_resumed(circle_and_diagonal().system(), {}, 3, 4); }

// What limits end at any box, or at any look at the clock, among the sheets as well: searches by some limits, one after the
// other, and then by others.
void expect_same_after_limits(const System& system, Options options,
                              const std::vector<std::vector<Control::Limits>>& searches) {
  options.proof = true;
  const Prepared prepared = prepared_with(system, options);
  Control control;
  const Cover whole = solve(prepared, control);
  EXPECT_TRUE(check::check(system, whole).proof.verified);
  for (const std::vector<Control::Limits>& limits : searches) {
    std::optional<Cover> cover;
    std::string bytes;
    for (std::size_t run = 0; !cover; ++run) {
      Control again(run < limits.size() ? limits[run] : Control::Limits{});
      RandomJournal journal(1, 1'000'000, 1000);
      std::optional<SearchState> from;
      if (!bytes.empty()) from = state_from(bytes, prepared);
      cover = solve_on(prepared, again, &journal, std::move(from));
      if (again.ending()) {
        EXPECT_EQ(journal.last, Moment::ended);
        bytes = journal.bytes;
        cover.reset();
      }
    }
    expect_same(whole, *cover);
  }
}

TEST(Resuming, WhatBoxLimitsHaveEndedMakesTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.3;
  std::vector<std::vector<Control::Limits>> searches;
  for (const std::uint64_t boxes : {1u, 17u, 200u})
    searches.push_back({{.boxes = boxes}, {.boxes = 2 * boxes}, {.boxes = boxes}});
  expect_same_after_limits(torus().system(), options, searches);
  const std::vector<Control::Limits> two{{.boxes = 5}, {.boxes = 50}};
  expect_same_after_limits(lemniscate(), options, {two});
}

TEST(Resuming, WhatTheClockHasEndedAnywhereMakesTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.2;
  const auto clock_of = [](int glances) {  // its time is over after that many looks
    auto count = std::make_shared<std::atomic<int>>(0);
    return Control::Limits{.time = 1, .clock = [count, glances] { return (*count)++ > glances ? 10.0 : 0.0; }};
  };
  // Some of these in the search, some among the sheets.
  std::vector<std::vector<Control::Limits>> searches, shorter;
  for (const int glances : {3, 300, 900, 1500, 2200})
    searches.push_back({clock_of(glances), clock_of(3 * glances / 2), clock_of(40)});
  expect_same_after_limits(torus().system(), options, searches);
  for (const int glances : {2, 30, 60, 90}) shorter.push_back({clock_of(glances)});
  expect_same_after_limits(lemniscate(), options, shorter);
  Control control;
  const Prepared prepared = prepared_with(plane_and_line(), options);
  const Cover whole = solve(prepared, control);
  for (const int glances : {20, 100, 500, 2000}) {
    Control limited(clock_of(glances));
    RandomJournal journal(1, 1'000'000, 1000);
    solve_on(prepared, limited, &journal);
    Control rest;
    expect_same(whole, solve_on(prepared, rest, nullptr, state_from(journal.bytes, prepared)));
  }
}

TEST(Resuming, WhatIsDamagedIsRefused) {
  Options options;
  options.sigma = 0.5;
  const Prepared prepared = prepared_with(torus().system(), options);
  RandomJournal journal(1, 200, 3);
  Control control;
  EXPECT_THROW(solve_on(prepared, control, &journal), Killed);
  const std::string bytes = journal.bytes;
  EXPECT_NO_THROW(state_from(bytes, prepared));
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 300)
    EXPECT_THROW(state_from(bytes.substr(0, length), prepared), ShardError) << length;
  EXPECT_THROW(state_from(bytes + "x", prepared), ShardError);
  EXPECT_THROW(unit_from(bytes, prepared), ShardError);
  const Prepared other = prepared_with(lemniscate(), options);
  EXPECT_THROW(state_from(bytes, other), ShardError) << "of another system";
  std::string old = bytes;
  old.replace(old.find("version ") + 8, 1, "9");
  try {
    state_from(old, prepared);
    ADD_FAILURE() << "another version's";
  } catch (const ShardError& error) {
    EXPECT_NE(std::string(error.what()).find("was made by corank 9"), std::string::npos) << error.what();
  }
  std::mt19937 random(7);
  for (int k = 0; k < 400; ++k) {  // each is refused or is a state; none harms
    std::string changed = bytes;
    changed[std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random)] = static_cast<char>(random());
    try {
      state_from(changed, prepared);
    } catch (const ShardError&) {
    }
  }
}

}  // namespace
}  // namespace corank::solve
