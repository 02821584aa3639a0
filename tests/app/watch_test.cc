// Work that has to end: it is asked to, and ended where it does not.
#include "corank/app/watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <future>

namespace corank::app {
namespace {

const std::atomic<bool> kNever = false;
constexpr Watch::Duration kForEver{1e6};

TEST(Watch, AsksForTheEndAtTheTimeLimit) {
  Watch watch(
      1e-3, kNever, [](const std::string&) { ADD_FAILURE() << "the work ends by itself"; }, kForEver);
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

TEST(Watch, LeavesWorkAloneThatEndsInTime) {
  Watch watch(
      0, kNever, [](const std::string&) { ADD_FAILURE() << "it has ended"; }, Watch::Duration(0));
  watch.done();
}

TEST(Watch, TakesAnyLimit) {
  for (const double seconds : {0.0, 1e300, HUGE_VAL}) {
    Watch watch(seconds, kNever, [](const std::string&) { ADD_FAILURE() << "no end was asked for"; });
    EXPECT_FALSE(watch.stop());
  }
}

}  // namespace
}  // namespace corank::app
