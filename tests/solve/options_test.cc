// What a search is asked for says itself whether it makes sense.
#include "corank/solve/step/options.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "corank/tests/solve/cover_questions.h"

namespace corank::solve {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

// The name of the option that is refused, "" where none is.
std::string refused(const std::function<void(Options&)>& change, bool with_system = false) {
  Options options;
  change(options);
  try {
    with_system ? options.validate(torus().system()) : options.validate();
    return "";
  } catch (const OptionError& error) {
    EXPECT_FALSE(error.reason().empty());
    return error.option();
  }
}

TEST(Options, ThatAreDefaultsMakeSense) {
  EXPECT_EQ(refused([](Options&) {}), "");
  EXPECT_EQ(refused([](Options&) {}, true), "");
}

TEST(Options, AreRefusedByTheirName) {
  EXPECT_EQ(refused([&](Options& o) { o.sigma = o.sigma_length = o.sigma_angle = kWhole; }), "");
  EXPECT_EQ(refused([&](Options& o) { o.coarser = kInf; }), "coarser");
  for (const double bad : {kNan, -kInf, 0.0, -1.0}) {
    EXPECT_EQ(refused([&](Options& o) { o.sigma = bad; }), "sigma") << bad;
    EXPECT_EQ(refused([&](Options& o) { o.sigma_length = bad; }), "sigma_length") << bad;
    EXPECT_EQ(refused([&](Options& o) { o.sigma_angle = bad; }), "sigma_angle") << bad;
    EXPECT_EQ(refused([&](Options& o) { o.coarser = bad; }), "coarser") << bad;
  }
  for (const double bad : {kNan, kInf, -1.0}) EXPECT_EQ(refused([&](Options& o) { o.time_limit = bad; }), "time_limit");
  for (const int bad : {-1, kMostThreads + 1}) EXPECT_EQ(refused([&](Options& o) { o.threads = bad; }), "threads");
}

TEST(Options, AskForNoSigmaBelowWhatDoublesResolve) {
  const double least = smallest_sigma(torus().system()).length;
  EXPECT_EQ(refused([&](Options& o) { o.sigma = 0.9 * least; }, true), "sigma");
  EXPECT_EQ(refused([&](Options& o) { o.sigma_length = 0.9 * least; }, true), "sigma_length");
  EXPECT_EQ(refused([&](Options& o) { o.sigma = 1.1 * least; }, true), "");
  EXPECT_EQ(refused([&](Options& o) { o.sigma = 0.9 * least; }), "") << "without a system nobody knows";
}

TEST(Options, OfBothKindsGiveWayToThoseOfOne) {
  Options options;
  options.sigma = 1;
  options.sigma_angle = 2;
  EXPECT_EQ(options.asked_length(), 1);
  EXPECT_EQ(options.asked_angle(), 2);
}

TEST(Solve, RefusesOptionsThatMakeNoSense) {
  Options options;
  options.sigma = kNan;
  EXPECT_THROW(solve(torus().system(), options), OptionError);
}

}  // namespace
}  // namespace corank::solve
