// Pairs of boxes: none is lost that may hold two solutions with the same shared values.
#include "corank/certify/pairs.h"

#include <gtest/gtest.h>

#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// w, y, y′, and y − y′ ≥ 1/2.
System doubled() {
  test::SystemBuilder b;
  b.variable("w", "0", "10");
  const int y = b.variable("y", "0", "10"), second = b.variable("y_2", "0", "10");
  b.equation({{"1", {{y, 1}}}, {"-1", {{second, 1}}}, {"-1", {}}});
  b.at_least_zero({{"1", {{y, 1}}}, {"-1", {{second, 1}}}, {"-1/2", {}}});
  return b.system();
}

const PairLayout kLayout{{0, 1}, {0, 2}};

CoverBox box(double w_lo, double w_hi, double y_lo, double y_hi) {
  return {{Interval(w_lo, w_hi), Interval(y_lo, y_hi)}, Verdict::regular, {}};
}

std::vector<Box> pairs_of(const std::vector<CoverBox>& boxes) { return pairs(boxes, doubled(), kLayout, 100).value(); }

TEST(Pairs, AreOfBoxesThatOverlapInWhatTheyShare) {
  const std::vector<Box> expected{{Interval(1, 2), Interval(5, 5.25), Interval(1, 1.25)}};
  EXPECT_EQ(pairs_of({box(0, 2, 5, 5.25), box(1, 3, 1, 1.25)}), expected);
  EXPECT_EQ(pairs_of({box(1, 3, 5, 5.25), box(0, 2, 1, 1.25)}), expected) << "in whichever order they come";
  EXPECT_EQ(pairs_of({box(0, 1, 5, 5.25), box(1, 3, 1, 1.25)}).size(), 1u) << "an end is enough";
  EXPECT_TRUE(pairs_of({box(0, 1, 5, 5.25), box(1.5, 3, 1, 1.25)}).empty());
}

TEST(Pairs, AreOfEveryOverlapAmongMany) {
  // The first side reaches over all the others, whose sides do not meet.
  std::vector<CoverBox> boxes{box(0, 10, 9, 9.25)};
  for (int i = 0; i < 9; ++i) boxes.push_back(box(i + 0.2, i + 0.8, 1, 1.25));
  EXPECT_EQ(pairs_of(boxes).size(), 9u);
}

TEST(Pairs, AreOfABoxWithItselfWhereItIsWideEnough) {
  EXPECT_EQ(pairs_of({box(0, 1, 1, 2)}).size(), 1u);
  EXPECT_TRUE(pairs_of({box(0, 1, 1, 1.25)}).empty());
}

TEST(Pairs, AreLeftOutOnlyWhereAnInequalityFailsThroughout) {
  EXPECT_EQ(pairs_of({box(0, 1, 1, 1.3), box(0, 1, 0.7, 0.9)}).size(), 1u) << "1.3 − 0.7 ≥ 1/2, but 1 − 0.9 is not";
  EXPECT_TRUE(pairs_of({box(0, 1, 1, 1.3), box(0, 1, 0.9, 1)}).empty());
}

TEST(Pairs, AreNotMadeWhereTheyAreTooMany) {
  std::vector<CoverBox> boxes(30, box(0, 1, 1, 2));
  EXPECT_FALSE(pairs(boxes, doubled(), kLayout, 100));
}

}  // namespace
}  // namespace corank::certify
