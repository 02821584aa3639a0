// Where pieces of circles meet, and where they do not.
#include "corank/certify/meeting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// x² + y² = 25.
System circle_of_radius_5() {
  test::SystemBuilder b;
  const int x = b.variable("x", "-8", "8"), y = b.variable("y", "-8", "8");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-25", {}}});
  return b.system();
}

class Boxes {
 public:
  explicit Boxes(unsigned seed) : random_(seed) {}
  double number(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }
  Interval side() {
    const double at = number(-7, 7);
    return {at, at + number(0.01, 2)};
  }

 private:
  std::mt19937 random_;
};

// How far within the box, or without, the circle is: the least |x² + y² − 25| is 0 only where it meets the box.
bool may_meet(const Box& box) {
  const UpwardRounding rounding;
  return (square(box[0]) + square(box[1])).contains(25.0);
}

TEST(SolutionIn, IsInTheBoxAndOnTheCircle) {
  Boxes boxes(1);
  const UpwardRounding rounding;
  MeetingTest test(circle_of_radius_5());
  int found = 0, there = 0;
  for (int k = 0; k < 2000; ++k) {
    const Box box{boxes.side(), boxes.side()};
    const auto solution = test.solution_in(box, box);
    there += may_meet(box);
    if (!solution) continue;
    ++found;
    EXPECT_TRUE(may_meet(box));
    EXPECT_TRUE(box[0].contains((*solution)[0]) && box[1].contains((*solution)[1]));
    EXPECT_TRUE(may_meet(*solution));
  }
  EXPECT_GT(found, 0.9 * there) << "others have a corner alone in the box";
}

// A variable with an equation of its own has one value, which a piece's region may hold without any room.
TEST(SolutionIn, IsFoundWhereAVariableHasOneValue) {
  const UpwardRounding rounding;
  test::SystemBuilder b;
  const int x = b.variable("x", "-8", "8"), y = b.variable("y", "-8", "8"), z = b.variable("z", "35000", "35000");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-25", {}}});
  b.equation({{"1", {{z, 1}}}, {"-35000", {}}});
  const System system = b.system();
  MeetingTest test(system);
  const Interval value = system.variables[2].domain;
  for (const Interval& known : {value, value + Interval(-1e-9, 1e-9)}) {
    const auto solution = test.solution_in({{2.9, 3.1}, {3.9, 4.1}, known}, {{2.9, 3.1}, {3.9, 4.1}, known});
    ASSERT_TRUE(solution);
    EXPECT_TRUE(known.contains((*solution)[2]));
  }
  EXPECT_FALSE(test.solution_in({{2.9, 3.1}, {3.9, 4.1}, Interval(34999)}, {{2.9, 3.1}, {3.9, 4.1}, Interval(34999)}));
}

TEST(Meeting, IsProvenOnlyWhereARegionOfBothIsCrossed) {
  Boxes boxes(2);
  const UpwardRounding rounding;
  MeetingTest test(circle_of_radius_5());
  int found = 0, there = 0;
  for (int k = 0; k < 2000; ++k) {
    const Box a{boxes.side(), boxes.side()};
    Box b;
    for (const Interval& side : a) b.emplace_back(side.lo() + boxes.number(-1, 1), side.hi() + boxes.number(1, 2));
    Box common = a;
    const bool overlap = common[0].intersect(b[0]) && common[1].intersect(b[1]), met = test.common(a, b, a).has_value();
    there += overlap && may_meet(common);
    if (!met) continue;
    ++found;
    EXPECT_TRUE(overlap && may_meet(common));
  }
  EXPECT_GT(there, 100);
  EXPECT_GT(found, 0.9 * there);
}

// For each value of one variable in the region one solution: of the circle's two over that value one only is in it.
TEST(PieceAbout, HoldsOneSolutionOverEachOfItsValues) {
  Boxes boxes(3);
  const UpwardRounding rounding;
  MeetingTest test(circle_of_radius_5());
  int found = 0;
  for (int k = 0; k < 500; ++k) {
    const double turn = boxes.number(-3.2, 3.2), radius = boxes.number(0.001, 2);
    const Box near{Interval(5 * std::cos(turn)), Interval(5 * std::sin(turn))};
    const Sheet piece = test.sheet_about(near, radius);
    if (!piece.proven) continue;
    ++found;
    const auto graph_over = [&](std::size_t f) {
      for (int i = 0; i <= 20; ++i) {
        const double x = piece.region[f].lo() + i / 20.0 * piece.region[f].width(), room = 25 - x * x;
        if (room < 0) return false;
        const double y = std::sqrt(room);
        if (piece.region[1 - f].contains(y) + piece.region[1 - f].contains(-y) != 1) return false;
      }
      return true;
    };
    EXPECT_TRUE(graph_over(0) || graph_over(1)) << turn << " " << radius;
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace corank::certify
