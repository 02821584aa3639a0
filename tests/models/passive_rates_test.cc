// Whether passive rates are eliminated from the kernel or not: the same configurations, on the repository's models and,
// where they are there, on those that users brought.
#include <gtest/gtest.h>

#include <filesystem>

#include <algorithm>
#include "corank/check/checker.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"

namespace corank {
namespace {

using symbolic::SingularitySet;

struct Case {
  const char* model;  // with its folder, from the source folder
  SingularitySet set;
  double sigma;
};

Cover cover_of(const System& system, double sigma) {
  solve::Options options;
  options.sigma = sigma;
  return solve::solve(system, options);
}

// Does every proven box of one meet a box of the other in the configuration's variables?
std::size_t alone(const Cover& one, const Cover& other, std::size_t variables) {
  std::size_t count = 0;
  for (const CoverBox& a : one.boxes) {
    if (a.verdict != Verdict::regular && a.verdict != Verdict::isolated) continue;
    count += std::none_of(other.boxes.begin(), other.boxes.end(), [&](const CoverBox& b) {
      for (std::size_t j = 0; j < variables; ++j)
        if (!a.box[j].overlaps(b.box[j])) return false;
      return true;
    });
  }
  return count;
}

class EliminatedPassiveRates : public testing::TestWithParam<Case> {};

TEST_P(EliminatedPassiveRates, LeaveTheSetAsItIs) {
  const std::filesystem::path file = std::filesystem::path(CORANK_SOURCE_DIR) / GetParam().model;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const symbolic::Mechanism model = symbolic::read_model(file);
  const auto kept = symbolic::kernel_question(model, GetParam().set);
  const auto without = symbolic::without_passive_rates(model, kept);
  ASSERT_FALSE(without.passive.eliminated.empty());
  const auto system = [&](const symbolic::KernelQuestion& kernel) {
    return symbolic::algebrize(symbolic::singularity_system(model, kernel, symbolic::kernel_scales(model, kernel), 1));
  };
  const System first = system(kept), second = system(without);
  EXPECT_LT(solve::reduce(second).kept.size(), solve::reduce(first).kept.size());
  const Cover a = cover_of(first, GetParam().sigma), b = cover_of(second, GetParam().sigma);
  EXPECT_TRUE(a.complete());
  EXPECT_TRUE(b.complete());
  EXPECT_GT(b.count(Verdict::regular) + b.count(Verdict::isolated), 0u);
  const auto n = static_cast<std::size_t>(first.configuration_size);
  EXPECT_EQ(alone(a, b, n), 0u);
  EXPECT_EQ(alone(b, a, n), 0u);
  const check::Report report = check::check(second, b);
  EXPECT_TRUE(report.failures.empty());
}

INSTANTIATE_TEST_SUITE_P(Models, EliminatedPassiveRates,
                         testing::Values(Case{"models/dextar.cuik", SingularitySet::forward, 0.3},
                                         Case{"models/dextar.cuik", SingularitySet::inverse, 0.3},
                                         Case{"models/3rrr_fixed_orientation.cuik", SingularitySet::forward, 0.3},
                                         Case{"models/3rrr_fixed_orientation.cuik", SingularitySet::inverse, 0.3},
                                         Case{"../shared/models/watt.cuik", SingularitySet::forward, 0.01},
                                         Case{"../shared/models/stephenson3.cuik", SingularitySet::inverse, 0.01},
                                         Case{"../shared/models/fiveR.cuik", SingularitySet::forward, 0.3}));

}  // namespace
}  // namespace corank
