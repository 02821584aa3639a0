// Dextar's sets against their closed forms: every box lies where the geometry says, and no sample of the loci is lost.
#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/closed_forms.h"
#include "corank/tests/models/given_rates.h"

namespace corank {
namespace {
using symbolic::KernelSide;
using symbolic::SingularitySet;

constexpr int kSamples = 2000;

System dextar(SingularitySet set, std::optional<KernelSide> side = std::nullopt) {
  static const auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  return symbolic::algebrize(symbolic::singularity_system(model, set, side));
}

Cover solve_at(const System& system, double sigma) {
  solve::Options options;
  options.sigma = sigma;
  options.threads = 0;
  return solve::solve(system, options);
}

template <class Samples>
void expect_holds_all(const Cover& cover, const Samples& samples) {
  ASSERT_GT(samples.size(), 1000u);
  const test::CoverLookup lookup(cover);
  std::size_t lost = 0;
  for (const auto& q : samples) lost += !lookup.holds(q, test::kSampleTolerance);
  EXPECT_EQ(lost, 0u) << "of " << samples.size() << " samples";
}

// sin(θ_b − θ_a) over a box, from the indices of c_a (then s_a, c_b, s_b).
Interval sine_of_difference(const Box& q, int ca, int cb) { return q[cb + 1] * q[ca] - q[cb] * q[ca + 1]; }

constexpr int kC2 = 2, kC3 = 4, kC4 = 6, kC5 = 8;

TEST(Dextar, HasTheVariablesThatTheClosedFormsAssume) {
  const auto system = dextar(SingularitySet::cspace);
  std::vector<std::string> names;
  for (const auto& v : system.variables) names.push_back(v.name);
  EXPECT_EQ(names, (std::vector<std::string>{"J3x", "J3y", "c_theta2", "s_theta2", "c_theta3", "s_theta3", "c_theta4",
                                             "s_theta4", "c_theta5", "s_theta5"}));
}

class DextarLocus : public testing::TestWithParam<std::tuple<SingularitySet, double>> {};

TEST_P(DextarLocus, IsCoveredWhereTheGeometrySays) {
  const auto [set, sigma] = GetParam();
  const Cover cover = solve_at(dextar(set), sigma);
  EXPECT_TRUE(cover.complete());
  EXPECT_LE(test::widest_edge(cover, 10), sigma);
  const UpwardRounding rounding;
  for (const auto& b : cover.boxes) {
    const auto& q = b.box;
    if (set == SingularitySet::forward) {
      ASSERT_TRUE(sine_of_difference(q, kC3, kC4).contains_zero()) << "J2, J3, J4 cannot be aligned in this box";
    } else {
      ASSERT_TRUE(sine_of_difference(q, kC2, kC3).contains_zero() || sine_of_difference(q, kC4, kC5).contains_zero())
          << "no arm can be straight or folded in this box";
    }
  }
  std::fesetround(FE_TONEAREST);
  expect_holds_all(cover, set == SingularitySet::forward ? test::dextar_forward_samples(kSamples)
                                                         : test::dextar_inverse_samples(kSamples));
  if (sigma <= 0.01) {
    const double proven = static_cast<double>(cover.count(Verdict::regular) + cover.count(Verdict::boundary));
    EXPECT_GE(proven, 0.99 * static_cast<double>(cover.boxes.size()));
  }
  if (set == SingularitySet::inverse) {
    // Only where both arms are stretched or folded at once may boxes be undecided.
    for (const auto& b : cover.boxes) {
      if (b.verdict != Verdict::undecided) continue;
      EXPECT_TRUE(sine_of_difference(b.box, kC2, kC3).contains_zero() &&
                  sine_of_difference(b.box, kC4, kC5).contains_zero());
    }
  } else {
    EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Loci, DextarLocus,
                         testing::Combine(testing::Values(SingularitySet::forward, SingularitySet::inverse),
                                          testing::Values(1.0, 0.1, 0.01)));

class DextarCspace : public testing::TestWithParam<double> {};

TEST_P(DextarCspace, IsCoveredAndNothingIsLost) {
  const Cover cover = solve_at(dextar(SingularitySet::cspace), GetParam());
  EXPECT_TRUE(cover.complete());
  EXPECT_LE(test::widest_edge(cover, 10), GetParam());
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  expect_holds_all(cover, test::dextar_cspace_samples(60));
}

INSTANTIATE_TEST_SUITE_P(Sigmas, DextarCspace, testing::Values(0.2, 0.1, 0.05));

// Both kernels, and the algebrized file, enclose the same configurations: each cover's proven boxes hold a configuration
// that the other must hold too. Middles of boxes are compared up to σ.
void expect_same_projection(const Cover& a, const Cover& b, double sigma) {
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const test::CoverLookup lookup(*to);
    for (const auto& box : from->boxes) {
      if (box.verdict == Verdict::undecided) continue;
      std::vector<double> middle;
      for (int j = 0; j < 10; ++j) middle.push_back(box.box[static_cast<std::size_t>(j)].mid());
      ASSERT_TRUE(lookup.holds(middle, sigma));
    }
  }
}

TEST(Dextar, RightAndLeftKernelsGiveTheSameConfigurations) {
  for (SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    const Cover right = solve_at(dextar(set, KernelSide::right), 0.05), left = solve_at(dextar(set, KernelSide::left), 0.05);
    EXPECT_TRUE(right.complete() && left.complete());
    expect_same_projection(right, left, 0.05);
    expect_holds_all(left, set == SingularitySet::forward ? test::dextar_forward_samples(kSamples)
                                                          : test::dextar_inverse_samples(kSamples));
  }
}

// The rates of joints and of links are one to one with those of the coordinates.
TEST(Dextar, GivesTheSameConfigurationsByTheTwistsOfItsJoints) {
  constexpr double kSigma = 0.05;
  for (SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    const Cover derived = solve_at(dextar(set), kSigma);
    const auto samples =
        set == SingularitySet::forward ? test::dextar_forward_samples(kSamples) : test::dextar_inverse_samples(kSamples);
    for (const char* rates : {test::kJointRates, test::kLinkRates})
      for (const KernelSide side : {KernelSide::right, KernelSide::left}) {
        const Cover given = solve_at(test::study_system(test::with_rates("dextar", rates), set, side), kSigma);
        EXPECT_TRUE(given.complete());
        EXPECT_EQ(given.dimension, 1);
        expect_holds_all(given, samples);
        expect_same_projection(given, derived, kSigma);
        for (const auto& b : given.boxes) {
          if (b.verdict != Verdict::undecided) continue;
          EXPECT_EQ(set, SingularitySet::inverse);
          EXPECT_NEAR(b.box[0].mid(), test::kDextarBase / 2, 0.01) << "both arms stretched";
        }
      }
  }
  const auto m = test::with_rates("dextar", test::kJointRates);
  EXPECT_TRUE(solve_at(test::study_system(m, SingularitySet::cspace_singular), 0.1).boxes.empty());
}

TEST(Dextar, TheAlgebrizedFileGivesTheSameBoxes) {
  for (SingularitySet set : {SingularitySet::cspace, SingularitySet::forward, SingularitySet::inverse}) {
    const auto system = dextar(set);
    auto again =
        symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(symbolic::to_cuik(system), "derived.cuik")));
    // Of a plain system sigma concerns every variable.
    for (std::size_t v = 0; v < system.variables.size(); ++v) again.variables[v].kind = system.variables[v].kind;
    const Cover direct = solve_at(system, 0.2), derived = solve_at(again, 0.2);
    ASSERT_EQ(direct.boxes.size(), derived.boxes.size());
    for (std::size_t k = 0; k < direct.boxes.size(); ++k) {
      ASSERT_EQ(direct.boxes[k].box, derived.boxes[k].box);
      ASSERT_EQ(direct.boxes[k].verdict, derived.boxes[k].verdict);
    }
  }
}

}  // namespace
}  // namespace corank
