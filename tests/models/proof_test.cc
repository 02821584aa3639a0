// Proofs of completeness: what solve() records, edited by prove_exactly(), is accepted by the independent checker.
#include <gtest/gtest.h>

#include "corank/check/checker.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank {
namespace {
using symbolic::SingularitySet;

struct ProofCase {
  std::string model, constant, value;
  SingularitySet set;
  double sigma;
  friend std::ostream& operator<<(std::ostream& out, const ProofCase& c) {
    return out << c.model << " " << to_string(c.set) << " " << c.constant << " " << c.value << " " << c.sigma;
  }
};

System system_of(const ProofCase& c) {
  auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/" + c.model + ".cuik");
  if (!c.constant.empty()) model.set_constant(c.constant, symbolic::Expression(c.value.c_str()));
  return symbolic::algebrize(symbolic::singularity_system(model, c.set));
}

Cover proven(const System& system, double sigma, int threads) {
  solve::Options options;
  options.sigma = sigma;
  options.threads = threads;
  options.proof = true;
  Cover cover = solve::solve(system, options);
  solve::prove_exactly(system, options, cover);
  return cover;
}

class RecordedProof : public testing::TestWithParam<ProofCase> {};

TEST_P(RecordedProof, IsAcceptedByTheChecker) {
  const System system = system_of(GetParam());
  for (const int threads : {1, 2}) {
    const Cover cover = proven(system, GetParam().sigma, threads);
    ASSERT_TRUE(cover.proof);
    const auto report = check::check(system, cover);
    for (std::size_t i = 0; i < report.failures.size() && i < 3; ++i)
      ADD_FAILURE() << report.failures[i].index << ": " << report.failures[i].reason;
    EXPECT_TRUE(report.proof.verified);
    EXPECT_TRUE(report.verified());
  }
}

// Those about the apex are one box.
TEST(RecordedProof, SpeaksOfBoxesThatWereMerged) {
  const char* const cone = "[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\nz : [-1, 1]\n[SYSTEM EQS]\nx^2 + 2*y^2 = z^2;\n";
  const System system = symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(cone, "cone")));
  const Cover cover = proven(system, 0.1, 1);
  ASSERT_TRUE(cover.proof);
  EXPECT_EQ(cover.count(Verdict::undecided), 1u);
  const check::Report report = check::check(system, cover);
  EXPECT_TRUE(report.proof.verified);
  EXPECT_TRUE(report.failures.empty());
}

INSTANTIATE_TEST_SUITE_P(Models, RecordedProof,
                         testing::Values(ProofCase{"three_slider", "L2", "1", SingularitySet::forward, 1e-6},
                                         ProofCase{"three_slider", "L2", "1", SingularitySet::inverse, 1e-6},
                                         ProofCase{"three_slider", "L2", "4/5", SingularitySet::forward, 1e-6},
                                         ProofCase{"three_slider", "L2", "4/5", SingularitySet::cspace, 0.1},
                                         ProofCase{"dextar", "", "", SingularitySet::forward, 0.1}));

// The search around the two configurations with a kernel of dimension 2 is part of the proof.
TEST(RecordedProof, OfDextarsInverseLocusIsAccepted) {
  const System system = system_of({"dextar", "", "", SingularitySet::inverse, 0.1});
  const Cover cover = proven(system, 0.1, 2);
  ASSERT_TRUE(cover.proof);
  EXPECT_GT(cover.proof->roots.size(), 1u);
  check::Options options;
  options.threads = 2;
  const auto report = check::check(system, cover, options);
  EXPECT_TRUE(report.proof.verified);
  EXPECT_TRUE(report.verified());
}

TEST(RecordedProof, LeavesTheCoverAsItIs) {
  const System system = system_of({"dextar", "", "", SingularitySet::inverse, 0.1});
  solve::Options options;
  options.sigma = 0.1;
  Cover plain = solve::solve(system, options);
  solve::prove_exactly(system, options, plain);
  const Cover recorded = proven(system, 0.1, 1);
  ASSERT_EQ(plain.boxes.size(), recorded.boxes.size());
  for (std::size_t i = 0; i < plain.boxes.size(); ++i) {
    EXPECT_EQ(plain.boxes[i].box, recorded.boxes[i].box);
    EXPECT_EQ(plain.boxes[i].verdict, recorded.boxes[i].verdict);
  }
  EXPECT_FALSE(plain.proof);
}

TEST(RecordedProof, ShowsABoxThatWasTakenAway) {
  const System system = system_of({"three_slider", "L2", "4/5", SingularitySet::cspace, 0.1});
  Cover cover = proven(system, 0.1, 1);
  // Another box's region and sides in the place of one: the leaf that names it no longer ends in it.
  cover.boxes[cover.boxes.size() / 2] = cover.boxes[cover.boxes.size() / 2 + 3];
  EXPECT_FALSE(check::check(system, cover).proof.verified);
}

}  // namespace
}  // namespace corank
