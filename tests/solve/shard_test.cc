// A search cut into shards, each of them stored as bytes and read again, makes the cover that one search makes.
#include <gtest/gtest.h>

#include <random>

#include "corank/check/checker.h"
#include "corank/solve/search/assembly.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/tests/solve/same_cover.h"

namespace corank::solve {
namespace {

// The shard as an answer brings it.
Shard through_bytes(Shard shard, const Prepared& prepared) {
  Answer answer;
  answer.shards.push_back(std::move(shard));
  const std::string bytes = to_bytes(answer);
  Received received = answer_from(bytes, prepared);
  received.parts[0].found.unpack(received.parts[0].shard.found);
  return std::move(received.parts[0].shard);
}

// Searches a few boxes of the work at a time, in any order, each time with new threads and a limit that leaves some.
class Pieces {
 public:
  Pieces(const Prepared& prepared, std::uint64_t most, unsigned seed)
      : prepared_(prepared), most_(most), random_(seed), judging_(prepared, control_, 0), judge_(prepared, judging_, 1000) {
    judge_.set_sigma(sigma_of_search(prepared, judge_.problem()));
  }

  Cover cover() {
    SelfMotions motions;
    const Work first = unit_from(to_bytes(Unit{.work = first_pass(prepared_)}), prepared_).work;
    for (Work pass = first; !pass.boxes.empty();
         pass = next_pass(prepared_, pass, take(pointers(), &Shard::postponed), judge_, motions))
      search(pass);
    for (Shard& shard : judge_.take_shards()) shards_.push_back(std::move(shard));
    const Sigma sigma = sigma_of_set(prepared_, judge_.problem(), pointers());
    cut(sigma);
    judge_.set_sigma(sigma);
    return assemble(prepared_, judge_.problem(), pointers(), first, motions, sigma, control_);
  }
  std::size_t parts() const { return parts_; }

 private:
  void search(const Work& pass) {
    std::vector<Waiting> waiting = pass.boxes;
    while (!waiting.empty()) {
      std::shuffle(waiting.begin(), waiting.end(), random_);
      Work part{{}, pass.postpone};
      for (int k = 0; k < 3 && !waiting.empty(); ++k) {
        part.boxes.push_back(std::move(waiting.back()));
        waiting.pop_back();
      }
      Tally tally(prepared_, control_, most_);
      Pool pool(prepared_, tally, number_);
      pool.set_sigma(sigma_of_search(prepared_, pool.problem()));
      pool.search(part);
      keep(pool);
      for (Shard& shard : shards_) {
        for (Waiting& box : shard.left) waiting.push_back(std::move(box));
        shard.left.clear();
      }
    }
  }

  // Half of the sheets here, half there.
  void cut(const Sigma& sigma) {
    const std::vector<Shard*> all = pointers();
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::vector<std::vector<Shard*>> halves{{all.begin(), half}, {half, all.end()}};
    std::vector<Shard> cut;
    for (const auto& shards : halves) {
      Tally tally(prepared_, control_, 0);
      Pool pool(prepared_, tally, number_);
      pool.set_sigma(sigma);
      pool.cut(shards);
      for (Shard& shard : pool.take_shards()) cut.push_back(through_bytes(std::move(shard), prepared_));
      number_ += 10;
    }
    for (Shard& shard : cut) shards_.push_back(std::move(shard));
  }

  void keep(Pool& pool) {
    for (Shard& shard : pool.take_shards()) {
      number_ = std::max(number_, shard.number);
      shards_.push_back(through_bytes(std::move(shard), prepared_));
    }
    ++parts_;
  }

  std::vector<Shard*> pointers() {
    std::vector<Shard*> all;
    for (Shard& shard : shards_) all.push_back(&shard);
    return all;
  }

  const Prepared& prepared_;
  const std::uint64_t most_;
  std::mt19937 random_;
  Control control_;
  Tally judging_;
  Pool judge_;
  ShardNumber number_ = 2000;
  std::size_t parts_ = 0;
  std::vector<Shard> shards_;
};

void expect_same_in_shards(const System& system, Options options, std::uint64_t most, std::size_t fewest_parts) {
  Control control;
  options.proof = true;
  const Prepared prepared = prepare(system, options, control);
  const Cover whole = solve(prepared, control);
  EXPECT_TRUE(!whole.proof || check::check(system, whole).proof.verified);
  for (const unsigned seed : {1u, 2u, 3u}) {
    Pieces pieces(prepared, most, seed);
    const Cover cover = pieces.cover();
    EXPECT_GE(pieces.parts(), fewest_parts);
    expect_same(whole, cover);
    ASSERT_EQ(cover.proof != nullptr, whole.proof != nullptr);
    if (!whole.proof) continue;
    EXPECT_EQ(cover.proof->steps, whole.proof->steps);
    EXPECT_EQ(cover.proof->integers, whole.proof->integers);
    EXPECT_EQ(cover.proof->reals, whole.proof->reals);
  }
}

TEST(Shards, OfASurfaceMakeTheCoverOfOneSearch) {
  Options options;
  options.sigma = 0.3;
  expect_same_in_shards(torus().system(), options, 40, 10);
}

TEST(Shards, OfPointsMakeTheCoverOfOneSearch) { expect_same_in_shards(circle_and_diagonal().system(), {}, 1, 3); }

TEST(Shards, OfACurveThatCrossesItselfMakeTheCoverOfOneSearch) {
  SystemBuilder b;  // the lemniscate of Gerono, with a node at the origin
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 4}}}, {"-1", {{x, 2}}}, {"1", {{y, 2}}}});
  Options options;
  options.sigma = 0.05;
  expect_same_in_shards(b.system(), options, 20, 10);
}

TEST(Shards, WithASelfMotionMakeTheCoverOfOneSearch) {
  SystemBuilder b;  // x (x − y) = 0, z (x − y) = 0: a plane, and the line x = z = 0
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"-1", {{x, 1}, {y, 1}}}});
  b.equation({{"1", {{z, 1}, {x, 1}}}, {"-1", {{z, 1}, {y, 1}}}});
  Options options;
  options.sigma = 0.2;
  expect_same_in_shards(b.system(), options, 100, 5);
}

TEST(Shards, AsBytesAreTheSameValueAgain) {
  Control control;
  Options options;
  options.sigma = 0.3;
  options.proof = true;
  const Prepared prepared = prepare(torus().system(), options, control);
  Tally tally(prepared, control, 300);
  Pool pool(prepared, tally);
  pool.set_sigma({0.3, 0.3});
  pool.search(first_pass(prepared));
  pool.cut(pool.shards());
  for (Shard& shard : pool.take_shards()) {
    const std::size_t found = shard.found.size();
    Answer answer;
    answer.shards.push_back(std::move(shard));
    const std::string bytes = to_bytes(answer);
    answer.shards[0] = through_bytes(std::move(answer.shards[0]), prepared);
    EXPECT_EQ(to_bytes(answer), bytes);
    EXPECT_EQ(answer.shards[0].found.size(), found);
  }
}

TEST(Shards, ThatAreDamagedAreRefused) {
  Control control;
  const Prepared prepared = prepare(torus().system(), {}, control);
  const std::string bytes = to_bytes(Unit{.work = first_pass(prepared)});
  EXPECT_THROW(answer_from(bytes, prepared), ShardError) << "a unit is no answer";
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    EXPECT_THROW(unit_from(bytes.substr(0, length), prepared), ShardError) << length;
  EXPECT_THROW(unit_from("no unit at all, but a sentence", prepared), ShardError);
}

}  // namespace
}  // namespace corank::solve
