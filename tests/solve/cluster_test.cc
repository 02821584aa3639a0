// A search whose units run in any order, some more than once, some by workers that are lost, makes solve()'s cover.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/check/checker.h"
#include "corank/solve/distribution/cluster.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/tests/solve/same_cover.h"

namespace corank::solve {
namespace {

struct Ran {
  Cover cover;
  int repeated = 0, restarts = 0, units = 0;
};

// Every process but the coordinator's own knows bytes only. Now and then the coordinator is lost, too.
Ran run_in_random_order(const Prepared& prepared, unsigned seed, std::uint64_t boxes) {
  std::mt19937 random(seed);
  const auto one_in = [&random](int n) { return std::uniform_int_distribution(1, n)(random) == 1; };
  Ran ran;
  const std::string bytes = to_bytes(prepared);
  auto coordinator = std::make_unique<Coordinator>(bytes);
  UnitRunner second(bytes);
  std::vector<std::string> waiting, answers;
  while (!coordinator->done()) {
    for (std::string& unit : coordinator->take_units(1 + random() % 5)) waiting.push_back(std::move(unit));
    std::shuffle(waiting.begin(), waiting.end(), random);
    if (waiting.empty() && answers.empty()) {
      ADD_FAILURE() << "nothing to do, and not done";
      break;
    }
    if (!waiting.empty()) {
      const std::string unit = waiting.back();
      waiting.pop_back();
      const Budget budget{.boxes = boxes, .threads = 1 + ran.units++ % 3, .found = one_in(2) ? random() % 30 : 100'000};
      answers.push_back(UnitRunner(coordinator->prepared_bytes()).run(unit, budget));
      if (one_in(4)) answers.push_back(second.run(unit, {.boxes = boxes / 2 + 1}));  // by two workers
      if (one_in(3) && !waiting.empty()) continue;                                   // they come later
    }
    std::shuffle(answers.begin(), answers.end(), random);
    while (!answers.empty()) {
      ran.repeated += !coordinator->add(answers.back());
      answers.pop_back();
    }
    if (!one_in(20)) continue;
    auto next = std::make_unique<Coordinator>(bytes, coordinator->state());
    EXPECT_GE(next->share_done(), 0);
    coordinator = std::move(next);
    waiting.clear();  // units of the former one
    ++ran.restarts;
  }
  for (const std::string& answer : answers) coordinator->add(answer);
  Control control;
  ran.cover = coordinator->assemble(control);
  return ran;
}

void expect_same_from_units(const System& system, Options options, std::uint64_t boxes) {
  for (const bool proof : {false, true}) {
    options.proof = proof;
    const Prepared prepared = prepared_with(system, options);
    Control control;
    const Cover whole = solve(prepared, control);
    EXPECT_TRUE(!whole.proof || check::check(system, whole).proof.verified);
    int repeated = 0, restarts = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      const Ran ran = run_in_random_order(prepared, seed, boxes);
      expect_same(whole, ran.cover);
      repeated += ran.repeated;
      restarts += ran.restarts;
    }
    EXPECT_GT(repeated, 0);
    EXPECT_GT(restarts, 0);
  }
}

TEST(Cluster, MakesTheCoverOfASurface) {
  Options options;
  options.sigma = 0.3;
  expect_same_from_units(torus().system(), options, 50);
}

TEST(Cluster, CutsSheetsLaterWhereSigmaDependsOnThem) { expect_same_from_units(lemniscate(), {}, 10); }

TEST(Cluster, MakesTheCoverOfACurveThatCrossesItself) {
  Options options;
  options.sigma = 0.05;
  expect_same_from_units(lemniscate(), options, 10);
}

TEST(Cluster, MakesTheCoverOfASelfMotion) {
  Options options;
  options.sigma = 0.2;
  expect_same_from_units(plane_and_line(), options, 60);
}

TEST(Cluster, KeepsExactCoefficientsAsTheyAre) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1/3", {{y, 2}}}, {"-1", {}}});
  System system = b.system();
  const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, ExactNumber(2));
  const ExactNumber odd = (root + ExactNumber::pi()) * ExactNumber::rational("3/7") +
                          pow(ExactNumber::apply(ConstantFunction::sin, ExactNumber(1)), -3);
  system.equations[0].monomials[0] = Monomial(odd, {{x, 2}});
  const Prepared prepared = prepared_with(system, {});
  const Prepared again = prepared_from(to_bytes(prepared));
  EXPECT_EQ(again.system.equations[0].monomials[0].coefficient, odd);
  EXPECT_EQ(to_bytes(again), to_bytes(prepared));
}

// A search with limits, its units in random order, until it is done or has ended; `most`: of units that are under way.
struct Limited {
  Cover cover;
  std::string state;
  std::int64_t kept = 0;  // at its most
  bool done = false;
};

Limited run_with_limits(const Prepared& prepared, Control& control, unsigned seed, std::optional<std::string> from = {}) {
  std::mt19937 random(seed);
  Coordinator coordinator(to_bytes(prepared), std::move(from), &control);
  std::vector<std::string> waiting;
  Limited ran;
  while (!coordinator.done() && !coordinator.ended()) {
    for (std::string& unit : coordinator.take_units(1 + random() % 4)) waiting.push_back(std::move(unit));
    std::shuffle(waiting.begin(), waiting.end(), random);
    if (waiting.empty()) {
      ADD_FAILURE() << "nothing to do, and neither done nor ended";
      break;
    }
    const std::string answer =
        UnitRunner(coordinator.prepared_bytes())
            .run(waiting.back(), {.boxes = 1 + random() % 200, .threads = 1 + random() % 2 > 1 ? 2 : 1});
    waiting.pop_back();
    coordinator.add(answer);
    ran.kept = std::max(ran.kept, control.kept());
  }
  ran.done = coordinator.done();
  ran.state = coordinator.state();
  ran.cover = coordinator.assemble(control);
  EXPECT_EQ(control.kept(), 0);
  return ran;
}

// Points of the torus lie in boxes, whether anything is proven of these or not.
void expect_torus_covered(const Cover& cover) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0, 6.283);
  for (int k = 0; k < 300; ++k) {
    const double u = angle(random), v = angle(random);
    const double r = 1 + 0.5 * std::cos(v);
    const std::vector<double> point{r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)};
    bool covered = false;
    for (const CoverBox& box : cover.boxes) {
      bool in = true;
      for (std::size_t j = 0; j < 3; ++j)
        in = in && box.box[j].lo() - 1e-12 <= point[j] && point[j] <= box.box[j].hi() + 1e-12;
      covered = covered || in;
    }
    ASSERT_TRUE(covered) << point[0] << " " << point[1] << " " << point[2];
  }
}

TEST(Cluster, KeepsALimitOfBoxesToTheBoxAndGoesOnFromThere) {
  for (const bool proof : {false, true}) {
    Options options{.sigma = 0.3, .proof = proof};
    const Prepared prepared = prepared_with(torus().system(), options);
    Control free;
    const Cover whole = solve(prepared, free);
    const std::uint64_t all = whole.statistics.processed;
    for (const std::uint64_t most : {std::uint64_t{1}, std::uint64_t{7}, all / 3, all - 1}) {
      Control control({.boxes = most});
      const Limited ran = run_with_limits(prepared, control, static_cast<unsigned>(most));
      EXPECT_FALSE(ran.done);
      EXPECT_EQ(ran.cover.statistics.processed, most);
      EXPECT_GT(ran.cover.count(Verdict::pending), 0u);
      EXPECT_EQ(control.ending(), (Ending{Limit::boxes, Stage::search}));
      expect_torus_covered(ran.cover);
      EXPECT_TRUE(!ran.cover.proof || check::check(torus().system(), ran.cover).proof.verified);
      Control second({.boxes = all});
      const Limited rest = run_with_limits(prepared, second, 5, ran.state);
      EXPECT_TRUE(rest.done);
      expect_same(whole, rest.cover);
    }
  }
}

TEST(Cluster, TakesNothingThatAMemoryLimitHasNoRoomFor) {
  Options options;
  options.sigma = 0.3;
  const Prepared prepared = prepared_with(torus().system(), options);
  Control free;
  const Limited whole = run_with_limits(prepared, free, 1);
  ASSERT_TRUE(whole.done);
  expect_torus_covered(whole.cover);
  int ended = 0;
  for (int share = 1; share < 9; ++share) {
    const auto most = static_cast<std::uint64_t>(whole.kept * share / 8);
    Control control({.memory = most});
    const Limited ran = run_with_limits(prepared, control, 2);
    EXPECT_LE(ran.kept, static_cast<std::int64_t>(most));
    expect_torus_covered(ran.cover);
    if (ran.done) continue;
    ++ended;
    EXPECT_EQ(control.ending(), (Ending{Limit::memory, Stage::search}));
    Control second;
    expect_same(whole.cover, run_with_limits(prepared, second, 5, ran.state).cover);
  }
  EXPECT_GE(ended, 6);
}

TEST(Cluster, EndsAtAnyMomentOfTheClockWithWhatIsProven) {
  for (const System& system : {torus().system(), lemniscate()}) {
    const Prepared prepared = prepared_with(system, {});
    Control free;
    const Cover whole = solve(prepared, free);
    int ended = 0;
    for (int ticks = 1; ticks < 30; ticks += 2) {
      double now = 0;
      Control control({.time = static_cast<double>(ticks), .clock = [&now] { return now += 1; }});
      const Limited ran = run_with_limits(prepared, control, static_cast<unsigned>(ticks));
      if (ran.done) continue;
      ++ended;
      EXPECT_EQ(control.ending(), (Ending{Limit::time, Stage::search}));
      if (system.variables.size() == 3) expect_torus_covered(ran.cover);
      Control second;
      expect_same(whole, run_with_limits(prepared, second, 5, ran.state).cover);
    }
    EXPECT_GT(ended, 3);
  }
}

// Numbers of shards beyond 32 bits, as a search of months would reach: its script is put together all the same.
TEST(Cluster, HasNoLimitOfUnits) {
  const Prepared prepared = prepared_with(torus().system(), {.sigma = 0.3, .proof = true});
  Control free;
  const Cover whole = solve(prepared, free);
  Control control({.boxes = 40});
  const std::string bytes = run_with_limits(prepared, control, 3).state;
  SearchState state = state_from(bytes, prepared);
  state.shards.emplace_back(ShardNumber{1} << 45, true);
  SearchView late{state.first, state.pass, state.motions, state.cutting, state.sigma};
  for (const Shard& shard : state.shards) late.parts.push_back({&shard});
  Control rest;
  const Limited ran = run_with_limits(prepared, rest, 5, to_bytes(late));
  EXPECT_TRUE(ran.done);
  ShardNumber last = 0;
  for (const Shard& shard : state_from(ran.state, prepared).shards) last = std::max(last, shard.number);
  EXPECT_GT(last, ShardNumber{1} << 45);
  expect_same(whole, ran.cover);
  EXPECT_TRUE(check::check(torus().system(), ran.cover).proof.verified);
}

TEST(Cluster, RefusesWhatIsNotItsOwn) {
  Options options;
  options.sigma = 0.3;
  const Prepared surface = prepared_with(torus().system(), options), curve = prepared_with(lemniscate(), options);
  Coordinator one(to_bytes(surface)), other(to_bytes(curve));
  const std::vector<std::string> units = one.take_units(1), others = other.take_units(1);
  ASSERT_EQ(units.size(), 1u);
  const std::string answer = UnitRunner(one.prepared_bytes()).run(units[0], {.boxes = 10});
  EXPECT_THROW(UnitRunner(other.prepared_bytes()).run(units[0]), ShardError) << "of another system";
  EXPECT_THROW(other.add(answer), ShardError);
  EXPECT_THROW(one.add(units[0]), ShardError) << "a unit is no answer";
  std::string old = answer;
  old[old.find("version ") + 8] = '8';
  EXPECT_THROW(one.add(old), ShardError);
  EXPECT_TRUE(one.add(answer));
  EXPECT_FALSE(one.add(answer)) << "again";
  EXPECT_GT(one.take_units(3).size(), 0u);
}

}  // namespace
}  // namespace corank::solve
