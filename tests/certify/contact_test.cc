// What boxes touch: ends of the domain and inequalities, and when the set is proven to reach an end.
#include "corank/certify/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;
using With = Contact::With;

/// x² + y² = 25 with x in [-3, 3] and y in [0, 5], 4 x + 3 y ≥ 0.
System circle() {
  SystemBuilder b;
  const int x = b.variable("x", "-3", "3"), y = b.variable("y", "0", "5");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-25", {}}});
  b.at_least_zero({{"4", {{x, 1}}}, {"3", {{y, 1}}}});
  return b.system();
}

std::vector<Contact> contacts_of(const System& system, const CoverBox& box) {
  std::vector<Contact> found;
  Cover cover;
  cover.boxes = {box};
  cover.regions = {{{2.4, 3.6}, {3.5, 4.5}}};
  visit_contacts(system, cover, [&](const CoverBox&, const std::vector<Contact>& contacts) { found = contacts; });
  return found;
}

CoverBox box(Interval x, Interval y, Verdict verdict, std::vector<int> free) { return {{x, y}, verdict, std::move(free)}; }

TEST(Contact, IsNoneForABoxStrictlyInside) {
  EXPECT_TRUE(contacts_of(circle(), box({0, 2.9}, {4, 4.9}, Verdict::regular, {0})).empty());
}

TEST(Contact, IsNoneWithAnEndThatTheEquationsImply) {
  EXPECT_TRUE(contacts_of(circle(), box({-1, 1}, {4.8, 5.1}, Verdict::regular, {0})).empty()) << "y <= 5 on the circle";
}

TEST(Contact, WithTheEndOfAFreeVariableIsReached) {
  const auto found = contacts_of(circle(), box({2.5, 3}, {4, 4.4}, Verdict::regular, {0}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].with, With::upper_end);
  EXPECT_EQ(found[0].index, 0);
  EXPECT_TRUE(found[0].reached);
}

TEST(Contact, WithTheEndOfADependentVariableIsNotProven) {
  for (const Verdict verdict : {Verdict::boundary, Verdict::undecided}) {
    const auto found = contacts_of(circle(), box({2.9, 3.1}, {3.9, 4.1}, verdict, {1}));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].reached);
  }
}

TEST(Contact, WithTheEndOfADependentVariableIsReachedWhereItIsCrossed) {
  // x = √(25 − y²) falls from 3.12 to 2.86: it is 3 in between.
  CoverBox across = box({2.86, 3.13}, {3.9, 4.1}, Verdict::boundary, {1});
  EXPECT_FALSE(contacts_of(circle(), across).at(0).reached) << "without the region of a proof";
  across.region = 0;
  EXPECT_TRUE(contacts_of(circle(), across).at(0).reached);
  CoverBox inside = box({2.86, 3.01}, {4.01, 4.1}, Verdict::boundary, {1});
  inside.region = 0;
  EXPECT_FALSE(contacts_of(circle(), inside).at(0).reached) << "x <= 2.99 there, whatever the box says";
}

TEST(Contact, OfAPartOfASheetIsNotProven) {
  CoverBox part = box({2.3, 3}, {4, 4.4}, Verdict::regular, {0});
  part.region = 0;  // which begins at x = 2.4: nothing says that there is a point for every x
  EXPECT_FALSE(contacts_of(circle(), part).at(0).reached);
  part.box[0] = {2.4, 3};
  EXPECT_TRUE(contacts_of(circle(), part).at(0).reached);
}

TEST(Contact, OfABoundaryBoxIsReachedWhereItIsTheOnlyOne) {
  const auto one = contacts_of(circle(), box({2.5, 3}, {4, 4.4}, Verdict::boundary, {0}));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].reached);
  const auto two = contacts_of(circle(), box({-3, 3}, {4, 5}, Verdict::boundary, {0}));
  ASSERT_EQ(two.size(), 3u) << "both ends of x, and the inequality at (-3, 4)";
  for (const Contact& c : two) EXPECT_FALSE(c.reached);
}

TEST(Contact, WithAnInequalityIsWhereItMayFail) {
  const auto found = contacts_of(circle(), box({-2.99, -2.9}, {3.9, 4.1}, Verdict::boundary, {0}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].with, With::inequality);
  EXPECT_EQ(found[0].index, 0);
}

TEST(Contact, IsNotAskedOfPendingBoxes) {
  int visited = 0;
  Cover cover;
  cover.boxes = {box({-3, 3}, {0, 5}, Verdict::pending, {})};
  visit_contacts(circle(), cover, [&](const CoverBox&, const std::vector<Contact>&) { ++visited; });
  EXPECT_EQ(visited, 0);
}

TEST(Contact, IsNoneWithTheRangeOfAVariableOfOneValue) {
  SystemBuilder b;
  const int x = b.variable("x", "-3", "3");
  b.variable("y", "1/3", "1/3");
  b.equation({{"1", {{x, 1}}}, {"-1", {}}});
  EXPECT_TRUE(contacts_of(b.system(), box({0.9, 1.1}, {0.3, 0.4}, Verdict::isolated, {})).empty());
}

TEST(Contact, IsThereWhereABoxEndsOnAnEnd) {
  for (const auto& [x, end] : {std::pair{Interval(-3, 0), With::lower_end}, {Interval(0, 3), With::upper_end}}) {
    const auto found = contacts_of(circle(), box(x, {4, 4.9}, Verdict::undecided, {0}));
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].with, end);
  }
}

// x in [1/3, 2/3], between the doubles kBelow and kAbove each.
TEST(Contact, IsWithTheExactEnd) {
  constexpr double kBelow = 0x1.5555555555555p-2, kAbove = 0x1.5555555555556p-2;
  SystemBuilder b;
  b.variable("x", "1/3", "2/3"), b.variable("y", "-9", "9");
  const auto one = [&](Interval x) { return contacts_of(b.system(), box(x, {0, 1}, Verdict::regular, {0, 1})); };
  EXPECT_EQ(one({kAbove, 0.5}).size(), 1u) << "no double is known to be above 1/3 but those beyond its neighbour";
  EXPECT_TRUE(one({0x1.5555555555557p-2, 0.5}).empty());
  EXPECT_EQ(one({0.5, 2 * kBelow}).size(), 1u);
  EXPECT_TRUE(one({0.5, 0x1.5555555555554p-1}).empty());
  const auto reached = [&](Interval x) { return one(x).at(0).reached; };
  EXPECT_TRUE(reached({kBelow, 0.5}) && reached({0.5, 2 * kAbove}));
  EXPECT_FALSE(reached({kAbove, 0.5})) << "1/3 is not in it";
  EXPECT_FALSE(reached({0.5, 2 * kBelow}));
}

TEST(Contact, WithAnEndThatTheSolutionMayJustMissIsNotProven) {
  // x = √(25 − y²), to 1/100, is 3.007 at y = 3.995 and 2.993 at 4.005.
  SystemBuilder b;
  const int x = b.variable("x", "-3", "3"), y = b.variable("y", "0", "9");
  b.equation({{"0.1", {{x, 2}}}, {"0.1", {{y, 2}}}, {"-2.5", {}}});
  System system = b.system();
  widen(system.equations[0], 1e-3);
  const auto reached = [&](Interval y_side) {
    CoverBox across = box({2.7, 3.3}, y_side, Verdict::boundary, {1});
    across.region = 0;
    return contacts_of(system, across).at(0).reached;
  };
  EXPECT_TRUE(reached({3.9, 4.1}));
  EXPECT_FALSE(reached({3.9, 3.995})) << "not certainly beneath 3";
  EXPECT_FALSE(reached({4.005, 4.1})) << "not certainly above";
}

TEST(Contact, IsNoneWithAnImpliedEndAndIsOneWithTheOtherEnd) {
  SystemBuilder b;  // x >= −5 is implied, x <= 3 is not
  const int x = b.variable("x", "-5", "3"), y = b.variable("y", "-9", "9");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-25", {}}});
  EXPECT_TRUE(contacts_of(b.system(), box({-5, -4}, {0, 3}, Verdict::regular, {1})).empty());
  EXPECT_EQ(contacts_of(b.system(), box({2, 3}, {4, 5}, Verdict::regular, {0})).size(), 1u);
}

TEST(Contact, IsAskedOfEveryInequality) {
  SystemBuilder b;
  const int x = b.variable("x", "-9", "9"), y = b.variable("y", "-9", "9");
  b.at_least_zero({{"1", {{x, 1}}}}).at_least_zero({{"1", {{y, 1}}}});
  const auto at = [&](Interval x_side, Interval y_side) {
    std::vector<int> indices;
    for (const Contact& c : contacts_of(b.system(), box(x_side, y_side, Verdict::regular, {0, 1})))
      indices.push_back(c.index);
    return indices;
  };
  EXPECT_EQ(at({0, 1}, {1, 2}), std::vector<int>{0}) << "0 is on the inequality";
  EXPECT_EQ(at({1, 2}, {-1, 2}), std::vector<int>{1});
  EXPECT_EQ(at({1, 2}, {1, 2}), std::vector<int>{});
}

TEST(Contact, OfAnUndecidedBoxReachesNothing) {
  const auto found = contacts_of(circle(), box({2.5, 3}, {4, 4.4}, Verdict::undecided, {0}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].reached);
}

}  // namespace
}  // namespace corank::certify
