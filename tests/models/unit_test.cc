// The answer does not depend on the unit of length, on generous ranges, or on sigma.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "corank/solve/exactness/ipopt.h"
#include "corank/solve/search/solve.h"
#include "corank/study/answer.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/given_rates.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {
using symbolic::SingularitySet;

// A planar 3-RPR platform with its first leg's length as input, the others fixed: x, y of its first corner, in `unit` per
// metre; the declared ranges are `generous` times as wide as needed. Our own lengths.
System platform(const std::string& unit, int generous, SingularitySet set) {
  const std::string n = std::to_string(generous);
  const auto model = symbolic::parse_model(
      "[CONSTANTS]\nu := " + unit + "\na := 9/10*u\nb := 2/5*u\nh := 7/10*u\nr2 := 4/5*u\n[SYSTEM VARS]\n" + "x : [-" + n +
          "*2*u, " + n + "*2*u]\ny : [-" + n + "*2*u, " + n + "*2*u]\nphi ~ [-pi, pi]\n" + "r1 : [1/10*u, " + n +
          "*3/2*u]\nr3 : [1/10*u, " + n + "*3/2*u]\n[SYSTEM EQS]\nx^2 + y^2 = r1^2;\n" +
          "(x + b*cos(phi) - a)^2 + (y + b*sin(phi))^2 = r2^2;\n" +
          "(x + b*cos(phi + pi/3) - a/2)^2 + (y + b*sin(phi + pi/3) - h)^2 = r3^2;\n[INPUTS] r1, r3\n[OUTPUTS] x, y\n",
      "platform.cuik");
  return symbolic::algebrize(symbolic::singularity_system(model, set, std::nullopt, symbolic::kernel_scales(model, set)));
}

TEST(Unit, OfLengthChangesNeitherBoxesNorVerdicts) {
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    const Cover metres = solve::solve(platform("1", 1, set));
    EXPECT_TRUE(metres.complete());
    EXPECT_EQ(metres.count(Verdict::undecided), 0u);
    for (const char* unit : {"1/1000000", "1/1000", "1000", "1000000", "39.37"}) {
      const Cover cover = solve::solve(platform(unit, 1, set));
      const double count = static_cast<double>(metres.boxes.size());
      EXPECT_TRUE(cover.complete());
      EXPECT_EQ(cover.count(Verdict::undecided), 0u) << unit;
      EXPECT_NEAR(static_cast<double>(cover.boxes.size()), count, 0.02 * count + 2) << unit;
      EXPECT_NEAR(static_cast<double>(cover.statistics.processed), static_cast<double>(metres.statistics.processed),
                  0.05 * static_cast<double>(metres.statistics.processed) + 8)
          << unit;
    }
  }
}

// As many boxes, and in the same places: each proven one's middle is in a box of the other, up to their size. (Rows with
// lengths and rows without are combined by their size, so the search is not the same to the last box.)
void expect_same_places(const Cover& metres, const Cover& other, const System& system, double factor, double sigma) {
  EXPECT_TRUE(other.complete());
  const auto near = [](std::size_t a, std::size_t b, double share) {
    return std::fabs(static_cast<double>(a) - static_cast<double>(b)) <= share * static_cast<double>(b) + 8;
  };
  EXPECT_PRED3(near, other.boxes.size(), metres.boxes.size(), 0.03);
  EXPECT_PRED3(near, other.statistics.processed, metres.statistics.processed, 0.1);
  for (const Verdict verdict : {Verdict::isolated, Verdict::undecided})
    EXPECT_PRED3(near, other.count(verdict), metres.count(verdict), 0) << to_string(verdict);
  Cover rescaled = other;
  for (CoverBox& b : rescaled.boxes)
    for (std::size_t j = 0; j < b.box.size(); ++j)
      if (system.variables[j].kind == VariableKind::length)
        b.box[j] = Interval(b.box[j].lo() / factor, b.box[j].hi() / factor);
  const test::CoverLookup lookup(rescaled);
  for (const CoverBox& b : metres.boxes) {
    if (b.verdict == Verdict::undecided) continue;
    std::vector<double> q;
    for (int j = 0; j < system.configuration_size; ++j) q.push_back(b.box[static_cast<std::size_t>(j)].mid());
    ASSERT_TRUE(lookup.holds(q, sigma));
  }
}

TEST(Unit, OfLengthChangesNothingWhereTheVelocityEquationIsGiven) {
  const auto system = [](const char* model, const char* rates,
                         const std::vector<std::pair<std::string, std::string>>& lengths, const char* factor,
                         SingularitySet set) {
    auto m = test::with_rates(model, rates);
    for (const auto& [name, value] : lengths) m.set_constant(name, symbolic::Expression(value + "*" + factor));
    return test::study_system(m, set);
  };
  using Lengths = std::vector<std::pair<std::string, std::string>>;
  const Lengths dextar{{"l", "9/10"}, {"d", "59/50"}}, rrr{{"b", "2"}, {"p", "1/2"}, {"l1", "1"}, {"l2", "1"}},
      sliders{{"L1", "1"}, {"L2", "4/5"}};
  for (const auto& [model, rates, lengths] :
       {std::tuple("dextar", test::kJointRates, dextar), std::tuple("dextar", test::kLinkRates, dextar),
        std::tuple("3rrr_fixed_orientation", test::kLegScrews, rrr), std::tuple("three_slider", test::kRodRates, sliders)})
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
      SCOPED_TRACE(std::string(model) + " " + to_string(set));
      constexpr double kSigma = 0.1;
      const auto solved = [&](const char* factor, double unit) {
        solve::Options options;
        options.sigma_length = kSigma * unit;
        options.sigma_angle = kSigma;
        options.threads = 0;
        return solve::solve(system(model, rates, lengths, factor, set), options);
      };
      const Cover metres = solved("1", 1);
      const System described = system(model, rates, lengths, "1", set);
      if (set == SingularitySet::forward || test::long_run())
        expect_same_places(metres, solved("1/1000", 1e-3), described, 1e-3, kSigma);
      if (set == SingularitySet::inverse || test::long_run())
        expect_same_places(metres, solved("1000", 1e3), described, 1e3, kSigma);
    }
}

// A rod of length r between (a, 0) and a point of a body that slides along x and turns by φ: outputs of unlike units.
TEST(Unit, OfLengthChangesNoBarrier) {
  std::size_t boxes = 0;
  for (const char* unit : {"1", "1/1000", "1000000"}) {
    const auto model = symbolic::parse_model(
        std::string("[CONSTANTS]\nu := ") + unit +
            "\na := 1/2*u\nb := 2/5*u\n[SYSTEM VARS]\nx : [-u, u]\nphi ~ [-pi, pi]\nr : [0, 3*u]\n[SYSTEM EQS]\n"
            "(x + b*cos(phi) - a)^2 + b^2*sin(phi)^2 = r^2;\n[OUTPUTS] x, phi\n[LIMITS]\nr : [7/10*u, u]\n",
        "rod.cuik");
    const result::Result result = study::answer({.model = model, .set = SingularitySet::boundary});
    const auto barriers = std::ranges::count(result.cover.boxes, Passage::barrier, &CoverBox::passage);
    EXPECT_TRUE(result.cover.complete()) << unit;
    EXPECT_EQ(barriers, std::ssize(result.cover.boxes)) << unit;
    if (boxes == 0) boxes = result.cover.boxes.size();
    EXPECT_GT(boxes, 100u);
    EXPECT_NEAR(static_cast<double>(result.cover.boxes.size()), static_cast<double>(boxes), 8) << unit;
  }
}

// A sphere's directions and one of its heights, in `unit` per metre: components of unit vectors count as sines do.
TEST(Unit, OfDirectionsIsNone) {
  std::size_t boxes = 0;
  for (const auto& [text, unit] : {std::pair("1", 1.0), {"1/1000", 1e-3}, {"1000", 1e3}, {"1000000", 1e6}}) {
    const System system = study::system({.model = symbolic::parse_model(std::string("[CONSTANTS]\nr := ") + text +
                                                                            "\n[SYSTEM VARS]\nu @ unit\nx : [-2*r, 2*r]\n"
                                                                            "[SYSTEM EQS]\nx = r*u_x;\n",
                                                                        "sphere.cuik")});
    EXPECT_EQ(system.variables[static_cast<std::size_t>(system.find("u_x"))].size, 1) << text;
    EXPECT_DOUBLE_EQ(system.variables[static_cast<std::size_t>(system.find("x"))].size, unit) << text;
    const Cover cover = solve::solve(system);
    EXPECT_TRUE(cover.complete());
    EXPECT_NEAR(cover.sigma.length / unit, cover.sigma.angle, 1e-12) << text;
    if (boxes == 0) boxes = cover.boxes.size();
    EXPECT_GT(boxes, 100u);
    EXPECT_NEAR(static_cast<double>(cover.boxes.size()), static_cast<double>(boxes), 4) << text;
  }
}

TEST(Sigma, DoesNotSteerTheSearch) {
  const System system = platform("1000", 1, SingularitySet::forward);
  std::uint64_t processed = 0;
  for (const double sigma : {1000.0, 100.0, 10.0, 1.0}) {
    solve::Options options;
    options.sigma_length = sigma;
    options.sigma_angle = sigma / 1000;
    const Cover cover = solve::solve(system, options);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::undecided), 0u) << sigma;
    if (processed == 0) processed = cover.statistics.processed;
    EXPECT_EQ(cover.statistics.processed, processed) << "the same tree";
  }
}

TEST(KernelScales, AreThoseOfTheRangesThatTheConstraintsLeave) {
  const auto scales = [](const char* range) {
    const auto model = symbolic::parse_model(
        std::string("[SYSTEM VARS]\nx : ") + range + "\ny : " + range +
            "\nt ~ [-pi, pi]\n[SYSTEM EQS]\nx = 100*cos(t);\ny = 100*sin(t);\n[INPUTS] t\n[OUTPUTS] x\n",
        "circle.cuik");
    return symbolic::kernel_scales(model, SingularitySet::inverse);
  };
  EXPECT_EQ(scales("[-100, 100]"), scales("[-100000, 100000]"));
  EXPECT_EQ(scales("[-100, 100]"), (std::vector<std::string>{"400", "1"}));
}

// In nanometres, x² + y² has derivatives 2⁶¹ times as large as those of sines.
TEST(KernelScales, ReachTheSquaresOfSmallUnits) {
  const auto model = symbolic::parse_model(
      "[CONSTANTS]\nu := 1000000000\n[SYSTEM VARS]\nx : [-u, u]\ny : [-u, u]\nr : [0, u]\nt ~ [-pi, pi]\n"
      "s ~ [-pi, pi]\n[DUMMY VARS]\nn : [-1, 1]\n[SYSTEM EQS]\nx^2 + y^2 = r^2;\ncos(s) = sin(t);\nn = cos(t);\n"
      "[INPUTS] x, r, t\n[OUTPUTS] y, s\n",
      "lengths.cuik");
  const auto scales = symbolic::kernel_scales(model, SingularitySet::forward, symbolic::KernelSide::left);
  EXPECT_EQ(scales, (std::vector<std::string>{"1/2305843009213693952", "1", "1"}));
  // A direction's component is a length to the model, but in no unit: each coordinate has its own size.
  EXPECT_EQ(symbolic::coordinate_sizes(model),
            (std::vector<std::string>{"1000000000", "1000000000", "500000000", "1", "1", "1"}));
}

// A double solution, which Ipopt comes near to: its tolerances are in no unit.
TEST(Polishing, DoesNotDependOnTheUnit) {
  std::vector<double> values;
  for (const char* unit : {"1/1000000000", "1", "1000000000"}) {
    const System system = study::system(
        {.model = symbolic::parse_model(std::string("[CONSTANTS]\nu := ") + unit +
                                            "\n[SYSTEM VARS]\nx : [0, 3*u]\ny : [0, 3*u]\nt ~ [-pi, pi]\n"
                                            "[SYSTEM EQS]\nx^2 + y^2 = 4*u^2;\nx*y = 2*u^2;\nx = 2*u*cos(t);\n",
                                        "lengths.cuik")});
    const double u = system.variables[0].domain.hi() / 3;
    Box box = system.domain();
    box[0] = Interval(1.3 * u, 1.6 * u), box[1] = Interval(1.2 * u, 1.5 * u);
    const auto found = solve::polish(system, box, {});
    ASSERT_TRUE(found) << unit;
    EXPECT_NEAR((*found)[0] / u, std::sqrt(2.0), 0.005) << unit;
    values.push_back((*found)[0] / u);
    EXPECT_NEAR(values.back(), values.front(), 1e-6) << unit;
  }
}

}  // namespace
}  // namespace corank
