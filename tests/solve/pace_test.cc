#include "corank/solve/distribution/pace.h"

#include <gtest/gtest.h>

namespace corank::solve {
namespace {

constexpr double kLongest = 1;

TEST(Pace, BeginsWithOneShortUnitForEachThread) {
  Pace pace;
  const Pace::Units first = pace.next(4, kLongest, {.time = 100});
  EXPECT_EQ(first.most, 4u);
  EXPECT_GT(first.fewest_boxes, 1u);
  EXPECT_LE(first.seconds, 0.1);
}

TEST(Pace, HasTheNextUnitReadyWhenOneIsDone) {
  Pace pace;
  static_cast<void>(pace.next(4, kLongest, {}));
  EXPECT_EQ(pace.next(4, kLongest, {.waits = 0.9, .units_under_way = 4, .time = 1}).most, 8u);
}

TEST(Pace, UnitsGrowWithTheTimeThatWasTaken) {
  Pace pace;
  double before = pace.next(2, kLongest, {.time = 5}).seconds;
  for (const double elapsed : {1.0, 3.0, 8.0}) {
    const double seconds = pace.next(2, kLongest, {.waits = 0.5, .units_under_way = 2, .time = 5 + elapsed}).seconds;
    EXPECT_GT(seconds, before) << elapsed;
    EXPECT_LE(seconds, 0.2 * elapsed);
    before = seconds;
  }
  EXPECT_EQ(pace.next(2, kLongest, {.waits = 0.5, .units_under_way = 2, .time = 1000}).seconds, kLongest);
}

TEST(Pace, UnitsAreShorterThanWhatIsLeft) {
  Pace pace;
  static_cast<void>(pace.next(2, kLongest, {}));
  // After 98 s, 2 % wait: 2 s; then 0.2 % after 99.8 s.
  EXPECT_EQ(pace.next(2, kLongest, {.waits = 0.02, .units_under_way = 2, .time = 98}).seconds, kLongest);
  EXPECT_LE(pace.next(2, kLongest, {.waits = 0.002, .units_under_way = 2, .time = 99.8}).seconds, 0.101);
}

TEST(Pace, AnotherPassBeginsAnewWithWhatWaitsThen) {
  Pace pace;
  static_cast<void>(pace.next(2, kLongest, {}));
  static_cast<void>(pace.next(2, kLongest, {.waits = 1e-3, .units_under_way = 2, .time = 100}));
  EXPECT_LE(pace.next(2, kLongest, {.pass = 1, .waits = 1e-3, .time = 100}).seconds, 0.1);
  // Half of it is done after 20 s: of little, but that is all there is.
  EXPECT_EQ(pace.next(2, kLongest, {.pass = 1, .waits = 5e-4, .units_under_way = 2, .time = 120}).seconds, kLongest);
}

TEST(Pace, TheMoreThreadsTheLongerIsTheShortestUnit) {
  Pace few, many;
  EXPECT_GT(many.next(100, kLongest, {}).seconds, 5 * few.next(2, kLongest, {}).seconds);
  // One thread gives units out, a few hundred a second: 1,000 threads with units of a second would wait for it.
  EXPECT_GE(many.next(1'000, kLongest, {}).seconds, 2 * kLongest);
}

TEST(Pace, SheetsAreCutInMorePartsThanThereAreThreads) {
  const Pace::Units sheets = Pace::of_sheets(3, kLongest);
  EXPECT_GT(sheets.most, 6u);
  EXPECT_EQ(sheets.seconds, kLongest);
}

}  // namespace
}  // namespace corank::solve
