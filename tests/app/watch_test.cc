// Work that has to end: it is asked to, and ended where it does not.
#include "corank/app/watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <future>

namespace corank::app {
namespace {

const std::atomic<bool> kNotAskedToEnd = false;
constexpr Watch::Duration kForEver{1e6};

TEST(Watch, AsksForTheEndAtTheTimeLimit) {
  Watch watch(
      1e-3, kNotAskedToEnd, [](const std::string&) { ADD_FAILURE() << "the work ends by itself"; }, kForEver);
  watch.stop().wait(false);
  EXPECT_TRUE(watch.stop());
}

TEST(Watch, AsksForTheEndOnAnInterrupt) {
  std::atomic<bool> interrupt = false;
  Watch watch(
      0, interrupt, [](const std::string&) { ADD_FAILURE() << "the work ends by itself"; }, kForEver);
  EXPECT_FALSE(watch.stop());
  interrupt = true;
  watch.stop().wait(false);
}

TEST(Watch, GivesUpWorkThatDoesNotEndAndNamesItsStage) {
  std::promise<std::string> given_up;
  std::atomic<bool> interrupt = false;
  Watch watch(
      0, interrupt, [&](const std::string& stage) { given_up.set_value(stage); }, Watch::Duration(0));
  watch.enter("reading the file");
  interrupt = true;
  EXPECT_EQ(given_up.get_future().get(), "reading the file");
}

// Pieces of work that end, one after the other, are left alone, and so is a program that does none of that kind.
TEST(Watch, GivesUpOnePieceOfDeafWorkThatGoesOn) {
  std::atomic<bool> interrupt = true, given_up = false;
  std::atomic<int> asked = 0;
  std::atomic<Watch::Work> stuck = 0;
  std::promise<void> enough, over;
  Watch watch(
      0, interrupt,
      [&](const std::string&) {
        if (!given_up.exchange(true)) over.set_value();
      },
      Watch::Duration(1e-3),
      [&]() -> Watch::Work {
        const int n = ++asked;
        if (n == 8) enough.set_value();
        return stuck != 0 ? stuck.load() : n % 2 == 0 ? 0 : static_cast<Watch::Work>(n);
      });
  enough.get_future().wait();
  EXPECT_FALSE(given_up);
  stuck = 1000;
  over.get_future().wait();
}

TEST(Watch, LeavesWorkAloneThatEndsInTime) {
  Watch watch(
      0, kNotAskedToEnd, [](const std::string&) { ADD_FAILURE() << "it has ended"; }, Watch::Duration(0));
  watch.done();
}

TEST(Watch, TakesAnyLimit) {
  for (const double seconds : {0.0, 1e300, HUGE_VAL}) {
    Watch watch(seconds, kNotAskedToEnd, [](const std::string&) { ADD_FAILURE() << "no end was asked for"; });
    EXPECT_FALSE(watch.stop());
  }
}

}  // namespace
}  // namespace corank::app
