// A search whose units run in any order, some more than once, some by workers that are lost, makes solve()'s cover.
#include <gtest/gtest.h>

#include <random>

#include "corank/check/checker.h"
#include "corank/solve/cluster.h"
#include "corank/solve/shard_bytes.h"
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
      answers.push_back(run_unit(coordinator->prepared_bytes(), unit, {.boxes = boxes, .threads = 1 + ran.units++ % 3}));
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
    int repeated = 0, restarts = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      const Ran ran = run_in_random_order(prepared, seed, boxes);
      expect_same(whole, ran.cover);
      EXPECT_TRUE(!ran.cover.proof || check::check(system, ran.cover).proof.verified);
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

TEST(Cluster, RefusesWhatIsNotItsOwn) {
  Options options;
  options.sigma = 0.3;
  const Prepared surface = prepared_with(torus().system(), options), curve = prepared_with(lemniscate(), options);
  Coordinator one(to_bytes(surface)), other(to_bytes(curve));
  const std::vector<std::string> units = one.take_units(1), others = other.take_units(1);
  ASSERT_EQ(units.size(), 1u);
  const std::string answer = run_unit(one.prepared_bytes(), units[0], {.boxes = 10});
  EXPECT_THROW(run_unit(other.prepared_bytes(), units[0]), ShardError) << "of another system";
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
